//! The output format and file of a document: the options `--format` and `--out`.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use lcplab::document::{Document, Format};
use lcplab::error::{Error, Result};
use lcplab::file;

use super::{Outcome, print, print_colored};

/// The form of a document, and where it goes.
#[derive(Debug, Args)]
pub struct Writing {
    /// Format of the output [default: by the extension of --out, .md or .html; else text]
    #[arg(long, value_enum)]
    format: Option<Form>,
    /// File to write [default: standard output]
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
    /// A page that needs no other files
    Html,
}

impl Writing {
    /// Rejects a file whose extension is not that of a format.
    ///
    /// # Errors
    /// If there is such a file.
    fn check(&self) -> Result<()> {
        let Some(path) = self.out.as_ref().filter(|_| self.format.is_none()) else { return Ok(()) };
        match path.extension().map(|ending| ending.to_string_lossy()).as_deref() {
            None | Some("txt" | "text" | "md" | "html") => Ok(()),
            Some(ending) => {
                let reason =
                    format!("cannot be written as .{ending}: use .txt, .md or .html, or --format");
                Err(Error::invalid(path.display().to_string(), "file", reason))
            }
        }
    }

    /// Writes the document; the outcome is `Rejected` if it is not accepted.
    pub fn write(&self, document: &Document) -> Result<Outcome> {
        self.check()?;
        let format = self.format();
        let text = document.written(format)?;
        match &self.out {
            Some(path) => file::write(path, &text)?,
            None if format == Format::ColoredText => print_colored(&text)?,
            None => print(&text)?,
        }
        Ok(if document.is_accepted { Outcome::Good } else { Outcome::Rejected })
    }

    fn format(&self) -> Format {
        let ending = self.out.as_ref().and_then(|path| path.extension()?.to_str());
        match (self.format, ending) {
            (Some(Form::Html), _) | (None, Some("html")) => Format::Html,
            (Some(Form::Markdown), _) | (None, Some("md")) => Format::Markdown,
            _ if self.out.is_none() && wants_color() => Format::ColoredText,
            _ => Format::Text,
        }
    }

    /// Whether pictures are shown.
    pub fn has_pictures(&self) -> bool {
        self.format() == Format::Html
    }

    /// The file of a page, if a page is written to a file.
    pub fn page(&self) -> Option<&Path> {
        self.out.as_deref().filter(|_| self.has_pictures())
    }
}

/// Whether standard output is a terminal and the user has not disabled colors.
fn wants_color() -> bool {
    let allowed = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    allowed && std::io::stdout().is_terminal()
}
