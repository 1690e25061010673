//! A sparsity pattern as a raster of square cells, small enough to be stored and drawn.

use std::fmt::Write;

use serde::{Deserialize, Serialize};

use super::canvas::hex;

/// The shades of cells by the fraction of nonzero entries, palest first.
const SHADES: [(f64, (u8, u8, u8)); 5] = [
    (0.05, (158, 202, 225)),
    (0.15, (107, 174, 214)),
    (0.35, (49, 130, 189)),
    (0.7, (8, 81, 156)),
    (f64::INFINITY, (8, 40, 94)),
];
/// The shade if a cell is a single entry.
const ENTRY: usize = SHADES.len() - 2;

/// A pattern as a raster.
///
/// ```
/// use lcplab_page::plot::Raster;
///
/// // The diagonal of a 4 × 4 matrix, in 2 × 2 cells.
/// let raster = Raster::new((4, 4), 2, |mark| (0..4).for_each(|i| mark(i, i)));
/// assert_eq!((raster.block, raster.nonzeros), (2, 4));
/// assert!(raster.key().contains("cells of 2 × 2"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Raster {
    /// Rows of the matrix.
    pub rows: usize,
    /// Its columns.
    pub columns: usize,
    /// Nonzero entries.
    pub nonzeros: usize,
    /// Entries along a side of a cell.
    pub block: usize,
    /// One string per line of cells: `0` for an empty cell, `1` to `5` for shades, palest first;
    /// empty cells at the end of a line are omitted.
    pub cells: Vec<String>,
}

impl Raster {
    /// The raster of a rows × columns pattern with at most `side` cells along each side; `draw`
    /// marks each nonzero position (row, column) exactly once.
    pub fn new(
        (rows, columns): (usize, usize),
        side: usize,
        draw: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self {
        let block = rows.max(columns).div_ceil(side).max(1);
        let (lines, width) = (rows.div_ceil(block), columns.div_ceil(block));
        let mut counts = vec![0_usize; lines * width];
        draw(&mut |row, column| counts[row / block * width + column / block] += 1);
        let digit = |line: usize, cell: usize| {
            // A cell at the edge may have fewer entries.
            let entries = block.min(rows - line * block) * block.min(columns - cell * block);
            let shade = match counts[line * width + cell] {
                0 => return '0',
                _ if block == 1 => ENTRY,
                count => {
                    let density = count as f64 / entries as f64;
                    SHADES.iter().position(|(limit, _)| density <= *limit).unwrap_or(0)
                }
            };
            char::from(b'1' + shade as u8)
        };
        let line = |line| {
            let cells: String = (0..width).map(|cell| digit(line, cell)).collect();
            cells.trim_end_matches('0').to_string()
        };
        let cells = (0..lines).map(line).collect();
        Raster { rows, columns, nonzeros: counts.iter().sum(), block, cells }
    }

    /// What a cell shows, as the end of a sentence; empty if it is a single entry.
    pub fn key(&self) -> String {
        match self.block {
            0 | 1 => String::new(),
            block => {
                format!("; cells of {block} × {block}, darker if more are nonzero")
            }
        }
    }

    /// The nonempty cells: line, position in the line, shade from 0.
    fn shaded(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let line = |(line, cells): (usize, &String)| {
            let shades: Vec<u8> = cells.bytes().collect();
            let cells = shades.into_iter().enumerate().filter(|(_, digit)| *digit > b'0');
            cells.map(move |(cell, digit)| {
                (line, cell, usize::from(digit - b'1').min(SHADES.len() - 1))
            })
        };
        self.cells.iter().enumerate().flat_map(line)
    }

    /// The cells as SVG, from the top left corner; an entry is `wide` × `high` px. One path for
    /// each shade; adjacent cells of the same shade in a line are one rectangle.
    pub(super) fn markup(&self, (left, top): (f64, f64), (wide, high): (f64, f64)) -> String {
        let block = self.block;
        let mut paths = vec![String::new(); SHADES.len()];
        let shaded: Vec<_> = self.shaded().collect();
        let joined =
            shaded.chunk_by(|a, b| block > 1 && a.0 == b.0 && a.1 + 1 == b.1 && a.2 == b.2);
        // Single entries are drawn slightly smaller, so that each is visible.
        let gap = if block == 1 { 0.08 } else { 0.0 };
        for run in joined {
            let (i, j, shade) = run[0];
            let (x, y) = ((j * block) as f64 + gap, (i * block) as f64 + gap);
            let width = (run.len() * block).min(self.columns - j * block) as f64 - 2.0 * gap;
            let height = block.min(self.rows - i * block) as f64 - 2.0 * gap;
            let _ = write!(paths[shade], "M{x} {y}h{width}v{height}h-{width}z");
        }
        let sharp = if block > 1 { " shape-rendering=\"crispEdges\"" } else { "" };
        let mut markup = format!(
            "<g transform=\"translate({left:.1} {top:.1}) scale({wide:.5} {high:.5})\"{sharp}>\n"
        );
        for (path, (_, color)) in paths.iter().zip(SHADES).filter(|(path, _)| !path.is_empty()) {
            let _ = writeln!(markup, "<path fill=\"{}\" d=\"{path}\"/>", hex(color));
        }
        markup + "</g>\n"
    }
}
