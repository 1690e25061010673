//! The source that a problem is read from.

use std::path::{Path, PathBuf};

use lcplab_lcp::disk;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::memory::Memory;

/// A file, together with its companion files, or standard input.
///
/// ```
/// use lcplab_files::Input;
/// use lcplab_lcp::memory::Memory;
///
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("stack.dat");
/// std::fs::write(&path, "9.81").unwrap();
/// let input = Input::new(&path, Memory::bytes(100));
/// assert_eq!((input.path(), input.stem()), (path.as_path(), "stack".to_string()));
/// assert_eq!(input.name(), path.display().to_string());
/// assert_eq!((input.text()?, input.bytes()?.len()), ("9.81".to_string(), 4));
/// assert_eq!(input.most().in_bytes(), 100);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Input {
    path: PathBuf,
    most: Memory,
}

impl Input {
    /// The file at `path`, of at most `most` bytes; `-` is standard input.
    pub fn new(path: &Path, most: Memory) -> Self {
        Input { path: path.to_path_buf(), most }
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its size limit.
    pub fn most(&self) -> Memory {
        self.most
    }

    /// Its name in messages.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// The name of the file without its extension.
    pub fn stem(&self) -> String {
        match self.path.file_stem() {
            Some(stem) if !self.is_standard() => stem.to_string_lossy().into_owned(),
            _ => String::new(),
        }
    }

    /// Its contents.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn bytes(&self) -> Result<Vec<u8>> {
        disk::read_bytes(&self.path, self.most)
    }

    /// Its contents as text.
    ///
    /// # Errors
    /// If it cannot be read or is not UTF-8.
    pub fn text(&self) -> Result<String> {
        let bytes = self.bytes()?;
        if bytes.is_empty() {
            return Err(Error::invalid(self.name(), "file", "is empty"));
        }
        String::from_utf8(bytes).map_err(|cause| {
            let good = &cause.as_bytes()[..cause.utf8_error().valid_up_to()];
            let line = 1 + good.iter().filter(|byte| **byte == b'\n').count();
            Error::invalid(self.name(), format!("line {line}"), "is not text")
        })
    }

    /// The file that stores `part` with this file: see [`beside`].
    pub(super) fn companion(&self, main: &str, part: &str) -> Input {
        Input { path: beside(&self.path, main, part), most: self.most }
    }

    /// Whether the file exists.
    pub(super) fn exists(&self) -> bool {
        self.path.is_file()
    }

    fn is_standard(&self) -> bool {
        self.path == Path::new("-")
    }
}

/// The path of the file that stores `part` with the file of the part `main`: `b.mtx` for `A.mtx`,
/// `x_b.mtx` for `x_A.mtx` and for `x.mtx`.
pub(super) fn beside(path: &Path, main: &str, part: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().map(|ending| format!(".{}", ending.to_string_lossy()));
    let prefix = match stem.strip_suffix(main) {
        Some(prefix) if prefix.is_empty() || prefix.ends_with('_') => prefix.to_string(),
        _ => format!("{stem}_"),
    };
    path.with_file_name(format!("{prefix}{part}{}", ending.unwrap_or_default()))
}
