//! Lessons: notebooks with cells in Python, and cells in Rust that are compiled with the crate,
//! run, and shown with what they put out.
//!
//! A lesson is one Markdown file ([`source`]). The build turns its Rust cells into a [`Program`];
//! running it gives a [`Record`] of outputs, from which follow a page ([`Program::page`]) and
//! Jupyter notebooks in Python ([`Program::notebook`]) and in Rust ([`Program::rust_notebook`]). In
//! a Rust cell `println!` writes a line, [`show`] a [`table`], a [`Plot`], a scene or an erratum's
//! exhibit, and [`put`] gives the prose a value that it quotes as `{{name}}`. The same calls work
//! in a Jupyter kernel for Rust.
//!
//! [`exercise`] checks programs of students, [`problem`] numbers that they have found.

pub mod exercise;
mod notebook;
mod page;
mod plot;
pub mod problem;
mod record;
mod show;
pub mod source;
mod table;
mod terminal;
mod twin;

pub use crate::document::Show;
pub use plot::Plot;
pub use record::{Output, Record, cell, put, say};
pub use show::show;
pub use table::{Entry, row, table};
pub use terminal::unicode;
pub use twin::ENGINE;

use crate::chapter::exhibit;
use crate::error::{Error, Result};
use crate::report::page::markup::literal;

/// How a notebook's cells ended.
pub type Ran = std::result::Result<(), Box<dyn std::error::Error>>;

/// A literate notebook: its text, and its cells as a program.
#[derive(Debug, Clone, Copy)]
pub struct Program {
    /// The file's name without its ending: `01_complementarity`.
    pub name: &'static str,
    /// The Markdown.
    pub text: &'static str,
    /// Runs the cells from the first to the last.
    pub cells: fn() -> Ran,
    /// The drawings that it shows: the file's name and the SVG.
    pub drawings: &'static [(&'static str, &'static str)],
    /// Its problem set, as a TOML file; empty without one.
    pub problems: &'static str,
}

impl Program {
    /// Runs the cells and returns what they put out.
    ///
    /// # Errors
    /// Names the cell that ended with an error.
    pub fn run(&self) -> Result<Record> {
        record::begin();
        let ended = (self.cells)();
        let record = record::end();
        ended.map_err(|cause| {
            let cell = format!("cell {}", record.cells.len());
            Error::invalid(self.name, cell, cause.to_string())
        })?;
        Ok(record)
    }

    /// The number with which the name begins; 0 without one.
    pub fn number(&self) -> usize {
        let digits = self.name.split('_').next().unwrap_or_default();
        digits.parse().unwrap_or(0)
    }

    /// The title, with the number before it if there is one.
    pub fn title(&self) -> String {
        let title = source::Source::read(self.text).title;
        if self.number() > 0 { format!("{}. {title}", self.number()) } else { title }
    }
}

/// The prose with what it quotes: values by name, errata by number as a note in the margin, the
/// problem set.
fn quoted(program: &Program, prose: &str, record: &Record) -> Result<String> {
    let mut pieces = prose.split("{{");
    let mut out = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").unwrap_or((piece, ""));
        let value = match name {
            "problems" => Some(problem::markdown(&problem::set(program)?)),
            name => record.values.get(name).cloned().or_else(|| note(name)),
        };
        out += &value.ok_or_else(|| {
            Error::invalid("notebook", format!("{{{{{name}}}}}"), "no cell has put this value")
        })?;
        out += rest;
    }
    Ok(out)
}

/// An erratum as a quotation.
fn note(id: &str) -> Option<String> {
    let exhibit = exhibit::named(id).ok()?;
    let [printed, holds] = [&exhibit.printed, &exhibit.holds].map(|text| literal(text));
    Some(format!(
        "> **{}**, {}, {}. *Printed:* {printed} *Holds:* {holds}",
        exhibit.id,
        literal(&exhibit.place),
        exhibit.severity.word(),
    ))
}
