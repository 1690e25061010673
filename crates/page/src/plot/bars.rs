//! Bar charts of named values. On a logarithmic axis, where the length of a bar means nothing, each
//! value is a dot.

use plotters::prelude::*;

use super::axis::{Axis, Scale};
use super::canvas::{Anchor, Canvas, Frame, escape, fine, stroke};
use super::points;
use super::style::{self, FAINT_INK, GRID, INK, TEXT};
use crate::csv;
use crate::figure::Figure;
use crate::number::readable;

/// Height of a bar and distance between the tops of two bars in px.
const THICKNESS: f64 = 16.0;
const DOT: f64 = 6.0;
/// A name that is wider than this part of a narrow picture stands above its bar,
const MOST_BESIDE: f64 = 0.3;
/// which takes this height in px.
const NAME: f64 = 16.0;
/// The color of a bar without accent.
const GRAY: (u8, u8, u8) = (128, 134, 144);
const PITCH: f64 = 24.0;
/// More bars are closer, so that they fit a part of a printed sheet.
const MANY: usize = 15;
const CLOSE: f64 = 18.0;
const TOP: f64 = 46.0;
/// The space above the bars for the name of the limit in px.
const LABEL: f64 = 16.0;
/// The space right of the bars for the column of their values in px.
const NUMBERS: f64 = 82.0;
/// The width for a tick in px.
const TICK: f64 = 110.0;

/// A horizontal bar or dot chart, in the given order.
#[derive(Debug, Clone)]
pub struct Bars {
    /// See [`Figure::id`].
    pub id: String,
    /// See [`Figure::title`].
    pub title: String,
    /// See [`Figure::caption`].
    pub caption: String,
    /// The axis of the values.
    pub x: Axis,
    /// From top to bottom.
    pub bars: Vec<Bar>,
    /// A value to compare them with, drawn as a vertical line, and its name.
    pub limit: Option<(f64, String)>,
}

/// A named value.
#[derive(Debug, Clone)]
pub struct Bar {
    /// The name next to the bar.
    pub name: String,
    /// Whether it has the color of its name ([`style::style`]); the others are gray.
    pub accent: bool,
    /// The value.
    pub value: f64,
    /// The text in the column of values, for example the value.
    pub amount: String,
    /// Other values of the same kind, drawn pale.
    pub others: Vec<f64>,
}

impl Bars {
    fn range(&self) -> (f64, f64) {
        let scale = self.x.scale;
        let limit = self.limit.iter().map(|(value, _)| *value);
        let own = self.bars.iter().flat_map(|bar| bar.others.iter().copied().chain([bar.value]));
        let values = own.chain(limit);
        let positions = values.filter_map(|value| scale.position(value));
        match scale {
            Scale::Linear | Scale::Symmetric(_) => {
                scale.range(positions.chain([0.0])).unwrap_or((0.0, 1.0))
            }
            Scale::Log => scale.range(positions).unwrap_or((0.0, 1.0)),
        }
    }
}

impl Figure for Bars {
    fn id(&self) -> &str {
        &self.id
    }

    fn title(&self) -> &str {
        &self.title
    }

    fn caption(&self) -> &str {
        &self.caption
    }

    fn drawn(&self, wide: f64, id: &str) -> String {
        let longest =
            self.bars.iter().map(|bar| style::width(&bar.name, TEXT)).fold(40.0, f64::max);
        // On a narrow picture long names stand above their bars.
        let is_above = wide < style::WIDTH && longest > MOST_BESIDE * wide;
        let left = style::EDGE + 12.0 + if is_above { 0.0 } else { longest.min(260.0) };
        let row = if self.bars.len() > MANY { CLOSE } else { PITCH };
        let (above, pitch) = if is_above { (NAME, row + NAME) } else { (0.0, row) };
        let tall = pitch * self.bars.len().max(1) as f64;
        let head = if self.limit.is_some() { TOP + LABEL } else { TOP };
        let (mut canvas, lower) = Canvas::titled(wide, head + tall + 58.0, &self.title);
        let top = head + lower;
        let bottom = top + tall;
        let x = self.range();
        let frame = Frame { x, y: (0.0, 1.0), left, right: wide - NUMBERS, top, bottom };
        let ticks = self.x.scale.ticks(x, (wide / TICK) as usize);
        let start = if self.x.scale == Scale::Linear { 0.0 } else { x.0 };

        canvas.layer("class=\"grid\"", |layer| {
            let plane = frame.plane(layer);
            ticks.iter().map(|tick| (tick.at, GRID)).chain([(start, FAINT_INK)]).try_for_each(
                |(at, color)| {
                    plane.draw(&PathElement::new([(at, 0.0), (at, 1.0)], stroke(color, 1.0)))
                },
            )
        });
        let middle = |k: usize| top + pitch * k as f64 + above + row / 2.0;
        let (from, _) = frame.place((start, 0.0));
        let end = |bar: &Bar| self.x.scale.position(bar.value).map(|at| frame.place((at, 0.0)).0);
        let limit = self.limit.as_ref().and_then(|(value, _)| self.x.scale.position(*value));
        let line = limit.map_or(f64::NAN, |at| frame.place((at, 0.0)).0);
        let mut description = format!("{}: ", self.x.heading());
        canvas.raw(&points::panel(&frame, &self.x, None));
        if let Some((value, name)) = &self.limit
            && limit.is_some()
        {
            canvas.layer("class=\"limit\"", |layer| {
                let ends = [(fine(line), fine(top)), (fine(line), fine(bottom))];
                layer.draw(&PathElement::new(ends, stroke(INK, 1.5)))
            });
            // On a narrow picture a long name begins at the edge.
            let (x, anchor) = match line - 0.5 * style::width(name, TEXT) < style::EDGE {
                true => (style::EDGE, Anchor::Start),
                false => (line, Anchor::Middle),
            };
            canvas.text((x, top - 6.0), anchor, TEXT, INK, name);
            description += &format!("{name} {}; ", readable(*value, 3));
        }
        for (k, bar) in self.bars.iter().enumerate() {
            let (middle, end) = (middle(k), end(bar));
            let to = end.unwrap_or(from);
            // The position of the bar, as a fraction of the frame's height from below.
            let up = 1.0 - (middle - top) / tall;
            canvas.raw(&format!(
                "<g class=\"series\" data-series=\"{}\" data-points=\"{}\">\n",
                escape(&bar.name),
                points::listed(&[((bar.value, up), end.map(|x| (x, middle)))])
            ));
            let (r, g, b) = if bar.accent { style::style(&bar.name).color } else { GRAY };
            let color = RGBColor(r, g, b);
            let dot = self.x.scale == Scale::Log;
            canvas.layer("class=\"bar\"", |layer| {
                // A line leads from the name to the number.
                let (half, of_bar, to_line) = match dot {
                    true => (0.6, GRID, frame.right),
                    false => (THICKNESS / 2.0, color, to),
                };
                let corners = [
                    (fine(from.min(to_line)), fine(middle - half)),
                    (fine(from.max(to_line)), fine(middle + half)),
                ];
                layer.draw(&Rectangle::new(corners, of_bar.filled()))?;
                for at in bar.others.iter().filter_map(|value| self.x.scale.position(*value)) {
                    let at = fine(frame.place((at, 0.0)).0);
                    let pale = color.mix(0.35).filled();
                    match dot {
                        true => layer.draw(&Circle::new((at, fine(middle)), fine(0.6 * DOT), pale)),
                        false => {
                            let from = (corners[1].0, corners[0].1);
                            layer.draw(&Rectangle::new([from, (at, corners[1].1)], pale))
                        }
                    }?;
                }
                let radius = if dot && end.is_some() { fine(DOT) } else { 0 };
                layer.draw(&Circle::new((fine(to), fine(middle)), radius, color.filled()))
            });
            canvas.raw("</g>\n");
            let (name, anchor) = match is_above {
                true => ((left, middle - row / 2.0), Anchor::Start),
                false => ((left - 10.0, middle + 5.0), Anchor::End),
            };
            canvas.text(name, anchor, TEXT, INK, &bar.name);
            canvas.text((wide - style::EDGE, middle + 5.0), Anchor::End, TEXT, INK, &bar.amount);
            description += &format!("{} {}; ", bar.name, bar.amount);
        }
        canvas.raw("</g>\n");
        for tick in &ticks {
            let (x, _) = frame.place((tick.at, 0.0));
            canvas.text((x, bottom + 19.0), Anchor::Middle, TEXT, FAINT_INK, &tick.label);
        }
        let middle = (frame.left + frame.right) / 2.0;
        canvas.text((middle, bottom + 42.0), Anchor::Middle, TEXT, INK, &self.x.heading());
        canvas.finish(id, &self.title, description.trim_end_matches("; "))
    }

    fn csv(&self) -> String {
        let mut out = String::new();
        csv::record(&mut out, ["name", &self.x.heading(), "drawn"]);
        for bar in &self.bars {
            csv::record(&mut out, [&bar.name, &csv::number(bar.value), "dark"]);
            for value in &bar.others {
                csv::record(&mut out, [&bar.name, &csv::number(*value), "pale"]);
            }
        }
        if let Some((value, name)) = &self.limit {
            csv::record(&mut out, [name, &csv::number(*value), "line"]);
        }
        out
    }
}
