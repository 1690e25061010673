//! Documents for explanations and other results, as plain data, and their output formats: aligned
//! text for a terminal, Markdown with LaTeX, and a self-contained page.
//!
//! A document has only what every format can show: text without markup, formulas, tables and
//! pictures. A [`Page`](crate::page::Page) has what only a browser can: markup, sortable cells,
//! animations, collapsed parts. A document is written as a page by [`Block::on_page`].

mod html;
mod markdown;
pub mod notation;
mod show;
pub(crate) mod text;
mod unicode;

pub use html::lead;
pub use show::Show;
pub use unicode::unicode;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::page::Picture;
use lcplab_lcp::error::Result;
use lcplab_lcp::number::capitalized;
use notation::{latex, plain};

/// The largest number of rows and columns of a matrix, and of rows of a table, that are written.
pub const SHOWN: usize = 12;

/// The output formats of a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Aligned lines for a terminal.
    Text,
    /// Aligned lines with bold headings and faint marks, by ANSI escape sequences.
    ColoredText,
    /// Markdown with formulas in LaTeX between dollar signs.
    Markdown,
    /// A self-contained page, with formulas as MathML.
    Html,
}

/// Text, formulas, tables and pictures, in sections.
///
/// ```
/// use lcplab_page::document::{Block, Document, Format, Formula, Section, Table};
/// use lcplab_page::page::Picture;
///
/// let mut section = Section::new("the weight");
/// section.say("A box of 2 kg on the ground.");
/// let formula = Formula::default().symbols("m g = ", "m g = ").number(19.62).unit("N");
/// section.formula(formula);
/// section.formula(Formula::default().symbols("A = ", "A = ").matrix(1, 2, |_, j| j as f64));
/// section.formula(Formula::default().symbols("b = ", "b = ").vector(&[1.0, 2.0]));
/// section.table("forces", &["row", "x (N)"], vec![vec!["normal".into(), "19.62".into()]]);
/// section.figure(Picture { caption: "The box.".into(), ..Picture::default() });
/// section.blocks.push(Block::Table(Table::whole("masses", &["kg"], vec![vec!["2".into()]])));
///
/// let mut document = Document { title: "A box".into(), ..Document::default() };
/// document.add("Step 1", section); // a part of that section
/// assert_eq!(document.sections[0].title, "Step 1");
/// let text = document.written(Format::Text)?;
/// assert!(text.contains("A box of 2 kg on the ground.") && text.contains("19.62"));
/// let blocks = &document.sections[0].blocks;
/// assert_eq!(blocks[0].text(), "\nThe weight\n");
/// assert!(blocks[2].text().contains("19.62") && blocks[2].markdown().contains("19.62"));
/// assert_eq!(blocks[3].to_json()["formula"], serde_json::json!(["A = ", [["0", "1"]]]));
/// assert!(matches!(blocks[1].on_page(), lcplab_page::page::Block::Text(_)));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Document {
    /// The heading.
    pub title: String,
    /// The subject, in a sentence or two.
    pub lead: String,
    /// The sections, in the order of the derivation.
    pub sections: Vec<Section>,
    /// Whether the judge accepted every answer in the document.
    pub is_accepted: bool,
}

/// A section with a heading.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Section {
    /// The heading.
    pub title: String,
    /// The contents.
    pub blocks: Vec<Block>,
}

/// A block of a section. Text is plain: it contains no markup.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Block {
    /// The heading of a part of the section.
    Heading(String),
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
    /// The unit of the result; empty if it has none.
    pub unit: String,
}

/// A part of a formula.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Piece {
    /// Symbols, for a terminal and in LaTeX.
    Symbols {
        /// Unicode.
        text: String,
        /// LaTeX.
        latex: String,
    },
    /// A matrix, or a vector as a column.
    Grid(Grid),
}

/// A matrix of numbers; at most [`SHOWN`] rows and columns are written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// The entries to write, by rows.
    pub entries: Vec<Vec<f64>>,
    /// The number of rows of the whole matrix.
    pub height: usize,
    /// The number of columns of the whole matrix.
    pub width: usize,
}

/// A table.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Table {
    /// One line, unique among the tables of the document.
    pub title: String,
    /// The headings, including units.
    pub columns: Vec<String>,
    /// The rows; each has one cell per column.
    pub rows: Vec<Vec<String>>,
    /// The number of omitted rows.
    pub left_out: usize,
    /// The row that the text around it is about, bold on a page.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chosen: Option<usize>,
    /// Whether a page keeps columns that say the same in every row, as in a matrix.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub keeps_columns: bool,
}

impl Table {
    /// A table, all of whose rows are shown.
    pub fn whole(title: impl Into<String>, columns: &[&str], rows: Vec<Vec<String>>) -> Self {
        let columns = columns.iter().map(|title| title.to_string()).collect();
        Table { title: title.into(), columns, rows, ..Table::default() }
    }
}

impl Section {
    /// A section without contents.
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

    /// Adds a table; keeps at most [`SHOWN`] rows, and omits empty columns.
    pub fn table(&mut self, title: &str, columns: &[&str], mut rows: Vec<Vec<String>>) {
        let left_out = rows.len().saturating_sub(SHOWN);
        rows.truncate(SHOWN);
        let is_kept = |c: usize| rows.is_empty() || rows.iter().any(|row| !row[c].is_empty());
        let kept: Vec<usize> = (0..columns.len()).filter(|c| is_kept(*c)).collect();
        let columns: Vec<&str> = kept.iter().map(|c| columns[*c]).collect();
        let rows = rows.iter().map(|row| kept.iter().map(|c| row[*c].clone()).collect()).collect();
        let table = Table { left_out, ..Table::whole(title, &columns, rows) };
        self.blocks.push(Block::Table(table));
    }
}

impl Document {
    /// The document in one of its output formats.
    ///
    /// # Errors
    /// If a formula cannot be converted to MathML.
    pub fn written(&self, format: Format) -> Result<String> {
        match format {
            Format::Text => Ok(text::written(self, text::Ink::Plain)),
            Format::ColoredText => Ok(text::written(self, text::Ink::Colored)),
            Format::Markdown => Ok(markdown::written(self)),
            Format::Html => html::written(self),
        }
    }

    /// Adds a section; if `place` is not empty, as a part of the section with that title. The place
    /// precedes the titles of tables, to keep them unique.
    pub fn add(&mut self, place: &str, mut section: Section) {
        let titled = |title: &str| match place {
            "" => capitalized(title),
            place => format!("{place}, {title}"),
        };
        for block in &mut section.blocks {
            if let Block::Table(table) = block {
                table.title = titled(&table.title);
            }
        }
        let title = capitalized(&section.title);
        if place.is_empty() {
            self.sections.push(Section { title, ..section });
            return;
        }
        if self.sections.last().is_none_or(|last| last.title != place) {
            self.sections.push(Section::new(place));
        }
        if let Some(part) = self.sections.last_mut() {
            part.blocks.push(Block::Heading(title));
            part.blocks.extend(section.blocks);
        }
    }
}

impl Block {
    /// The block for a script that shows it: words, a table, or the pieces of a formula, where a
    /// matrix is a list of rows.
    pub fn to_json(&self) -> Value {
        let piece = |piece: &Piece| match piece {
            Piece::Symbols { text, .. } => json!(text),
            Piece::Grid(grid) => json!(grid.cells(plain, ["…", "⋮", "⋱"])),
        };
        match self {
            Block::Heading(words) => json!({ "heading": words }),
            Block::Text(words) => json!({ "text": words }),
            Block::Formula(own) => json!({
                "formula": own.pieces.iter().map(piece).collect::<Value>(),
                "remark": format!("{} {}", own.unit, own.left_out()).trim(),
            }),
            Block::Table(own) => json!({
                "table": own.title, "columns": own.columns, "rows": own.rows, "left_out": own.left_out,
                "numeric": (0..own.columns.len()).map(|c| own.is_numeric(c)).collect::<Value>(),
            }),
            Block::Figure(own) => json!({ "text": own.caption }),
        }
    }
}

impl Formula {
    /// Adds symbols: for a terminal, and in LaTeX.
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

    /// Sets the unit.
    pub fn unit(self, unit: impl Into<String>) -> Self {
        Formula { unit: unit.into(), ..self }
    }

    /// A note on the omitted rows and columns of its matrices; empty if nothing is omitted.
    pub(crate) fn left_out(&self) -> String {
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
    /// Whether a column contains only numbers.
    pub(super) fn is_numeric(&self, column: usize) -> bool {
        let number =
            |cell: &String| cell.chars().all(|c| "0123456789.−–×⁰¹²³⁴⁵⁶⁷⁸⁹⁻∞± ,/[]%<".contains(c));
        let is_filled = |row: &Vec<String>| !row[column].is_empty();
        self.rows.iter().any(is_filled) && self.rows.iter().all(|row| number(&row[column]))
    }
}

impl Grid {
    /// The entries to write, formatted by `number`; `dots` mark omitted entries to the right,
    /// below, and in the corner.
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
