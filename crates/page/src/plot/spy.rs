//! The sparsity pattern of a matrix: its nonzero entries.

use super::axis::Scale;
use super::canvas::{Anchor, Canvas};
use super::raster::Raster;
use super::style::{self, FAINT_INK, INK, TEXT};
use crate::csv;
use crate::figure::Figure;
use crate::number::{count, readable};
use lcplab_lcp::error::{Defects, Result};

/// The number of cells along the longer side; in larger matrices several entries share a cell.
const CELLS: usize = 160;
/// The largest height of the drawing, and the space beside it for its labels, in px.
const HEIGHT: f64 = 440.0;
const BESIDE: f64 = 160.0;
/// The height of a line of the subtitle in px.
const LINE: f64 = 18.0;

/// The sparsity pattern of a matrix.
///
/// ```
/// use lcplab_page::plot::Spy;
///
/// let spy = Spy::new("a", "The pattern of A", "", (2, 2), [(0, 0), (0, 1), (1, 1)])?;
/// assert_eq!((spy.nonzeros(), spy.fill()), (3, 75.0));
/// assert!(Spy::new("a", "", "", (2, 2), [(2, 0)]).is_err()); // outside of the matrix
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Spy {
    id: String,
    title: String,
    caption: String,
    rows: usize,
    columns: usize,
    /// Sorted, each entry once.
    entries: Vec<(usize, usize)>,
}

impl Spy {
    /// The pattern of a `rows` × `columns` matrix with these entries (row, column), counted from 0;
    /// duplicates count once.
    ///
    /// # Errors
    /// Lists every entry outside the matrix.
    pub fn new(
        id: impl Into<String>,
        title: impl Into<String>,
        caption: impl Into<String>,
        (rows, columns): (usize, usize),
        entries: impl IntoIterator<Item = (usize, usize)>,
    ) -> Result<Self> {
        let mut entries: Vec<_> = entries.into_iter().collect();
        entries.sort_unstable();
        entries.dedup();
        let mut defects = Defects::default();
        for (i, j) in entries.iter().filter(|(i, j)| *i >= rows || *j >= columns) {
            defects.add(format!("entry ({i}, {j})"), format!("is outside {rows} × {columns}"));
        }
        let title = title.into();
        defects.into_result(title.as_str())?;
        Ok(Spy { id: id.into(), title, caption: caption.into(), rows, columns, entries })
    }

    /// The number of nonzero entries.
    pub fn nonzeros(&self) -> usize {
        self.entries.len()
    }

    /// The percentage of nonzero entries; 0 for an empty matrix.
    pub fn fill(&self) -> f64 {
        let all = self.rows as f64 * self.columns as f64;
        if all > 0.0 { 100.0 * self.entries.len() as f64 / all } else { 0.0 }
    }

    /// The picture.
    fn raster(&self) -> Raster {
        Raster::new((self.rows, self.columns), CELLS, |mark| {
            self.entries.iter().for_each(|&(i, j)| mark(i, j));
        })
    }

    fn subtitle(&self, raster: &Raster) -> String {
        format!(
            "{} × {},  {} nonzeros,  {} % filled{}",
            count(self.rows),
            count(self.columns),
            count(self.nonzeros()),
            readable(self.fill(), 3),
            raster.key()
        )
    }
}

impl Figure for Spy {
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
        let (rows, columns) = (self.rows.max(1) as f64, self.columns.max(1) as f64);
        let scale = ((wide - BESIDE) / columns).min(HEIGHT.min(0.65 * wide) / rows).min(24.0);
        // A long thin matrix keeps a visible width.
        let (width, height) = ((columns * scale).max(12.0), (rows * scale).max(12.0));
        let raster = self.raster();
        let subtitle = self.subtitle(&raster);
        let lines = style::wrapped(&subtitle, TEXT, wide - 2.0 * style::EDGE);
        let below = 96.0 + LINE * lines.len().saturating_sub(1) as f64;
        let (mut canvas, lower) = Canvas::titled(wide, below + height + 14.0, &self.title);
        for (k, line) in lines.iter().enumerate() {
            let at = (style::EDGE, 50.0 + lower + LINE * k as f64);
            canvas.text(at, Anchor::Start, TEXT, FAINT_INK, line);
        }
        let (left, top) = ((wide - width) / 2.0 + 20.0, below + lower);
        canvas.raw(&raster.markup((left, top), (width / columns, height / rows)));
        canvas.text((left + width / 2.0, top - 24.0), Anchor::Middle, TEXT, INK, "column");
        canvas.raw(&format!("<g transform=\"rotate(-90 {:.1} {:.1})\">", left - 48.0, top));
        canvas.text((left - 48.0 - height / 2.0, top), Anchor::Middle, TEXT, INK, "row");
        canvas.raw("</g>\n");
        frame(&mut canvas, (left, top), (width, height), (self.rows, self.columns));
        canvas.finish(id, &self.title, &subtitle)
    }

    /// One record per entry, counted from 0.
    fn csv(&self) -> String {
        let mut out = String::from("row,column\n");
        for (i, j) in &self.entries {
            csv::record(&mut out, [i.to_string(), j.to_string()]);
        }
        out
    }
}

/// Draws the frame of a matrix with these numbers of rows and columns, and indices at its sides.
pub(super) fn frame(
    canvas: &mut Canvas,
    (left, top): (f64, f64),
    (width, height): (f64, f64),
    (rows, columns): (usize, usize),
) {
    canvas.outline((left, top), (width, height));
    for (index, at) in indices(columns, width) {
        canvas.text((left + at, top - 7.0), Anchor::Middle, TEXT, FAINT_INK, &count(index));
    }
    for (index, at) in indices(rows, height) {
        let at = (left - 7.0, top + at + 4.5);
        canvas.text(at, Anchor::End, TEXT, FAINT_INK, &count(index));
    }
}

/// Round indices along a side of this length, each with the position of its middle in px.
fn indices(size: usize, length: f64) -> Vec<(usize, f64)> {
    if size == 0 {
        return Vec::new();
    }
    let step = length / size as f64;
    let wanted = ((length / 60.0) as usize).clamp(1, size);
    let ticks = Scale::Linear.ticks((0.0, size as f64 - 0.5), wanted);
    ticks
        .into_iter()
        .filter(|tick| tick.at.fract() == 0.0 && tick.at >= 0.0)
        .map(|tick| (tick.at as usize, (tick.at + 0.5) * step))
        .collect()
}
