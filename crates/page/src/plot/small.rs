//! A sparsity pattern in a small square.

use super::canvas::{Anchor, Canvas};
use super::raster::Raster;
use super::spy;
use super::style::{self, FAINT_INK, INK, TEXT};

/// The height of a line of the name and of the note in px.
const LINE: f64 = 17.0;
/// The width of the indices of rows in px.
pub(super) const INDICES: f64 = 40.0;

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

impl Small {
    /// Its texts in lines of this width (px).
    fn words(&self, side: f64) -> Words {
        let wrapped = |text| style::wrapped(text, TEXT, side);
        Words { name: wrapped(&self.name), note: wrapped(&self.note) }
    }

    /// The height (px) of its texts and of the indices of its columns.
    pub(super) fn above(&self, side: f64) -> f64 {
        self.words(side).height() + LINE
    }

    /// Draws it with its texts, and with indices left of it and above it, in this width (px).
    pub(super) fn draw_named(&self, canvas: &mut Canvas, (left, top): (f64, f64), side: f64) {
        let corner = (left + INDICES, top + self.above(side));
        self.words(side).draw(canvas, (left, corner.1 - LINE));
        self.draw(canvas, corner, side - INDICES);
        let Raster { rows, columns, .. } = self.raster;
        spy::frame(canvas, corner, (side - INDICES, side - INDICES), (rows, columns));
    }

    fn draw(&self, canvas: &mut Canvas, (left, top): (f64, f64), side: f64) {
        let entries = self.raster.rows.max(self.raster.columns).max(1) as f64;
        let scale = side / entries;
        canvas.raw(&self.raster.markup((left, top), (scale, scale)));
        canvas.outline((left, top), (side, side));
    }
}

/// The texts above a panel, in lines.
struct Words {
    name: Vec<String>,
    note: Vec<String>,
}

impl Words {
    fn height(&self) -> f64 {
        6.0 + LINE * (self.name.len() + self.note.len()) as f64
    }

    /// Writes the lines so that they end above this corner of the panel.
    fn draw(&self, canvas: &mut Canvas, (left, top): (f64, f64)) {
        let name = self.name.iter().map(|line| (line, INK));
        let note = self.note.iter().map(|line| (line, FAINT_INK));
        let first = top - 7.0 - LINE * (self.name.len() + self.note.len() - 1) as f64;
        for (k, (line, ink)) in name.chain(note).enumerate() {
            canvas.text((left, first + LINE * k as f64), Anchor::Start, TEXT, ink, line);
        }
    }
}
