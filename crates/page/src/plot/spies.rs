//! Sparsity patterns side by side, each in a small square.

use plotters::prelude::*;

use super::canvas::{Anchor, Canvas, fine, stroke};
use super::raster::Raster;
use super::style::{self, FAINT_INK, INK, TEXT};
use crate::csv;
use crate::figure::Figure;

/// The gap between panels, and the height of the two lines of text above each, in px.
const GAP: f64 = 16.0;
const WORDS: f64 = 40.0;
const TOP: f64 = 44.0;
/// Text size of the second line in px.
const SMALL: f64 = 12.0;

/// Patterns in a grid of panels.
#[derive(Debug, Clone)]
pub struct Spies {
    /// See [`Figure::id`].
    pub id: String,
    /// See [`Figure::title`].
    pub title: String,
    /// See [`Figure::caption`].
    pub caption: String,
    /// The number of panels side by side, positive.
    pub across: usize,
    /// The panels, from left to right, then down.
    pub panels: Vec<Small>,
}

/// A small picture of a sparsity pattern.
#[derive(Debug, Clone)]
pub struct Small {
    /// Its title.
    pub name: String,
    /// A short note.
    pub note: String,
    /// The pattern.
    pub raster: Raster,
}

impl Figure for Spies {
    fn id(&self) -> &str {
        &self.id
    }

    fn title(&self) -> &str {
        &self.title
    }

    fn caption(&self) -> &str {
        &self.caption
    }

    fn svg(&self) -> String {
        let across = self.across.max(1);
        let pitch = (style::WIDTH - 2.0 * style::EDGE + GAP) / across as f64;
        let side = pitch - GAP;
        let lines = self.panels.len().div_ceil(across);
        let mut canvas = Canvas::titled(TOP + lines as f64 * (side + WORDS + GAP), &self.title);
        for (k, panel) in self.panels.iter().enumerate() {
            let left = style::EDGE + (k % across) as f64 * pitch;
            let top = TOP + (k / across) as f64 * (side + WORDS + GAP) + WORDS;
            panel.draw(&mut canvas, (left, top), side);
        }
        let names: Vec<&str> = self.panels.iter().map(|panel| panel.name.as_str()).collect();
        canvas.finish(&self.id, &self.title, &names.join(", "))
    }

    /// One record per nonempty cell: the pattern, entries along a side of its cells, line,
    /// position, shade from 1 (pale) to 5.
    fn csv(&self) -> String {
        let mut out = String::from("pattern,entries a side,line,place,shade\n");
        for Small { name, raster, .. } in &self.panels {
            for cell in raster.records() {
                let head = [name.clone(), raster.block.to_string()];
                csv::record(&mut out, head.into_iter().chain(cell));
            }
        }
        out
    }
}

impl Small {
    fn draw(&self, canvas: &mut Canvas, (left, top): (f64, f64), side: f64) {
        canvas.text((left, top - 23.0), Anchor::Start, TEXT, INK, &self.name);
        canvas.text((left, top - 7.0), Anchor::Start, SMALL, FAINT_INK, &self.note);
        let entries = self.raster.rows.max(self.raster.columns).max(1) as f64;
        let scale = side / entries;
        canvas.raw(&self.raster.markup((left, top), (scale, scale)));
        let (right, bottom) = (left + side, top + side);
        canvas.layer("class=\"frame\"", |layer| {
            let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
            let corners = corners.map(|(x, y)| (fine(x), fine(y)));
            layer.draw(&PathElement::new(corners, stroke(FAINT_INK, 1.0)))
        });
    }
}
