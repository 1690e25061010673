//! Recognizes files of another kind by their first bytes, for better error messages.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::Format;
use lcplab_lcp::error::Error;
use lcplab_lcp::xml;

/// The number of bytes in which a root element of XML is searched; comments may precede it.
const BEGINNING: u64 = 1 << 16;

/// The first bytes of a kind of files, the format that reads them, and a message about them.
const KINDS: [(&[u8], &str, &str); 4] = [
    (b"MATLAB ", "mat", "is a MATLAB file, but its name does not end in .mat"),
    (b"version https://git-lfs", "", "is a pointer of Git LFS: the file itself was not fetched"),
    (b"\x89HDF\r\n", "fclib", "is an HDF5 file, but its name does not end in .hdf5 or .h5"),
    (b"PK\x03\x04", "npz", "is an archive of arrays, but its name does not end in .npz"),
];

/// The error of a file that could not be read in a format; it names the file's kind if that is
/// known.
pub(super) fn explained(error: Error, path: &Path, format: &Format) -> Error {
    let Some(start) = beginning(path) else { return error };
    let is_other = |(beginning, reader, _): &&(&[u8], &str, &str)| {
        start.starts_with(beginning) && *reader != format.name
    };
    let kind = KINDS.iter().find(is_other).map(|(_, _, reason)| (*reason).to_string());
    match kind.or_else(|| xml::reason(&String::from_utf8_lossy(&start))) {
        Some(reason) => Error::invalid(path.display().to_string(), "file", reason),
        None if is_guess(path, format) && !is_object(&start) => {
            Error::invalid(path.display().to_string(), "extension", super::unknown_ending(|_| true))
        }
        None => error,
    }
}

/// Whether the file was read as JSON only because its extension is unknown.
fn is_guess(path: &Path, format: &Format) -> bool {
    format.name == "json" && path.extension().is_some() && Format::of(path).is_none()
}

/// Whether a text begins as a JSON object.
fn is_object(start: &[u8]) -> bool {
    start.trim_ascii_start().starts_with(b"{")
}

fn beginning(path: &Path) -> Option<Vec<u8>> {
    let mut start = Vec::new();
    // A pipe cannot be read twice.
    let is_file = path.is_file();
    let file = is_file.then(|| File::open(path).ok()).flatten()?;
    file.take(BEGINNING).read_to_end(&mut start).ok()?;
    Some(start)
}
