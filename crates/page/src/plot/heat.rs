//! Heat maps: a quantity by row and sweep as shades, which show where it is large and how it moves.
//!
//! The shades are those of *cividis* (Nuñez, Anderton & Renslow 2018), pale for small and dark for
//! large values: their lightness changes evenly, so they are readable for color-blind readers and
//! in gray.

use std::fmt::Write;

use super::axis::{Axis, Scale};
use super::canvas::{Anchor, Canvas, Frame, hex};
use super::style::{self, FAINT_INK, INK, TEXT};
use crate::csv;
use crate::figure::Figure;
use crate::number::{count, readable};

/// Cividis from dark to pale.
const SHADES: [(u8, u8, u8); 6] =
    [(0, 32, 77), (49, 68, 107), (102, 105, 112), (149, 143, 120), (203, 186, 105), (255, 234, 70)];
/// The number of shades of the scale.
const STEPS: usize = 30;
/// The number of decades below the largest value that the scale covers.
const DECADES: f64 = 12.0;

/// The gap between panels, and the height of their titles, in px.
const GAP: f64 = 22.0;
const LEFT: f64 = 34.0;
const TOP: f64 = 92.0;
const BELOW: f64 = 44.0;

/// A heat map with one logarithmic scale for all panels.
#[derive(Debug, Clone)]
pub struct Heat {
    /// See [`Figure::id`].
    pub id: String,
    /// See [`Figure::title`].
    pub title: String,
    /// See [`Figure::caption`].
    pub caption: String,
    /// The quantity along a panel, from left to right, with the values 0, 1, …
    pub across: String,
    /// The quantity from the bottom upward, with the values 0, 1, …
    pub upwards: String,
    /// The quantity shown as shades, at least 0; a value that is not finite is drawn as the
    /// largest.
    pub value: Axis,
    /// Values up to this are 0 up to rounding and are drawn white.
    pub zero: f64,
    /// The panels, two in a line.
    pub panels: Vec<Shaded>,
}

/// One panel.
#[derive(Debug, Clone)]
pub struct Shaded {
    /// Its title.
    pub name: String,
    /// The values by row, from the bottom; within a row from left to right.
    pub rows: Vec<Vec<f64>>,
}

/// The limits of the scale as decimal logarithms, and the largest value that counts as 0.
#[derive(Debug, Clone, Copy)]
struct Range {
    least: f64,
    most: f64,
    zero: f64,
}

impl Range {
    /// The index of a value's shade: `None` for 0.
    fn step(self, value: f64) -> Option<usize> {
        if value <= self.zero {
            return None;
        }
        let length = (self.most - self.least).max(f64::MIN_POSITIVE);
        let share = if value.is_finite() { (value.log10() - self.least) / length } else { 1.0 };
        Some(((share.clamp(0.0, 1.0) * STEPS as f64) as usize).min(STEPS - 1))
    }
}

/// The color of a shade, 0 the palest.
fn shade(step: usize) -> (u8, u8, u8) {
    let place = (1.0 - (step as f64 + 0.5) / STEPS as f64) * (SHADES.len() - 1) as f64;
    let k = (place as usize).min(SHADES.len() - 2);
    let blend = |a: u8, b: u8| {
        (f64::from(a) + (place - k as f64) * (f64::from(b) - f64::from(a))).round() as u8
    };
    let (a, b) = (SHADES[k], SHADES[k + 1]);
    (blend(a.0, b.0), blend(a.1, b.1), blend(a.2, b.2))
}

impl Heat {
    fn range(&self) -> Range {
        let values = self.panels.iter().flat_map(|panel| panel.rows.iter().flatten());
        let logs = values.filter(|v| v.is_finite() && **v > self.zero.max(0.0)).map(|v| v.log10());
        let (least, most) = logs
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), log| (lo.min(log), hi.max(log)));
        if least > most {
            return Range { least: -1.0, most: 0.0, zero: self.zero };
        }
        let least = least.floor().max(most.ceil() - DECADES).min(most.ceil() - 1.0);
        Range { least, most: most.ceil(), zero: self.zero }
    }

    /// The scale of shades below the title, as wide as the text beside it allows.
    fn draw_scale(&self, canvas: &mut Canvas, range: Range, wide: f64, lower: f64) {
        let heading = style::width(&self.value.heading(), TEXT);
        let (left, top, height) = (style::EDGE + 14.0, 50.0 + lower, 12.0);
        let width = (wide - left - heading - 100.0).min(330.0);
        let step = width / STEPS as f64;
        for k in 0..STEPS {
            canvas.raw(&format!(
                "<rect x=\"{:.2}\" y=\"{top}\" width=\"{:.2}\" height=\"{height}\" fill=\"{}\"/>\n",
                left + step * k as f64,
                // No gaps between shades.
                step + 0.3,
                hex(shade(k))
            ));
        }
        let frame = Frame {
            x: (range.least, range.most),
            y: (0.0, 1.0),
            left,
            right: left + width,
            top,
            bottom: top + height,
        };
        for tick in Scale::Log.ticks(frame.x, (width / 55.0) as usize) {
            let (x, _) = frame.place((tick.at, 0.0));
            canvas.text((x, top + 27.0), Anchor::Middle, TEXT, FAINT_INK, &tick.label);
        }
        let after = left + width + 16.0;
        canvas.text((after, top + 11.0), Anchor::Start, TEXT, INK, &self.value.heading());
        let zero = after + heading + 24.0;
        canvas.outline((zero, top), (18.0, height));
        canvas.text((zero + 26.0, top + 11.0), Anchor::Start, TEXT, INK, "0");
    }

    fn describe(&self, panel: &Shaded) -> String {
        let last = |row: &Vec<f64>| row.last().copied().unwrap_or(0.0);
        let largest = |at: &dyn Fn(&Vec<f64>) -> f64| panel.rows.iter().map(at).fold(0.0, f64::max);
        format!(
            "{}: {} rows, {} columns ({}); the largest value goes from {} to {}",
            panel.name,
            count(panel.rows.len()),
            count(panel.places()),
            self.across,
            readable(largest(&|row| row.first().copied().unwrap_or(0.0)), 2),
            readable(largest(&last), 2)
        )
    }
}

impl Figure for Heat {
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
        let across = self.panels.len().clamp(1, 2);
        let lines = self.panels.len().div_ceil(across).max(1);
        let width = (wide - 2.0 * style::EDGE + GAP) / across as f64 - GAP - LEFT;
        let tallest = self.panels.iter().map(|panel| panel.rows.len()).max().unwrap_or(1);
        let height = (9.0 * tallest as f64).clamp(80.0, 260.0).min(width);
        let pitch = height + 28.0 + BELOW;
        let range = self.range();

        let (mut canvas, lower) = Canvas::titled(wide, TOP + pitch * lines as f64, &self.title);
        self.draw_scale(&mut canvas, range, wide, lower);
        for (k, panel) in self.panels.iter().enumerate() {
            let left = style::EDGE + LEFT + (width + LEFT + GAP) * (k % across) as f64;
            let top = TOP + lower + 28.0 + pitch * (k / across) as f64;
            panel.draw(&mut canvas, (left, top), (width, height), range);
            canvas.text((left, top - 9.0), Anchor::Start, TEXT, INK, &panel.name);
            let middle = (left + width / 2.0, top + height + 36.0);
            canvas.text(middle, Anchor::Middle, TEXT, INK, &self.across);
            if k % across == 0 {
                let (x, y) = (left - 26.0, top + height / 2.0);
                canvas.raw(&format!("<g transform=\"rotate(-90 {x:.1} {y:.1})\">"));
                canvas.text((x, y), Anchor::Middle, TEXT, INK, &self.upwards);
                canvas.raw("</g>\n");
            }
        }
        let words: Vec<String> = self.panels.iter().map(|panel| self.describe(panel)).collect();
        let description = format!("{} as shades. {}.", self.value.heading(), words.join("; "));
        canvas.finish(id, &self.title, &description)
    }

    /// One record per cell: panel, position upward, position across, value.
    fn csv(&self) -> String {
        let mut out = String::new();
        csv::record(&mut out, ["panel", &self.upwards, &self.across, &self.value.heading()]);
        for panel in &self.panels {
            for (i, row) in panel.rows.iter().enumerate() {
                for (k, value) in row.iter().enumerate() {
                    let places = [i.to_string(), k.to_string(), csv::number(*value)];
                    csv::record(&mut out, [panel.name.clone()].into_iter().chain(places));
                }
            }
        }
        out
    }
}

impl Shaded {
    /// The number of positions across.
    fn places(&self) -> usize {
        self.rows.iter().map(Vec::len).max().unwrap_or(0)
    }

    fn draw(
        &self,
        canvas: &mut Canvas,
        (left, top): (f64, f64),
        (width, height): (f64, f64),
        range: Range,
    ) {
        let (rows, places) = (self.rows.len().max(1) as f64, self.places().max(1) as f64);
        let (wide, high) = (width / places, height / rows);
        canvas.raw(&format!(
            "<g transform=\"translate({left:.1} {:.1}) scale({wide:.5} {:.5})\" \
             shape-rendering=\"crispEdges\">\n{}</g>\n",
            top + height,
            -high,
            self.paths(range)
        ));
        canvas.outline((left, top), (width, height));
        for (at, label) in whole(self.places(), width) {
            let x = left + (at as f64 + 0.5) * wide;
            canvas.text((x, top + height + 17.0), Anchor::Middle, TEXT, FAINT_INK, &label);
        }
        for (at, label) in whole(self.rows.len(), 2.0 * height) {
            let y = top + height - (at as f64 + 0.5) * high + 4.0;
            canvas.text((left - 5.0, y), Anchor::End, TEXT, FAINT_INK, &label);
        }
    }

    /// One path for each shade; adjacent cells of the same shade in a row are one rectangle, which
    /// overlaps the next, so that no seam is printed.
    fn paths(&self, range: Range) -> String {
        let mut paths = vec![String::new(); STEPS];
        for (i, row) in self.rows.iter().enumerate() {
            let mut from = 0;
            for run in row.chunk_by(|a, b| range.step(*a) == range.step(*b)) {
                if let Some(step) = range.step(run[0]) {
                    let _ =
                        write!(paths[step], "M{from} {i}h{0}v1.04h-{0}z", run.len() as f64 + 0.04);
                }
                from += run.len();
            }
        }
        let drawn = paths.iter().enumerate().filter(|(_, path)| !path.is_empty());
        drawn
            .map(|(k, path)| format!("<path fill=\"{}\" d=\"{path}\"/>\n", hex(shade(k))))
            .collect()
    }
}

/// Round positions below `places`, about as many as fit along a side of this length.
fn whole(places: usize, length: f64) -> Vec<(usize, String)> {
    let wanted = ((length / 60.0) as usize).max(1);
    let ticks = Scale::Linear.ticks((0.0, places as f64 - 0.5), wanted);
    let whole = ticks.into_iter().filter(|tick| tick.at.fract() == 0.0 && tick.at >= 0.0);
    whole.map(|tick| (tick.at as usize, tick.label)).collect()
}
