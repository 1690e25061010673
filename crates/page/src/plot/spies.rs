//! Sparsity patterns side by side, each in a small square.

use super::canvas::{Anchor, Canvas};
use super::raster::Raster;
use super::spy;
use super::style::{self, FAINT_INK, INK, TEXT};
use crate::csv;
use crate::figure::Figure;

/// The gap between panels, and the least distance from one to the next, in px.
const GAP: f64 = 16.0;
const LEAST: f64 = 125.0;
const TOP: f64 = 44.0;
/// The height of a line of the name and of the note in px.
const LINE: f64 = 17.0;
/// The width of the indices of rows in px.
pub(super) const INDICES: f64 = 40.0;

/// Patterns in a grid of panels.
#[derive(Debug, Clone)]
pub struct Spies {
    /// See [`Figure::id`].
    pub id: String,
    /// See [`Figure::title`].
    pub title: String,
    /// See [`Figure::caption`].
    pub caption: String,
    /// The largest number of panels side by side, positive; fewer on a narrow picture.
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

    fn drawn(&self, wide: f64, id: &str) -> String {
        let room = wide - 2.0 * style::EDGE + GAP;
        let across = self.across.min((room / LEAST) as usize).max(1);
        let pitch = room / across as f64;
        let side = pitch - GAP;
        let words: Vec<Words> = self.panels.iter().map(|panel| panel.words(side)).collect();
        let above = words.iter().map(Words::height).fold(0.0, f64::max);
        let lines = self.panels.len().div_ceil(across);
        let height = TOP + lines as f64 * (side + above + GAP);
        let (mut canvas, lower) = Canvas::titled(wide, height, &self.title);
        for (k, (panel, words)) in self.panels.iter().zip(&words).enumerate() {
            let left = style::EDGE + (k % across) as f64 * pitch;
            let top = TOP + lower + (k / across) as f64 * (side + above + GAP) + above;
            words.draw(&mut canvas, (left, top));
            panel.draw(&mut canvas, (left, top), side);
        }
        let names: Vec<&str> = self.panels.iter().map(|panel| panel.name.as_str()).collect();
        canvas.finish(id, &self.title, &names.join(", "))
    }

    /// One record per nonempty cell: the pattern, entries along a side of its cells, line,
    /// position, shade from 1 (pale) to 5.
    fn csv(&self) -> String {
        let mut out = String::from("pattern,entries per side,line,position,shade\n");
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

    pub(super) fn draw(&self, canvas: &mut Canvas, (left, top): (f64, f64), side: f64) {
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
