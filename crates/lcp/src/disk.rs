//! Reads whole files, up to a size limit.
//!
//! ```
//! use lcplab_lcp::disk::{check_name, is_name, is_there, read, read_bytes};
//! use lcplab_lcp::memory::Memory;
//!
//! let folder = tempfile::tempdir().unwrap();
//! let path = folder.path().join("note.txt");
//! assert!(!is_there(&path) && !is_there(folder.path())); // a folder is not read
//! std::fs::write(&path, "9.81 m/s²").unwrap();
//! assert_eq!(read(&path, Memory::bytes(100))?, "9.81 m/s²");
//! assert_eq!(read_bytes(&path, Memory::bytes(100))?.len(), 10); // ² takes two bytes
//! assert!(read(&path, Memory::bytes(9)).is_err());
//!
//! assert!(is_name("stack-2") && !is_name("../stack"));
//! assert!(check_name("../stack").unwrap_err().contains("use only letters"));
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use crate::error::{Error, Result};
use crate::memory::Memory;

/// Size limit for files that people write, such as scenes.
pub const WRITTEN_BY_HAND: Memory = Memory::bytes(100_000_000);

/// Whether the path can be read: a file, a pipe or a device, but not a folder, which may have the
/// same name as a built-in scene or problem.
pub fn is_there(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|found| !found.is_dir())
}

/// Whether this is allowed as the name of a file in one of lcplab's folders: letters, digits, `_`
/// and `-`, so that it cannot lead to another folder.
pub fn is_name(name: &str) -> bool {
    let is_allowed = |c: char| c.is_ascii_alphanumeric() || "_-".contains(c);
    !name.is_empty() && name.chars().all(is_allowed)
}

/// Explains why a name is not allowed.
///
/// # Errors
/// If it [cannot be](is_name) the name of a file.
pub fn check_name(name: &str) -> std::result::Result<(), String> {
    match is_name(name) {
        true => Ok(()),
        false => Err(format!("{name:?} becomes a file name: use only letters, digits, - and _")),
    }
}

/// Reads a file of text, or standard input for the path `-`.
///
/// # Errors
/// If it cannot be read, is larger than `most`, or is not UTF-8.
pub fn read(path: &Path, most: Memory) -> Result<String> {
    let not_text = |_| io::Error::new(io::ErrorKind::InvalidData, "is not UTF-8 text");
    let text = String::from_utf8(read_bytes(path, most)?).map_err(not_text);
    text.map_err(|cause| Error::file(path, &cause))
}

/// Reads a file of any kind, or standard input for the path `-`.
///
/// # Errors
/// If it cannot be read or is larger than `most`.
pub fn read_bytes(path: &Path, most: Memory) -> Result<Vec<u8>> {
    let bytes = match path == Path::new("-") {
        true => read_from(io::stdin().lock(), most),
        false => File::open(path).and_then(|file| read_from(file, most)),
    };
    match bytes.map_err(|cause| Error::file(path, &cause))? {
        Some(bytes) => Ok(bytes),
        None => Err(Error::File {
            path: path.display().to_string(),
            reason: format!("is larger than {most}, the limit for reading"),
        }),
    }
}

/// All bytes; `None` if there are more than `most`.
fn read_from(source: impl Read, most: Memory) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    source.take(most.in_bytes().saturating_add(1)).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= most.in_bytes()).then_some(bytes))
}
