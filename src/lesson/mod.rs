//! Lessons: notebooks with Python cells, and Rust cells that are compiled with the crate, run, and
//! shown with their output.
//!
//! A lesson is one Markdown file (`source`). The build turns its Rust cells into a [`Program`];
//! running it gives a [`Record`] of outputs, from which a page ([`Program::page`]) and Jupyter
//! notebooks in Python ([`Program::notebook`]) and in Rust ([`Program::rust_notebook`]) are made.
//! In a Rust cell `println!` writes a line, [`show`] a [`table`], a [`Plot`], a scene or an
//! erratum's exhibit, and [`put`] gives the prose a value that it quotes as `{{name}}`. The same
//! calls work in a Jupyter kernel for Rust.
//!
//! `problem` checks students' numerical answers; `template` gives each student different
//! numbers, and `assignment` makes and grades sheets of such problems. Their programs are checked
//! in Python alone (`notebooks/exercises/checks.py`).

#[doc(hidden)]
pub mod assignment;
mod notebook;
mod page;
mod plot;
#[doc(hidden)]
pub mod problem;
mod python;
mod record;
mod show;
#[doc(hidden)]
pub mod source;
mod table;
#[doc(hidden)]
pub mod template;
mod twin;

pub use crate::document::Show;
pub use plot::Plot;
pub use python::write_python;
pub use record::{Output, Record, cell, put, say};
pub use show::show;
pub use table::{Entry, row, table};
pub use twin::{ARRAYS, ENGINE};

use crate::chapter::exhibit::{self, Measure, Outcome};
use crate::document::notation::vector;
use crate::error::{Error, Result};
use crate::number::readable;
use crate::report::page::markup::literal;
use template::Template;

/// The result of running a notebook's cells.
pub type Ran = std::result::Result<(), Box<dyn std::error::Error>>;

/// A literate notebook: its text, and its cells as a program.
///
/// ```
/// use lcplab::lesson::{Output, Plot, Program, Ran, cell, put, say, show};
///
/// /// The cells as the build makes them from the Rust cells of a notebook.
/// fn cells() -> Ran {
///     cell(0);
///     say("m g = 19.62 N");
///     put("weight", 19.62);
///     let plot = Plot::new("fall", "A fall").x("time", "s").y("speed", "m/s");
///     let plot = plot.measured("ball", vec![(0.0, 0.0), (1.0, 9.81)]);
///     let plot = plot.points("samples", vec![(1.0, 9.81)]);
///     show(&plot.log_x("time", "s").reference("limit", vec![(0.1, 9.81), (1.0, 9.81)]))?;
///     Ok(())
/// }
///
/// let text = "# The weight\n\nIt is {{weight}} N.\n";
/// let program = Program { name: "weight", text, cells, drawings: &[], problems: "" };
/// let record = program.run()?;
/// assert_eq!(record.values["weight"], "19.62"); // the prose quotes it
/// assert_eq!(record.cells[0][0], Output::Lines("m g = 19.62 N\n".into()));
/// assert_eq!(program.page(&record)?.title, "The weight");
/// assert!(program.notebook(&record)?.contains("It is 19.62 N."));
/// assert!(program.rust_notebook(&record)?.contains("It is 19.62 N."));
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Program {
    /// The file's name without its extension: `01_complementarity`.
    pub name: &'static str,
    /// The Markdown.
    pub text: &'static str,
    /// Runs the cells from the first to the last.
    pub cells: fn() -> Ran,
    /// Its drawings: the file's name and the SVG.
    pub drawings: &'static [(&'static str, &'static str)],
    /// Its problem set, as a TOML file; empty without one.
    pub problems: &'static str,
}

impl Program {
    /// Runs the cells and returns their output.
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

    /// The number at the beginning of the name; 0 without one.
    pub(crate) fn number(&self) -> usize {
        let digits = self.name.split('_').next().unwrap_or_default();
        digits.parse().unwrap_or(0)
    }

    /// The title, preceded by the number if there is one.
    pub(crate) fn title(&self) -> String {
        let title = source::Source::read(self.text).title;
        if self.number() > 0 { format!("{}. {title}", self.number()) } else { title }
    }
}

/// The prose with its quotations: values by name, errata by number as notes, the problem
/// set.
fn quoted(program: &Program, prose: &str, record: &Record) -> Result<String> {
    let mut pieces = prose.split("{{");
    let mut out = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").unwrap_or((piece, ""));
        let value = match name {
            "problems" => {
                let problems = problem::set(program)?;
                let printed: Result<Vec<_>> = problems.iter().map(Template::printed).collect();
                Some(problem::markdown(&printed?))
            }
            name if name.ends_with(" errata") => Some(errata(program, name)?),
            name => record.values.get(name).cloned().or_else(|| note(name)),
        };
        out += &value.ok_or_else(|| {
            Error::invalid("notebook", format!("{{{{{name}}}}}"), "no cell has put this value")
        })?;
        out += rest;
    }
    Ok(out)
}

/// The errata of a severity as a table with links to their sections: of the `wrong errata` what the
/// example of each measures first, of others where they are printed.
fn errata(program: &Program, name: &str) -> Result<String> {
    let written = |outcome: &Outcome| match outcome {
        Outcome::Numbers(values) if values.len() > 1 => vector(values),
        Outcome::Numbers(values) => readable(values[0], 3),
        Outcome::Impossible(reason) => reason.clone(),
    };
    let is_measured = name == "wrong errata";
    let heads = if is_measured { "in its example | as printed → corrected" } else { "where" };
    let rule = "--- | ".repeat(heads.split('|').count() + 2);
    let mut table = format!("| no. | what is wrong | {heads} |\n| {rule}\n");
    for own in exhibit::all().iter().filter(|own| name.starts_with(own.severity.word())) {
        let before = program.text.split(&format!("{{{{{}}}}}", own.id)).next().unwrap_or_default();
        let section = before.matches("\n## ").count();
        let finding = if is_measured { own.found()? } else { None };
        let shown = finding.and_then(|finding| {
            let Measure { quantity, unit, printed, corrected, .. } = finding.measures.first()?;
            let [printed, corrected] = [printed, corrected].map(written);
            let quantity = format!("{quantity} ({unit})").replace(" ()", "");
            Some(format!("{quantity} | {printed} → {corrected}"))
        });
        let [title, place] = [&own.title, &own.place].map(|text| literal(text));
        let shown = shown.unwrap_or(if is_measured { "in words only |".into() } else { place });
        table += &format!("| [{}](#part-{section}) | {title} | {shown} |\n", own.id);
    }
    Ok(table)
}

/// An erratum as a quotation.
fn note(id: &str) -> Option<String> {
    let exhibit = exhibit::named(id).ok()?;
    let stop = if exhibit.printed.ends_with(['.', ';']) { "" } else { "." };
    Some(format!(
        "> **{}**, {}, {}. *Printed:* {}{stop} *Correct:* {}",
        exhibit.id,
        literal(&exhibit.place),
        exhibit.severity.word(),
        exhibit.printed,
        exhibit.holds,
    ))
}
