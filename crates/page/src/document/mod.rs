//! Explanations and exhibits as plain data, and the forms in which they can be written: aligned
//! text for a terminal, Markdown with LaTeX, and a page that needs nothing else.

mod html;
mod markdown;
pub mod notation;
mod show;
mod text;

pub use show::Show;

use serde::{Deserialize, Serialize};

use crate::page::Picture;
use lcplab_problem::error::Result;
use notation::{latex, plain};

/// At most so many rows and columns of a matrix, and lines of a table, are written.
pub const SHOWN: usize = 12;

/// The forms in which a document can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Aligned lines for a terminal.
    Text,
    /// The same with bold headings and faint marks, by ANSI escapes.
    ColouredText,
    /// Markdown with formulas in LaTeX between dollar signs.
    Markdown,
    /// A page that needs nothing else, with formulas as MathML.
    Html,
}

/// Words, formulas, tables and pictures, in sections.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Document {
    /// The heading.
    pub title: String,
    /// What is explained, in a sentence or two.
    pub lead: String,
    /// The parts, in the order of the derivation.
    pub sections: Vec<Section>,
    /// Whether every answer in it was accepted, by the judge's word.
    pub is_accepted: bool,
}

/// A part with a heading.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Section {
    /// The heading.
    pub title: String,
    /// The contents.
    pub blocks: Vec<Block>,
}

/// A piece of a section. Words are plain text; no sign in them means anything but itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// A formula on a line of its own.
    Formula(Formula),
    /// A table.
    Table(Table),
    /// A picture; a terminal and Markdown show its caption.
    Figure(Picture),
}

/// A formula: its pieces from left to right, and its unit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Formula {
    /// Symbols, numbers and matrices.
    pub pieces: Vec<Piece>,
    /// The unit of what it says; empty without one.
    pub unit: String,
}

/// A piece of a formula.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Piece {
    /// Symbols, as they are read on a terminal and in LaTeX.
    Symbols {
        /// Unicode.
        text: String,
        /// LaTeX.
        latex: String,
    },
    /// A matrix, or a vector as a column.
    Grid(Grid),
}

/// A matrix of numbers, of which the first [`SHOWN`] rows and columns are written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// The entries that are written, by rows.
    pub entries: Vec<Vec<f64>>,
    /// The number of rows that there are.
    pub height: usize,
    /// The number of columns that there are.
    pub width: usize,
}

/// A table.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Table {
    /// One line that no other table of the document has.
    pub title: String,
    /// The headings, units included.
    pub columns: Vec<String>,
    /// The lines; each has a cell a column.
    pub rows: Vec<Vec<String>>,
    /// How many more lines there would be.
    pub left_out: usize,
}

impl Section {
    /// A part without contents yet.
    pub fn new(title: impl Into<String>) -> Self {
        Section { title: title.into(), blocks: Vec::new() }
    }

    /// Adds a paragraph.
    pub fn say(&mut self, words: impl Into<String>) {
        self.blocks.push(Block::Text(words.into()));
    }

    /// Adds a formula.
    pub fn formula(&mut self, formula: Formula) {
        self.blocks.push(Block::Formula(formula));
    }

    /// Adds a picture.
    pub fn figure(&mut self, picture: Picture) {
        self.blocks.push(Block::Figure(picture));
    }

    /// Adds a table, of which at most [`SHOWN`] lines are kept, and no column without an entry.
    pub fn table(&mut self, title: &str, columns: &[&str], mut rows: Vec<Vec<String>>) {
        let left_out = rows.len().saturating_sub(SHOWN);
        rows.truncate(SHOWN);
        let is_kept = |c: usize| rows.is_empty() || rows.iter().any(|row| !row[c].is_empty());
        let kept: Vec<usize> = (0..columns.len()).filter(|c| is_kept(*c)).collect();
        let columns = kept.iter().map(|c| columns[*c].to_string()).collect();
        let rows = rows.iter().map(|row| kept.iter().map(|c| row[*c].clone()).collect()).collect();
        self.blocks.push(Block::Table(Table { title: title.into(), columns, rows, left_out }));
    }
}

impl Document {
    /// The document in one of its forms.
    ///
    /// # Errors
    /// If a formula cannot be set as MathML.
    pub fn written(&self, format: Format) -> Result<String> {
        match format {
            Format::Text => Ok(text::written(self, text::Ink::Plain)),
            Format::ColouredText => Ok(text::written(self, text::Ink::Coloured)),
            Format::Markdown => Ok(markdown::written(self)),
            Format::Html => html::written(self),
        }
    }

    /// Adds a part; its title and those of its tables get this before them, so that no two agree.
    pub fn add(&mut self, place: &str, mut section: Section) {
        let titled = |title: &str| match place {
            "" => capitalised(title),
            place => format!("{place}: {title}"),
        };
        section.title = titled(&section.title);
        for block in &mut section.blocks {
            if let Block::Table(table) = block {
                table.title = titled(&table.title);
            }
        }
        self.sections.push(section);
    }
}

fn capitalised(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    first + letters.as_str()
}

impl Formula {
    /// Adds symbols: as they are read on a terminal, and in LaTeX.
    pub fn symbols(mut self, text: &str, latex: &str) -> Self {
        self.pieces.push(Piece::Symbols { text: text.into(), latex: latex.into() });
        self
    }

    /// Adds a number.
    pub fn number(self, value: f64) -> Self {
        self.symbols(&plain(value), &latex(value))
    }

    /// Adds a matrix of this size with these entries.
    pub fn matrix(
        mut self,
        height: usize,
        width: usize,
        entry: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let line = |i| (0..width.min(SHOWN)).map(|j| entry(i, j)).collect();
        let entries = (0..height.min(SHOWN)).map(line).collect();
        self.pieces.push(Piece::Grid(Grid { entries, height, width }));
        self
    }

    /// Adds a vector as a column.
    pub fn vector(self, values: &[f64]) -> Self {
        self.matrix(values.len(), 1, |i, _| values[i])
    }

    /// Says the unit.
    pub fn unit(self, unit: impl Into<String>) -> Self {
        Formula { unit: unit.into(), ..self }
    }

    /// How much of its matrices is not written, in words; empty if nothing.
    pub fn left_out(&self) -> String {
        let grids = self.pieces.iter().filter_map(|piece| match piece {
            Piece::Grid(grid) => Some((grid.height, grid.width)),
            Piece::Symbols { .. } => None,
        });
        let largest = grids.fold((0, 0), |(r, c), (m, n)| (r.max(m), c.max(n)));
        match largest {
            (rows, columns) if rows > SHOWN && columns > SHOWN => {
                format!("({SHOWN} of {rows} rows and {SHOWN} of {columns} columns are written)")
            }
            (rows, _) if rows > SHOWN => format!("({SHOWN} of {rows} rows are written)"),
            (_, columns) if columns > SHOWN => {
                format!("({SHOWN} of {columns} columns are written)")
            }
            _ => String::new(),
        }
    }
}

impl Table {
    /// Whether a column has nothing but numbers.
    pub(super) fn is_numeric(&self, column: usize) -> bool {
        let number = |cell: &String| {
            !cell.is_empty()
                && cell.chars().all(|c| "0123456789.−×⁰¹²³⁴⁵⁶⁷⁸⁹⁻∞± \u{202f}".contains(c))
        };
        self.rows.iter().all(|row| number(&row[column]))
    }
}

impl Grid {
    /// The entries that are written, by `number`; `dots` are the signs for what follows to the
    /// right, below, and in the corner.
    pub(super) fn cells(&self, number: fn(f64) -> String, dots: [&str; 3]) -> Vec<Vec<String>> {
        let is_wide = self.width > SHOWN;
        let line = |row: &Vec<f64>| {
            let cells = row.iter().map(|&entry| number(entry));
            cells.chain(is_wide.then(|| dots[0].to_string())).collect()
        };
        let mut cells: Vec<Vec<String>> = self.entries.iter().map(line).collect();
        if self.height > SHOWN {
            let below = vec![dots[1].to_string(); self.width.min(SHOWN)];
            cells.push(below.into_iter().chain(is_wide.then(|| dots[2].into())).collect());
        }
        cells
    }
}
