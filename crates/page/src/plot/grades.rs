//! A matrix of deviations: one row per law, one column per method, the color by the size of the
//! deviation.

use std::ops::Range;

use super::canvas::{Anchor, Canvas, escape, hex};
use super::style::{self, FAINT_INK, INK, TEXT};
use crate::csv;
use crate::figure::Figure;
use crate::number::readable;

/// The height of a row, of the name of a group, and of the key in px.
const ROW: f64 = 19.0;
const GROUP: f64 = 32.0;
const KEY: f64 = 34.0;
const TOP: f64 = 40.0;
/// The gaps between groups of columns side by side, and one below the other, in px.
const GAP: f64 = 9.0;
const BETWEEN: f64 = 18.0;
/// The size of the numbers in the cells in px.
const SMALL: f64 = 12.5;
/// The deviation above which a cell has a color, palest first, and its name.
const SHADES: [(f64, (u8, u8, u8), &str); 5] = [
    (0.0, (214, 234, 226), "within tolerance"),
    (0.0, (253, 224, 180), "up to 10 ×"),
    (10.0, (247, 176, 112), "up to 100 ×"),
    (100.0, (200, 76, 48), "up to 10,000 ×"),
    (1e4, (160, 32, 48), "more"),
];
const NONE: (u8, u8, u8) = (236, 238, 241);

/// A matrix of deviations.
#[derive(Debug, Clone)]
pub struct Grades {
    /// See [`Figure::id`].
    pub id: String,
    /// See [`Figure::title`].
    pub title: String,
    /// See [`Figure::caption`].
    pub caption: String,
    /// Groups of columns: the name of the group and those of its columns.
    pub groups: Vec<(String, Vec<String>)>,
    /// The name of each row, and a cell for each column; without cells it heads the rows below it.
    pub rows: Vec<(String, Vec<Grade>)>,
    /// The section of the page that each row leads to, and the tip on its name; may be empty.
    pub links: Vec<(String, String)>,
    /// Whether a row of the numbers of obeyed laws is below the names of the columns.
    pub has_counts: bool,
}

/// A cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Grade {
    /// The law is obeyed.
    Obeyed,
    /// The deviation in multiples of the allowed one; infinite if the run failed.
    Missed(f64),
    /// Not measured.
    Unknown,
}

impl Grade {
    /// The color of the number as it is written, with two digits.
    fn color(self) -> (u8, u8, u8) {
        let of = |miss: f64| SHADES.iter().rev().find(|(least, ..)| miss > *least);
        match self {
            Grade::Obeyed => SHADES[0].1,
            Grade::Missed(miss) if miss.is_finite() => {
                let unit = 10f64.powf(miss.log10().floor() - 1.0);
                of((miss / unit).round() * unit).unwrap_or(&SHADES[4]).1
            }
            Grade::Missed(_) => SHADES[4].1,
            Grade::Unknown => NONE,
        }
    }

    fn words(self) -> String {
        match self {
            Grade::Obeyed => "✓".into(),
            // Thousands are abbreviated, because a cell has the room of four characters.
            Grade::Missed(miss) if (995.0..9.5e5).contains(&miss) => {
                format!("{}k", readable(miss / 1e3, 2))
            }
            Grade::Missed(miss) if miss.is_finite() => readable(miss, 2),
            Grade::Missed(_) => "✗".into(),
            Grade::Unknown => "–".into(),
        }
    }
}

impl Figure for Grades {
    fn id(&self) -> &str {
        &self.id
    }

    fn title(&self) -> &str {
        &self.title
    }

    fn caption(&self) -> &str {
        &self.caption
    }

    /// All groups side by side; one below the other on a narrow picture.
    fn drawn(&self, wide: f64, id: &str) -> String {
        let blocks: Vec<Range<usize>> = match wide < style::WIDTH {
            true => (0..self.groups.len()).map(|k| k..k + 1).collect(),
            false => std::iter::once(0..self.groups.len()).collect(),
        };
        let left = self.left();
        let is_used = |color: (u8, u8, u8)| {
            self.rows.iter().flat_map(|(_, cells)| cells).any(|own| own.color() == color)
        };
        let shades: Vec<_> = SHADES.into_iter().filter(|(_, color, _)| is_used(*color)).collect();
        let keys = key(&shades, left.min(wide / 4.0), wide);
        let cells = blocks.iter().map(|groups| self.cell(groups, wide));
        let head = self.head(cells.fold(f64::INFINITY, f64::min));
        let block = head + ROW * self.rows.len() as f64;
        let blocks_height =
            block * blocks.len() as f64 + BETWEEN * blocks.len().saturating_sub(1) as f64;
        let key_height = keys.last().map_or(0.0, |(_, y)| *y) + KEY;
        let (mut canvas, lower) =
            Canvas::titled(wide, TOP + blocks_height + key_height, &self.title);
        let mut top = TOP + lower;
        for groups in blocks {
            self.draw_groups(&mut canvas, groups, wide, (top, head));
            top += block + BETWEEN;
        }
        for ((_, color, name), (x, y)) in shades.iter().zip(keys) {
            let y = top - BETWEEN + 24.0 + y;
            canvas.raw(&format!(
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"11\" height=\"11\" fill=\"{}\"/>\n",
                y - 10.0,
                hex(*color)
            ));
            canvas.text((x + 16.0, y), Anchor::Start, TEXT, FAINT_INK, name);
        }
        let obeyed = |(name, cells): &(String, Vec<Grade>)| {
            let count = cells.iter().filter(|grade| **grade == Grade::Obeyed).count();
            format!("{name}: {count} of {}", cells.len())
        };
        let rows: Vec<String> = self.laws().map(obeyed).collect();
        canvas.finish(
            id,
            &self.title,
            &format!("laws and how often they are obeyed: {}", rows.join("; ")),
        )
    }

    /// One record per cell: row, group, column, deviation; 0 if the law is obeyed, empty if it was
    /// not measured.
    fn csv(&self) -> String {
        let mut out = String::from("law,group,column,deviation\n");
        let columns: Vec<(&String, &String)> = self
            .groups
            .iter()
            .flat_map(|(group, names)| names.iter().map(move |name| (group, name)))
            .collect();
        for (row, cells) in &self.rows {
            for ((group, name), grade) in columns.iter().zip(cells) {
                let value = match grade {
                    Grade::Obeyed => "0".into(),
                    Grade::Missed(miss) => csv::number(*miss),
                    Grade::Unknown => String::new(),
                };
                csv::record(&mut out, [row.as_str(), group, name, &value]);
            }
        }
        out
    }
}

impl Grades {
    /// The rows with cells.
    fn laws(&self) -> impl Iterator<Item = &(String, Vec<Grade>)> {
        self.rows.iter().filter(|(_, cells)| !cells.is_empty())
    }

    /// The left edge of the cells in px.
    fn left(&self) -> f64 {
        let names = self.laws().map(|(name, _)| style::width(name, TEXT)).fold(0.0, f64::max);
        style::EDGE + names + 10.0
    }

    /// The width of the cells of some groups side by side in px.
    fn cell(&self, groups: &Range<usize>, wide: f64) -> f64 {
        let columns: usize = self.groups[groups.clone()].iter().map(|(_, own)| own.len()).sum();
        let gaps = GAP * groups.len().saturating_sub(1) as f64;
        (wide - style::EDGE - self.left() - gaps) / columns.max(1) as f64
    }

    /// The width of the longest name of a column in px.
    fn longest(&self) -> f64 {
        let names = self.groups.iter().flat_map(|(_, names)| names);
        names.map(|name| style::width(name, TEXT)).fold(0.0, f64::max)
    }

    /// The height of the names above cells of this width in px; those of columns are turned if they
    /// are wider than a cell.
    fn head(&self, cell: f64) -> f64 {
        let names = if self.longest() <= cell { ROW - 7.0 } else { self.longest() };
        GROUP + names + self.counts()
    }

    /// The height of the row of counts in px.
    fn counts(&self) -> f64 {
        if self.has_counts { ROW } else { 0.0 }
    }

    /// Draws some groups side by side, from this height (px) on.
    fn draw_groups(
        &self,
        canvas: &mut Canvas,
        groups: Range<usize>,
        wide: f64,
        (top, head): (f64, f64),
    ) {
        let before: usize = self.groups[..groups.start].iter().map(|(_, own)| own.len()).sum();
        let (left, width) = (self.left(), self.cell(&groups, wide));
        let is_turned = head >= GROUP + self.longest() + self.counts();
        let mut places = Vec::new();
        let mut x = left;
        for (group, names) in &self.groups[groups] {
            canvas.text((x, top + 12.0), Anchor::Start, TEXT, INK, group);
            for name in names {
                let (middle, foot) = (x + width / 2.0, top + head - 7.0 - self.counts());
                if is_turned {
                    let base = middle + 4.5;
                    canvas.raw(&format!("<g transform=\"rotate(-90 {base:.1} {foot:.1})\">"));
                    canvas.text((base, foot), Anchor::Start, TEXT, FAINT_INK, name);
                    canvas.raw("</g>\n");
                } else {
                    canvas.text((middle, foot), Anchor::Middle, TEXT, FAINT_INK, name);
                }
                if self.has_counts {
                    let own = self.laws().map(|(_, cells)| cells[before + places.len()]);
                    let obeyed = own.filter(|own| *own == Grade::Obeyed).count().to_string();
                    canvas.text((middle, foot + ROW), Anchor::Middle, TEXT, INK, &obeyed);
                }
                places.push(x);
                x += width;
            }
            x += GAP;
        }
        if self.has_counts {
            canvas.text((left - 8.0, top + head - 7.0), Anchor::End, TEXT, INK, "laws obeyed");
        }
        for (k, (name, cells)) in self.rows.iter().enumerate() {
            let y = top + head + ROW * k as f64;
            let link = self.links.get(k).filter(|_| !cells.is_empty());
            if let Some((section, tip)) = link {
                let [section, tip] = [section, tip].map(|text| escape(text));
                canvas.raw(&format!("<a href=\"#{section}\"><title>{tip}</title>"));
            }
            match cells.is_empty() {
                true => canvas.text((left, y + 14.0), Anchor::Start, TEXT, INK, name),
                false => canvas.text((left - 8.0, y + 14.0), Anchor::End, TEXT, INK, name),
            }
            canvas.raw(if link.is_some() { "</a>\n" } else { "" });
            for (grade, x) in cells.iter().skip(before).zip(&places) {
                draw_cell(canvas, *grade, (*x, y), width);
            }
        }
    }
}

fn draw_cell(canvas: &mut Canvas, grade: Grade, (x, y): (f64, f64), width: f64) {
    canvas.raw(&format!(
        "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{}\"/>\n",
        x + 0.5,
        y + 0.5,
        width - 1.0,
        ROW - 1.0,
        hex(grade.color())
    ));
    // The ink contrasts with the shade also on a dark page, which inverts both.
    let is_dark = SHADES[3..].iter().any(|(_, color, _)| *color == grade.color());
    let ink = match grade {
        Grade::Obeyed => "#5f8f7c", // faint, so that numbers stand out
        _ if is_dark => "#ffffff",
        _ => "#22262d",
    };
    canvas.raw(&format!(
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"{SMALL}\" fill=\"{ink}\">{}</text>\n",
        x + width / 2.0,
        y + 13.5,
        escape(&grade.words())
    ));
}

/// The places of the shades and their names in px, in rows from this left edge on.
fn key(shades: &[(f64, (u8, u8, u8), &str)], left: f64, wide: f64) -> Vec<(f64, f64)> {
    let (mut x, mut y) = (left, 0.0);
    let place = |(_, _, name): &(f64, (u8, u8, u8), &str)| {
        let length = 16.0 + style::width(name, TEXT) + 14.0;
        if x + length > wide && x > left {
            (x, y) = (left, y + ROW);
        }
        let at = (x, y);
        x += length;
        at
    };
    shades.iter().map(place).collect()
}
