//! `live`: writes interactive pages, on which you change problems and step through solvers.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::live::{PAGES, Page};

use super::{Outcome, browser, folder_of, print};

/// Write an interactive page on which you can change a problem and step through the solvers
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab live                  # lists the pages
  lcplab live two_rows --open
  lcplab live stack --out lecture
  lcplab live --all --out live # the folder that the notebooks link to

A page needs no network and no server: it contains the solvers, compiled to WebAssembly. Its address stores \
the problem and the settings, so that you can send it to others.

Exit codes:
  0  written
  2  invalid input or usage")]
pub struct Live {
    /// Name of a page [default: list the pages]
    page: Option<String>,
    /// Write all pages
    #[arg(long, conflicts_with = "page")]
    all: bool,
    /// Open the page in the browser
    #[arg(long, requires = "page")]
    open: bool,
    /// Folder [default: reports/live]
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Live {
    pub fn run(&self) -> Result<Outcome> {
        match &self.page {
            None if self.all => PAGES.iter().try_for_each(|page| self.write(page).map(drop))?,
            None => print(&list())?,
            Some(name) => {
                let path = self.write(by_name(name)?)?;
                if self.open {
                    browser::open(&path)?;
                }
            }
        }
        Ok(Outcome::Good)
    }

    /// Writes a page and prints its path.
    fn write(&self, page: &Page) -> Result<PathBuf> {
        let folder = folder_of(self.out.as_deref(), "reports", "live")?;
        let file = format!("{}.html", page.name);
        let text = if self.all { page.text_in_folder() } else { page.text() };
        file::write_in(&folder, &file, text)?;
        let path = folder.join(file);
        print(&format!("{}\n", path.display()))?;
        Ok(path)
    }
}

fn list() -> String {
    PAGES.iter().map(|page| format!("{:<10} {}\n", page.name, page.about)).collect()
}

fn by_name(name: &str) -> Result<&'static Page> {
    PAGES.iter().find(|page| page.name == name).ok_or_else(|| Error::Unknown {
        kind: "live page",
        name: name.into(),
        known: PAGES.iter().map(|page| page.name.to_string()).collect(),
    })
}
