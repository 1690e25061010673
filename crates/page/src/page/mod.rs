//! A page: a document as plain data, and its rendering to one self-contained HTML file.
//!
//! The file fetches nothing: equations are MathML, figures inline SVG, and the mathematics font is
//! embedded. Its Content-Security-Policy holds a browser to that, and to the page's own script,
//! whatever the text may hold. Titles, names and cells are plain text. A lead, text, note, caption,
//! column title and "how to read" may carry [`markup`]. The same page gives the same bytes.

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
pub use player::{Chart, Pane, Player, Reel, SPEEDS, speed};
pub use render::base64;

/// A document.
///
/// ```
/// use lcplab_page::page::{Block, Page, Section};
///
/// let text = Block::Text("The *natural residual* is $|x - \\Pi(x - w)|$.".into());
/// let (id, title) = ("judge".into(), "The judge".into());
/// let section = Section { id, title, blocks: vec![text], ..Section::default() };
/// let page = Page { title: "Report".into(), sections: vec![section], ..Page::default() };
/// assert!(page.render()?.contains("<em>natural residual</em> is <math>"));
/// # Ok::<(), lcplab_problem::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Page {
    /// The heading, and the name of the browser's tab.
    pub title: String,
    /// What the page shows and concludes, in a few sentences.
    pub lead: String,
    /// The numbered sections.
    pub sections: Vec<Section>,
    /// Facts about the run for the foot of the page: a name and a value each.
    pub facts: Vec<(String, String)>,
}

/// A numbered part of a page.
#[derive(Debug, Clone, Default)]
pub struct Section {
    /// The anchor, unique on the page: letters, digits, `-` and `_`.
    pub id: String,
    /// The heading.
    pub title: String,
    /// The contents.
    pub blocks: Vec<Block>,
    /// What of it is folded away.
    pub fold: Fold,
}

/// What of a section is folded away: on a screen until it is asked for, on paper for good.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fold {
    /// Nothing.
    #[default]
    Nothing,
    /// Tables and proofs, which come last.
    Tables,
    /// Everything after so many blocks.
    After(usize),
}

impl Fold {
    /// Whether this block of a section is folded away.
    fn takes(self, place: usize, block: &Block) -> bool {
        match self {
            Fold::Nothing => false,
            Fold::Tables => matches!(block, Block::Table(_) | Block::Proofs { .. }),
            Fold::After(first) => place >= first,
        }
    }
}

/// A piece of a section.
#[derive(Debug, Clone)]
pub enum Block {
    /// Paragraphs and lists.
    Text(String),
    /// The same, folded away under a few words, on the screen alone.
    Aside {
        /// What opens it.
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
    /// A film of a scene.
    Player(Box<Player>),
    /// A table.
    Table(Table),
    /// Program text or output.
    Code {
        /// The language, `text` for output.
        language: String,
        /// The lines.
        text: String,
    },
    /// The same, folded away.
    FoldedCode {
        /// The language.
        language: String,
        /// The lines.
        text: String,
    },
    /// Programs that say the same in two languages, of which one is shown at a time.
    Twin {
        /// Language and text of each piece in Python: a program and what it prints.
        python: Vec<(String, String)>,
        /// The same in Rust.
        rust: Vec<(String, String)>,
    },
    /// A drawing that is part of the text.
    Drawing {
        /// The SVG document, with a style of its own.
        svg: String,
        /// What it shows, for those who cannot see it.
        alt: String,
    },
    /// A remark set apart from the text.
    Note(String),
    /// A page with a program of its own, which opens in place.
    Live(Live),
    /// Proofs about one problem that the reader can have checked by the page itself.
    Proofs {
        /// The problem file, as text.
        problem: String,
        /// What is proved of it.
        proofs: Vec<Proof>,
    },
}

/// A live page in another page.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Live {
    /// Its name: letters, digits, `-` and `_`.
    pub name: String,
    /// What the reader opens.
    pub title: String,
    /// The page as HTML; one of the same name is kept once. Its own Content-Security-Policy names
    /// the hash of its script.
    pub html: String,
    /// What follows `#` in its address.
    pub state: String,
}

/// A proof on a page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Proof {
    /// The anchor that a table's row points to; the proofs of a table are folded. Empty if nothing
    /// points to it.
    pub id: String,
    /// Whose answer it is about; empty if nobody's in particular.
    pub about: String,
    /// What it proves, in a sentence.
    pub claim: String,
    /// The proof file, as text.
    pub text: String,
    /// The address of this file beside the page; empty if it stands in the page alone.
    pub file: String,
}

/// A numbered picture with its caption.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Picture {
    /// An SVG document, put on the page as it is.
    pub svg: String,
    /// What to see in it.
    pub caption: String,
    /// Files behind it: the name of the link and its address, relative to the page.
    pub files: Vec<(String, String)>,
    /// How it was obtained.
    pub origin: Option<Origin>,
}

impl Picture {
    /// The figure of a plot whose picture and numbers lie in `directory` beside the page.
    pub fn of(plot: &dyn Figure, directory: &str) -> Self {
        let file = |kind: &str| format!("{directory}/{}.{kind}", plot.id());
        Picture {
            svg: plot.svg(),
            caption: plot.words().into(),
            files: vec![("data (CSV)".into(), file("csv")), ("picture (SVG)".into(), file("svg"))],
            origin: None,
        }
    }
}

/// A numbered table.
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// One line that no other table of the page has.
    pub title: String,
    /// How to read it, in a sentence.
    pub how_to_read: String,
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows; each has a cell a column.
    pub rows: Vec<Vec<Cell>>,
    /// Files behind it, as for a [`Picture`].
    pub files: Vec<(String, String)>,
    /// How it was obtained.
    pub origin: Option<Origin>,
}

/// A column of a table.
#[derive(Debug, Clone)]
pub struct Column {
    /// The heading.
    pub title: String,
    /// The unit of its numbers; empty if there is none.
    pub unit: String,
    /// How its cells are set.
    pub align: Align,
    /// Whether it is left out on paper, where a wide table would be too small to read.
    pub screen_only: bool,
}

/// How the cells of a column are set.
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
    /// What is read.
    pub text: String,
    /// The number behind the text, by which rows are sorted and which the CSV has in full.
    pub value: Option<f64>,
    /// Whether it stands out.
    pub mark: Mark,
    /// Where more is said: an address relative to the page; empty if nowhere.
    pub link: String,
}

/// What is said of a cell, by colour and sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Mark {
    /// Nothing.
    #[default]
    Plain,
    /// It is as it should be.
    Good,
    /// It is not.
    Bad,
    /// It needs a look.
    Note,
}

impl Column {
    /// A column of words.
    pub fn words(title: impl Into<String>) -> Self {
        Column { title: title.into(), unit: String::new(), align: Align::Left, screen_only: false }
    }

    /// A column of numbers in a unit; an empty one for pure numbers.
    pub fn numbers(title: impl Into<String>, unit: impl Into<String>) -> Self {
        Column { title: title.into(), unit: unit.into(), align: Align::Right, screen_only: false }
    }

    /// The same, left out on paper.
    pub fn on_screen(self) -> Self {
        Column { screen_only: true, ..self }
    }
}

impl Cell {
    /// A cell of words.
    pub fn text(text: impl Into<String>) -> Self {
        Cell { text: text.into(), ..Cell::default() }
    }

    /// A number, shown with so many significant digits.
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

impl Table {
    /// The table as CSV, numbers in full.
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
