//! What a problem is written as.

use std::path::Path;

use super::MATRIX;
use super::input::beside;
use crate::disk;
use lcplab_problem::error::Result;

/// The file of a problem, or several, in some format.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Output {
    /// The file, of several the one with the matrix.
    pub main: Vec<u8>,
    /// The files beside it: what each holds, and its text.
    pub parts: Vec<(&'static str, String)>,
    /// What the reader of the files should know.
    pub notes: Vec<String>,
}

impl Output {
    /// A single file.
    pub fn of(main: impl Into<Vec<u8>>) -> Self {
        Output { main: main.into(), ..Output::default() }
    }

    /// Writes the file, and those beside it.
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

/// A number in the fewest digits that read back as the same bits; infinities as inf and -inf.
pub(super) fn decimal(value: f64) -> String {
    format!("{value:?}")
}
