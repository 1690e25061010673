//! The encoded files of a problem.

use std::path::Path;

use super::MATRIX;
use super::input::beside;
use crate::disk;
use lcplab_lcp::error::Result;

/// The file or files of a problem in some format.
///
/// ```
/// use lcplab_files::Output;
///
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("A.mtx");
/// let mut output = Output::of("the matrix");
/// output.parts.push(("b", "the offset".into()));
/// output.save(&path)?;
/// assert_eq!(std::fs::read(&path).unwrap(), b"the matrix");
/// assert_eq!(std::fs::read(folder.path().join("b.mtx")).unwrap(), b"the offset");
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Output {
    /// The file; for several files, the one with the matrix.
    pub main: Vec<u8>,
    /// The companion files: the name of each part, and its text.
    pub parts: Vec<(&'static str, String)>,
    /// Warnings for the readers of the files.
    pub notes: Vec<String>,
}

impl Output {
    /// A single file.
    pub fn of(main: impl Into<Vec<u8>>) -> Self {
        Output { main: main.into(), ..Output::default() }
    }

    /// Writes the file and its companion files.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn save(&self, path: &Path) -> Result<()> {
        for (part, text) in &self.parts {
            let own = beside(path, MATRIX, part);
            let name = own.file_name().unwrap_or_default();
            disk::write_in(&disk::folder_of(path), name, text)?;
        }
        disk::write(path, &self.main)
    }
}

/// A number with the fewest digits that are read back bitwise; infinities as inf and -inf.
pub(super) fn decimal(value: f64) -> String {
    format!("{value:?}")
}
