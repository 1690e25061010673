//! Prints a page to PDF with an installed browser: the PDF looks like the page.

use std::env::{self, consts::EXE_SUFFIX};
use std::path::{Path, PathBuf};
use std::process::Command;

use lcplab::error::{Error, Result};
use lcplab::file;
use tempfile::TempDir;

/// The names under which the browser is searched.
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// A browser that can print.
pub struct Browser(PathBuf);

impl Browser {
    /// The first browser on the PATH.
    ///
    /// # Errors
    /// If there is none.
    pub fn find() -> Result<Self> {
        let path = env::var_os("PATH").unwrap_or_default();
        let places = env::split_paths(&path);
        let programs =
            places.flat_map(|at| NAMES.map(|name| at.join(format!("{name}{EXE_SUFFIX}"))));
        programs.into_iter().find(|program| program.is_file()).map(Browser).ok_or_else(|| {
            let reason = format!(
                "contains none of {}; one of them is needed to print the page",
                NAMES.join(", ")
            );
            Error::invalid("--out", "PATH", reason)
        })
    }

    /// Prints a page to a file.
    ///
    /// # Errors
    /// If the page cannot be read, or the browser does not print it.
    pub fn print(&self, page: &Path, pdf: &Path) -> Result<()> {
        file::made_by(pdf, |part| self.print_to(part, page))
    }

    /// Prints an SVG picture to a page of its size.
    ///
    /// # Errors
    /// If the browser does not print it.
    pub fn print_picture(&self, svg: &str, pdf: &Path) -> Result<()> {
        let size = |key: &str| {
            let after = svg.split(&format!(" {key}=\"")).nth(1).unwrap_or_default();
            after.split('"').next().unwrap_or_default().to_string()
        };
        let (width, height) = (size("width"), size("height"));
        let style = format!(
            "@page {{ size: {width}px {height}px; margin: 0 }} body {{ margin: 0 }} svg {{ display: block }}"
        );
        let html = format!("<!doctype html><meta charset=\"utf-8\"><style>{style}</style>{svg}");
        let folder = private_folder()?;
        file::write_in(folder.path(), "page.html", html)?;
        let page = folder.path().join("page.html");
        file::made_by(pdf, |part| self.print_to(part, &page))
    }

    fn print_to(&self, part: &Path, page: &Path) -> Result<()> {
        let address = page.canonicalize().map_err(|cause| Error::file(page, &cause))?;
        let profile = private_folder()?;
        // Without a sandbox, because the user may be the superuser; the page is our own and loads
        // nothing.
        let output = Command::new(&self.0)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg(format!("--print-to-pdf={}", part.display()))
            .arg(address)
            .output()
            .map_err(|cause| Error::file(&self.0, &cause))?;
        // The temporary file exists before printing, and is empty.
        if !part.metadata().is_ok_and(|part| part.len() > 0) {
            let said = String::from_utf8_lossy(&output.stderr);
            let last =
                said.trim().lines().last().unwrap_or("the browser printed no message").to_string();
            return Err(Error::invalid(self.0.display().to_string(), "print", last));
        }
        Ok(())
    }
}

/// A folder with a private name, removed when dropped: the browser's data while it prints.
fn private_folder() -> Result<TempDir> {
    tempfile::tempdir().map_err(|cause| Error::file(&env::temp_dir(), &cause))
}
