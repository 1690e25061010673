//! How a document is written: the options `--format` and `--out`.

use std::io::IsTerminal;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lcplab::document::{Document, Format};
use lcplab::error::Result;
use lcplab::file;

use super::{Outcome, print, print_coloured};

/// The form of a document, and where it goes.
#[derive(Debug, Args)]
pub struct Writing {
    /// How it is written
    #[arg(long, value_enum, default_value_t = Form::Text)]
    format: Form,
    /// The file to write [default: standard output]
    #[arg(long)]
    out: Option<PathBuf>,
}

/// The forms of a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Form {
    /// For a terminal
    Text,
    /// Markdown with LaTeX
    Markdown,
    /// A page that needs nothing else
    Html,
}

impl Writing {
    /// Writes it; refuted if it is not accepted.
    pub fn write(&self, document: &Document) -> Result<Outcome> {
        let format = self.format();
        let text = document.written(format)?;
        match &self.out {
            Some(path) => file::write(path, &text)?,
            None if format == Format::ColouredText => print_coloured(&text)?,
            None => print(&text)?,
        }
        Ok(if document.is_accepted { Outcome::Good } else { Outcome::Refuted })
    }

    fn format(&self) -> Format {
        match self.format {
            Form::Text if self.out.is_none() && wants_colour() => Format::ColouredText,
            Form::Text => Format::Text,
            Form::Markdown => Format::Markdown,
            Form::Html => Format::Html,
        }
    }
}

/// Whether standard output is a terminal whose user has nothing against colours.
fn wants_colour() -> bool {
    let allowed = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    allowed && std::io::stdout().is_terminal()
}
