//! A report on disk: one page, and beside it the data of every figure and table.
//!
//! Each file is written under a temporary name and then renamed, so that a reader, or an interrupted
//! run, never leaves half a file.

use std::fs;
use std::path::{Path, PathBuf};

use super::layout;
use super::results::Results;
use super::view::{self, Document, FILES};
use crate::error::{Error, Result};

/// The name of the results beside a page.
pub const RESULTS: &str = "results.json";

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
    let json = layout::json(results)
        .map_err(|cause| Error::invalid(RESULTS, "results", cause.to_string()))?;
    file(&folder.join(RESULTS), &json)
}

/// Writes a document's page, figures and tables; returns the path of the page.
///
/// # Errors
/// If a file cannot be written, or an equation cannot be set.
pub fn document(document: &Document, folder: &Path) -> Result<PathBuf> {
    let data = folder.join(FILES);
    for figure in &document.figures {
        file(&data.join(format!("{}.svg", figure.id())), &figure.svg())?;
        file(&data.join(format!("{}.csv", figure.id())), &figure.csv())?;
    }
    for (id, table) in &document.tables {
        file(&data.join(format!("{id}.csv")), &table.csv())?;
    }
    let page = folder.join("index.html");
    file(&page, &document.page.render()?)?;
    Ok(page)
}

/// Writes a file whole or not at all, with the folders above it.
///
/// # Errors
/// If it cannot be written.
pub fn file(path: &Path, text: &str) -> Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder).map_err(|cause| Error::file(folder, &cause))?;
    let temporary = path.with_extension("part");
    fs::write(&temporary, text)
        .and_then(|()| fs::rename(&temporary, path))
        .map_err(|cause| Error::file(path, &cause))
}
