//! A time step, or a problem file, derived line by line with its own numbers.
//!
//! What is written down is what a student would write: states and forces, each row's c, J and J'u,
//! the four steps that lead from Newton's law to the LCP (K&M Figure 4), A and b, and then the solver
//! at work, row by row, move by move, or tableau by tableau, as it tells an observer that asks
//! ([`Part`](crate::solver::Part)). Nothing is computed for show: the numbers are those of the
//! simulation. A [`Document`] is plain data; [`Format`] has the three forms it can be written in.
//!
//! ```
//! use lcplab::explain::{Format, Method, step};
//! use lcplab::scene::Scene;
//!
//! let document = step(&Scene::load("fig6")?, &Method::named("pgs")?, 1)?;
//! let text = document.written(Format::Text)?;
//! assert!(text.contains("x₀ = 2 N s")); // the ground's impulse on the body that lands
//! # Ok::<(), lcplab::error::Error>(())
//! ```

mod answer;
mod dantzig;
mod derivation;
mod document;
mod html;
mod lemke;
mod markdown;
mod method;
mod notation;
mod problem;
mod setup;
mod solve;
mod step;
mod sweeps;
mod text;
mod units;

pub use document::{Block, Document, Formula, Grid, Piece, Section, Table};
pub use method::Method;
pub use problem::problem;
pub use step::step;

use crate::error::Result;

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
}
