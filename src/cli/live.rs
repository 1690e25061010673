//! `live`: pages on which problems are dragged and methods stepped through.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::live::PAGES;

use super::{Outcome, folder_of, print};

/// Write a live page: drag a problem, step through methods
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab live                  # the list of pages
  lcplab live two_rows --open
  lcplab live stack --out lecture

A page needs no network and no server: the solvers are in it, compiled to WebAssembly. Its address keeps
what it shows, so that it can be sent to others.")]
pub struct Live {
    /// The name of a page
    page: Option<String>,
    /// Show it in the browser
    #[arg(long, requires = "page")]
    open: bool,
    /// Folder to write it into [default: reports/live]
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Live {
    pub fn run(&self) -> Result<Outcome> {
        let Some(name) = &self.page else {
            let lines = PAGES.iter().map(|page| format!("{:<10} {}\n", page.name, page.about));
            print(&lines.collect::<String>())?;
            return Ok(Outcome::Good);
        };
        let page = PAGES.iter().find(|page| page.name == name).ok_or_else(|| Error::Unknown {
            kind: "live page",
            name: name.clone(),
            known: PAGES.iter().map(|page| page.name.to_string()).collect(),
        })?;
        let folder = folder_of(self.out.as_deref(), "reports", "live")?;
        let file = format!("{name}.html");
        file::write_in(&folder, &file, page.text())?;
        let path = folder.join(file);
        if self.open {
            open::that(&path).map_err(|cause| Error::file(&path, &cause))?;
        }
        print(&format!("{}\n", path.display()))?;
        Ok(Outcome::Good)
    }
}
