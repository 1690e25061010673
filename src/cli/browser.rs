//! Opens a page in the browser.

use std::path::Path;

use lcplab::error::{Error, Result};

/// Opens a page in the browser.
#[cfg(not(target_os = "emscripten"))]
pub fn open(path: &Path) -> Result<()> {
    open::that(path).map_err(|cause| Error::file(path, &cause))
}

/// From within a browser no other page can be opened.
#[cfg(target_os = "emscripten")]
pub fn open(path: &Path) -> Result<()> {
    let reason = "is written, but cannot be opened from Python in a browser";
    Err(Error::File { path: path.display().to_string(), reason: reason.into() })
}
