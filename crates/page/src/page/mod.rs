//! Pages: documents as plain data, rendered to one self-contained HTML file each.
//!
//! The file loads nothing: equations are MathML, figures inline SVG, and the mathematics font is
//! embedded. Its Content-Security-Policy makes the browser enforce this and allow only the page's
//! own script, whatever the text contains. Titles, names and cells are plain text. A lead, text,
//! note, caption, column title and "how to read" may contain [`markup`]. The same page gives
//! bitwise the same file.

mod code;
pub mod markup;
mod mathml;
mod origin;
mod player;
mod render;

use serde::{Deserialize, Serialize};

use crate::figure::Figure;
use crate::{csv, number};
pub use origin::Origin;
pub use player::{Chart, DrawnAnimation, Pane, Player, SPEEDS, speed};
pub use render::base64;

/// A page.
///
/// ```
/// use lcplab_page::page::{Block, Page, Section};
///
/// let text = Block::Text("The *natural residual* is $|x - \\Pi(x - w)|$.".into());
/// let (id, title) = ("judge".into(), "The judge".into());
/// let section = Section { id, title, blocks: vec![text], ..Section::default() };
/// let page = Page { title: "Report".into(), sections: vec![section], ..Page::default() };
/// assert!(page.render()?.contains("<em>natural residual</em> is <span class=\"nobr\"><math>"));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Page {
    /// The heading, and the title of the browser tab.
    pub title: String,
    /// The content and conclusions of the page, in a few sentences.
    pub lead: String,
    /// What follows the lead before the first section, such as the main figure and [tiles](Tile).
    pub opening: Vec<Block>,
    /// The numbered sections.
    pub sections: Vec<Section>,
    /// Facts about the run for the page's footer: names and values.
    pub facts: Vec<(String, String)>,
    /// Whether readers can change and run the Python cells, if the page is served with a folder
    /// `python` next to it: [`PYTHON_WORKER`] as `worker.js`, and Pyodide as `pyodide`.
    pub runs_python: bool,
}

/// The script that runs the Python cells of a page outside of its main thread.
pub const PYTHON_WORKER: &str = include_str!("python_worker.js");

/// A numbered section of a page.
#[derive(Debug, Clone, Default)]
pub struct Section {
    /// The anchor, unique on the page: letters, digits, `-` and `_`.
    pub id: String,
    /// The heading.
    pub title: String,
    /// The contents.
    pub blocks: Vec<Block>,
    /// The part of it that is collapsed.
    pub fold: Fold,
    /// How its figures and tables were computed.
    pub origin: Option<Origin>,
}

/// The part of a section that is collapsed on the screen, and printed only if the reader opens it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fold {
    /// Nothing.
    #[default]
    Nothing,
    /// Tables.
    Tables,
    /// Everything after this number of blocks.
    After(usize),
}

impl Fold {
    /// Whether the block of a section at this place is collapsed.
    fn takes(self, place: usize, blocks: &[Block]) -> bool {
        match self {
            Fold::Nothing => false,
            Fold::Tables => matches!(blocks[place], Block::Table(_)),
            Fold::After(first) => place >= first,
        }
    }
}

/// A block of a section.
#[derive(Debug, Clone)]
pub enum Block {
    /// Paragraphs and lists.
    Text(String),
    /// Paragraphs and lists, only printed: what a screen shows when the pointer is on a part.
    Printed(String),
    /// Paragraphs and lists, collapsed under a short title; not printed.
    Aside {
        /// The title.
        title: String,
        /// The paragraphs and lists.
        text: String,
    },
    /// A displayed equation.
    Equation {
        /// LaTeX without delimiters.
        latex: String,
        /// A number or source set at the right, for example `K&M 23`.
        label: Option<String>,
    },
    /// A picture.
    Figure(Picture),
    /// The main results side by side.
    Tiles(Vec<Tile>),
    /// An animation of a scene.
    Player(Box<Player>),
    /// A grid of small pictures, each of which opens a block below itself.
    Thumbnails(Vec<Thumbnail>),
    /// A table.
    Table(Table),
    /// Source code or program output.
    Code {
        /// The language, `text` for output.
        language: String,
        /// The lines.
        text: String,
    },
    /// A Python cell.
    Python {
        /// The program.
        code: String,
        /// What it prints; may be empty.
        output: String,
    },
    /// Source code, collapsed.
    FoldedCode {
        /// The language.
        language: String,
        /// The lines.
        text: String,
    },
    /// Equivalent programs in two languages; one is shown at a time.
    Twin {
        /// Language and text of each piece in Python: a program and its output.
        python: Vec<(String, String)>,
        /// The same pieces in Rust.
        rust: Vec<(String, String)>,
    },
    /// A drawing that belongs to the text.
    Drawing {
        /// The SVG document, with its own style.
        svg: String,
        /// An alternative text for screen readers.
        alt: String,
    },
    /// A remark set apart from the text.
    Note(String),
    /// A page with its own script, which opens in place.
    Live(Live),
    /// A proof that the reader can check within the page.
    Proof(Proof),
}

/// A result in large type, with a link to its section.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tile {
    /// The number, such as `316 of 316`.
    pub value: String,
    /// What it counts, in a few words.
    pub label: String,
    /// The id of the section.
    pub section: String,
    /// Whether it is as it should be.
    pub good: bool,
}

/// A small picture with a title, which opens a block.
#[derive(Debug, Clone)]
pub struct Thumbnail {
    /// The anchor, unique on the page: letters, digits, `-` and `_`.
    pub id: String,
    /// A short name.
    pub name: String,
    /// What the picture shows, in a few words.
    pub title: String,
    /// An SVG document, put on the page unchanged.
    pub svg: String,
    /// The block that it opens.
    pub block: Block,
}

/// A live page embedded in another page.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Live {
    /// Its name: letters, digits, `-` and `_`.
    pub name: String,
    /// The title that the reader opens.
    pub title: String,
    /// The page as HTML; pages with the same name are stored once. Its own Content-Security-Policy
    /// states the hash of its script.
    pub html: String,
    /// The part of its address after `#`.
    pub state: String,
}

/// A proof on a page, with its problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// The problem file, as text.
    pub problem: String,
    /// The proof file, as text.
    pub text: String,
}

/// A numbered picture with its caption.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Picture {
    /// An SVG document, put on the page unchanged.
    pub svg: String,
    /// The same picture for narrow screens.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub narrow: Option<String>,
    /// The finding that it shows.
    pub caption: String,
    /// Files with its data: the name of each link and its address, relative to the page.
    pub files: Vec<(String, String)>,
}

impl Picture {
    /// The figure of a plot whose picture and numbers are in `directory` next to the page.
    ///
    /// ```
    /// use lcplab_page::page::Picture;
    /// use lcplab_page::plot::Spy;
    ///
    /// let spy = Spy::new("a", "The pattern of A", "", (2, 2), [(0, 0), (1, 1)])?;
    /// let picture = Picture::of(&spy, "figures");
    /// assert_eq!(picture.files[0].1, "figures/a.csv");
    /// assert!(Picture::inline(&spy).files.is_empty());
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn of(plot: &dyn Figure, directory: &str) -> Self {
        let file = |kind: &str| format!("{directory}/{}.{kind}", plot.id());
        let files = vec![("data (CSV)".into(), file("csv")), ("picture (SVG)".into(), file("svg"))];
        Picture { files, ..Picture::inline(plot) }
    }

    /// The figure of a plot without files.
    pub fn inline(plot: &dyn Figure) -> Self {
        let (svg, narrow, caption) = (plot.svg(), plot.narrow(), plot.words().into());
        Picture { svg, narrow, caption, files: Vec::new() }
    }
}

/// A numbered table.
///
/// ```
/// use lcplab_page::page::{Cell, Column, Mark, Table};
///
/// let row = |scene: &str, drift: f64, mark: Mark| {
///     vec![Cell::text(scene), Cell::count(1000), Cell::number(drift, 2).marked(mark)]
/// };
/// let mut rows = vec![row("stack", 1e-4, Mark::Plain), row("arch", 0.25, Mark::Bad)];
/// rows.push(row("chain", 0.5, Mark::Bad));
/// let table = Table::new("Drift", "Smaller is better.", "scene | #steps | #drift (m)", rows);
/// assert!(table.csv().starts_with("scene,steps,drift (m)\nstack,1000,0.0001\n"));
/// let (short, same) = table.condensed(); // without the column that says the same everywhere
/// assert_eq!((short.columns.len(), same), (2, vec![("steps".into(), "1,000".into())]));
///
/// // The columns one by one.
/// let columns = Column::list("scene | #drift (m)");
/// assert_eq!(columns[0].align, Column::words("scene").align);
/// assert_eq!(columns[1].unit, Column::numbers("drift", "m").unit);
/// assert!(Column::words("solver").secondary().secondary); // omitted where space is short
/// assert!(Column::words("size").wide().wide); // omitted on a phone
/// ```
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// One line, unique among the tables of the page.
    pub title: String,
    /// How to read it, in a sentence.
    pub how_to_read: String,
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows; each has one cell per column.
    pub rows: Vec<Vec<Cell>>,
    /// Files with its data, as for a [`Picture`].
    pub files: Vec<(String, String)>,
    /// Whether columns that say the same in every row stay, as in a matrix.
    pub keeps_columns: bool,
}

/// A column of a table.
#[derive(Debug, Clone)]
pub struct Column {
    /// The heading.
    pub title: String,
    /// The unit of its numbers; empty if they have none.
    pub unit: String,
    /// The alignment of its cells.
    pub align: Align,
    /// Whether it is omitted where space is short: in print and on a terminal.
    pub secondary: bool,
    /// Whether it is omitted on a phone.
    pub wide: bool,
}

/// The alignment of the cells in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// A cell of a table.
#[derive(Debug, Clone, Default)]
pub struct Cell {
    /// The text of the cell.
    pub text: String,
    /// Inline [`markup`] that the page shows instead of the text, if it is not empty.
    pub markup: String,
    /// The number that the text shows, used to sort rows, with all digits in the CSV.
    pub value: Option<f64>,
    /// How it is marked.
    pub mark: Mark,
    /// An address with details, relative to the page; empty if there is none.
    pub link: String,
}

/// The marking of a cell, by color and symbol.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Mark {
    /// Nothing.
    #[default]
    Plain,
    /// As it should be.
    Good,
    /// Not as it should be.
    Bad,
    /// Needs attention.
    Note,
}

impl Table {
    /// A table; see [`Column::list`] for the headings.
    pub fn new(
        title: impl Into<String>,
        how_to_read: impl Into<String>,
        headings: &str,
        rows: Vec<Vec<Cell>>,
    ) -> Self {
        Table {
            title: title.into(),
            how_to_read: how_to_read.into(),
            columns: Column::list(headings),
            rows,
            ..Table::default()
        }
    }
}

impl Column {
    /// The columns with these headings: `scene | #steps | #drift (m)` is a text column, and two of
    /// numbers, the second one in meters.
    pub fn list(headings: &str) -> Vec<Self> {
        let column = |heading: &str| {
            let Some(title) = heading.strip_prefix('#') else { return Column::words(heading) };
            match title.strip_suffix(')').and_then(|title| title.rsplit_once(" (")) {
                Some((title, unit)) => Column::numbers(title, unit),
                None => Column::numbers(title, ""),
            }
        };
        headings.split(" | ").map(column).collect()
    }

    /// A text column.
    pub fn words(title: impl Into<String>) -> Self {
        Column {
            title: title.into(),
            unit: String::new(),
            align: Align::Left,
            secondary: false,
            wide: false,
        }
    }

    /// A column of numbers in a unit; an empty unit for pure numbers.
    pub fn numbers(title: impl Into<String>, unit: impl Into<String>) -> Self {
        Column { unit: unit.into(), align: Align::Right, ..Column::words(title) }
    }

    /// The column, omitted where space is short.
    pub fn secondary(self) -> Self {
        Column { secondary: true, ..self }
    }

    /// The column, omitted on a phone.
    pub fn wide(self) -> Self {
        Column { wide: true, ..self }
    }
}

impl Cell {
    /// A text cell.
    pub fn text(text: impl Into<String>) -> Self {
        Cell { text: text.into(), ..Cell::default() }
    }

    /// A number, shown with this number of significant digits.
    pub fn number(value: f64, digits: usize) -> Self {
        Cell { text: number::tabular(value, digits), value: Some(value), ..Cell::default() }
    }

    /// A count.
    pub fn count(value: usize) -> Self {
        let text = number::count(value);
        Cell { text, value: Some(value as f64), ..Cell::default() }
    }

    /// The same cell, marked.
    pub fn marked(mut self, mark: Mark) -> Self {
        self.mark = mark;
        self
    }
}

/// A table with fewer rows keeps all its columns.
const CONDENSED_ROWS: usize = 3;

impl Table {
    /// The table without the columns that say the same in every row, and of each its title (markup)
    /// and what it says (plain text): `time limit` and `5 s`. The first column, marked cells and
    /// links stay. An empty column is not explained either.
    pub fn condensed(&self) -> (Table, Vec<(String, String)>) {
        let is_same = |c: usize| {
            let cell = |row: &Vec<Cell>| row.get(c).cloned().unwrap_or_default();
            let first = self.rows.first().map(cell).unwrap_or_default();
            let is_plain = first.mark == Mark::Plain && first.link.is_empty();
            c > 0
                && !self.keeps_columns
                && self.rows.len() >= CONDENSED_ROWS
                && is_plain
                && self
                    .rows
                    .iter()
                    .all(|row| cell(row).text == first.text && cell(row).mark == first.mark)
        };
        let (dropped, kept): (Vec<usize>, Vec<usize>) =
            (0..self.columns.len()).partition(|&c| is_same(c));
        let say = |c: &usize| {
            let (column, text) = (&self.columns[*c], &self.rows[0][*c].text);
            let said = !matches!(text.as_str(), "" | "–");
            let value = format!("{text} {}", column.unit);
            said.then(|| (column.title.clone(), value.trim_end().to_string()))
        };
        let said = dropped.iter().filter_map(say).collect();
        let is_silent = |c: usize| dropped.contains(&c) && say(&c).is_none();
        (self.columns_only(&kept).explained_without(self, is_silent), said)
    }

    /// The table without its secondary columns, and without the sentences of "how to read" that
    /// begin with the name of one.
    ///
    /// ```
    /// use lcplab_page::page::{Cell, Column, Table};
    ///
    /// let columns = vec![Column::words("case"), Column::words("formula").secondary()];
    /// let rows = vec![vec![Cell::text("free fall"), Cell::text("v0 - g t")]];
    /// let table = Table { columns, rows, ..Table::default() };
    /// assert_eq!(table.primary().columns.len(), 1);
    /// ```
    pub fn primary(&self) -> Table {
        let kept: Vec<usize> =
            (0..self.columns.len()).filter(|&c| !self.columns[c].secondary).collect();
        self.columns_only(&kept).explained_without(self, |c| self.columns[c].secondary)
    }

    /// The table without the sentences of "how to read" that begin with the name of an omitted
    /// column of the whole table.
    fn explained_without(self, whole: &Table, is_omitted: impl Fn(usize) -> bool) -> Table {
        let names_omitted = |sentence: &&str| {
            let column = whole.columns.iter().position(|own| {
                sentence.strip_prefix('*').is_some_and(|rest| rest.starts_with(&own.title))
            });
            column.is_some_and(&is_omitted)
        };
        let sentences = self.how_to_read.split_inclusive(". ");
        let kept: String = sentences.filter(|own| !names_omitted(own)).collect();
        Table { how_to_read: kept.trim_end().into(), ..self }
    }

    fn columns_only(&self, kept: &[usize]) -> Table {
        let columns = kept.iter().map(|&c| self.columns[c].clone()).collect();
        let row = |row: &Vec<Cell>| kept.iter().filter_map(|&c| row.get(c).cloned()).collect();
        Table { columns, rows: self.rows.iter().map(row).collect(), ..self.clone() }
    }

    /// The table as CSV, with all digits of its numbers.
    pub fn csv(&self) -> String {
        let mut out = String::new();
        let heading = |column: &Column| match column.unit.as_str() {
            "" => column.title.clone(),
            unit => format!("{} ({unit})", column.title),
        };
        csv::record(&mut out, self.columns.iter().map(heading));
        for row in &self.rows {
            let field = |cell: &Cell| cell.value.map_or(cell.text.clone(), csv::number);
            csv::record(&mut out, row.iter().map(field));
        }
        out
    }
}
