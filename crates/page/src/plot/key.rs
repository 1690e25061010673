//! Labels of curves in rows above a panel: on a narrow picture, labels at the ends of the curves
//! can leave too little width for the plot.

use std::collections::BTreeMap;

use super::canvas::{Anchor, Canvas, escape};
use super::ends;
use super::legend::{Drawn, SAMPLE};
use super::line::{Lines, MARGIN};
use super::panel::Panel;
use super::style::{self, INK, TEXT, width};

/// The height of a line of text, the space between two labels, and the space between a sample of a
/// curve and its label, in px.
const LINE: f64 = 18.0;
const BETWEEN: f64 = 18.0;
const GAP: f64 = 6.0;

/// The labels of a panel, with the positions of their samples relative to its top.
pub(super) struct Key<'a> {
    labels: Vec<Label<'a>>,
    /// The height in px; 0 without labels.
    pub height: f64,
}

struct Label<'a> {
    name: &'a str,
    lines: Vec<String>,
    at: (f64, f64),
}

impl<'a> Key<'a> {
    /// The labels that stand above a panel of a picture of this width.
    pub fn new(panel: &'a Panel, figure: &Lines, x: (f64, f64), wide: f64) -> Self {
        let mut labels: Vec<Label<'a>> = Vec::new();
        let (mut across, mut down, mut height) = (style::EDGE, 0.0, 0.0);
        let right = wide - MARGIN;
        for (name, text) in ends::keyed(figure, panel, x, wide) {
            let lines = style::wrapped(text, TEXT, right - style::EDGE - SAMPLE - GAP);
            let widest = lines.iter().map(|line| width(line, TEXT)).fold(0.0, f64::max);
            let length = SAMPLE + GAP + widest;
            if across + length > right && across > style::EDGE {
                (across, down) = (style::EDGE, height);
            }
            height = f64::max(height, down + LINE * lines.len() as f64);
            labels.push(Label { name, lines, at: (across, down + LINE / 2.0) });
            across += length + BETWEEN;
        }
        Key { labels, height }
    }

    /// Draws it, from this height (px) on.
    pub fn draw(&self, canvas: &mut Canvas, top: f64, looks: &BTreeMap<&str, Drawn>) {
        for Label { name, lines, at: (x, y) } in &self.labels {
            canvas.raw(&format!("<g class=\"entry\" data-series=\"{}\">\n", escape(name)));
            looks[name].sample(canvas, (*x, top + y));
            for (k, line) in lines.iter().enumerate() {
                let at = (x + SAMPLE + GAP, top + y + LINE * k as f64 + 4.5);
                canvas.text(at, Anchor::Start, TEXT, INK, line);
            }
            canvas.raw("</g>\n");
        }
    }
}
