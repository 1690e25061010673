//! Writes a report to disk: one page, and next to it the data of every figure and table.

use std::path::{Path, PathBuf};

use super::layout;
use super::results::Results;
use super::view::{self, FILES, ReportPage};
use crate::error::{Defects, Error, Result};
use crate::file;
use crate::live::write_linked;

/// The name of the results next to a page.
pub const RESULTS: &str = "results.json";
/// The name of the page.
const PAGE: &str = "index.html";
/// The content of a report's folder: its results, a page, and a folder of figures and tables.
pub const WRITTEN: [&str; 3] = [RESULTS, PAGE, FILES];

/// Writes `index.html`, `results.json` and the folder of figures and tables into `folder`; returns
/// the path of the page.
///
/// # Errors
/// If a file cannot be written.
pub fn report(results: &Results, folder: &Path) -> Result<PathBuf> {
    self::results(results, folder)?;
    document(&view::document(results)?, folder)
}

/// Writes `results.json` into `folder`.
///
/// # Errors
/// If it cannot be written.
pub fn results(results: &Results, folder: &Path) -> Result<()> {
    let json = layout::json(&results.sealed())
        .map_err(|cause| Error::invalid(RESULTS, "results", cause.to_string()))?;
    file::write_in(folder, RESULTS, &json)
}

/// Writes a page with its figures and tables; returns the path of the page.
///
/// # Errors
/// If an equation cannot be rendered or a name is not a valid file name, in which case nothing is
/// written; or if a file cannot be written.
#[doc(hidden)]
pub fn document(document: &ReportPage, folder: &Path) -> Result<PathBuf> {
    check_names(document)?;
    let html = document.page.render()?;
    let data = |id: &str, ending: &str| format!("{FILES}/{id}.{ending}");
    for figure in &document.figures {
        file::write_in(folder, data(figure.id(), "svg"), figure.svg())?;
        file::write_in(folder, data(figure.id(), "csv"), figure.csv())?;
    }
    for (id, table) in &document.tables {
        file::write_in(folder, data(id, "csv"), table.csv())?;
    }
    write_linked(&html, folder)?;
    file::write_in(folder, PAGE, &html)?;
    Ok(folder.join(PAGE))
}

/// Checks the names of figures and tables, which are derived from those of scenes, runs and
/// sections.
fn check_names(document: &ReportPage) -> Result<()> {
    let figures = document.figures.iter().map(|figure| figure.id());
    let tables = document.tables.iter().map(|(id, _)| id.as_str());
    let mut defects = Defects::default();
    for name in figures.chain(tables) {
        file::check_name(name).unwrap_or_else(|reason| defects.add("name", reason));
    }
    defects.into_result(format!("page {:?}", document.page.title))
}
