//! Problems by name: families of the library, and files.

use std::path::Path;

use super::families;
use crate::error::{Error, Result};
use crate::files;
use crate::lcp::file::Problem;
use crate::lcp::library;
use crate::memory::Memory;

/// A named group of problems that are compared together.
pub type Named = (String, Vec<Problem>);

/// The problems of a family of the library, with the seeds 1 … `seeds` if it uses random numbers;
/// of a file; or of each file of a folder or a pattern ([`files::several`]).
///
/// # Errors
/// If there is no such file or family, or a file has defects or needs more memory than `most`.
pub fn named(name: &str, seeds: u32, most: Memory) -> Result<Vec<Named>> {
    let read = |file: &str| {
        let problem = files::read_within(Path::new(file), None, most)?;
        Ok((file.to_string(), vec![problem]))
    };
    let unknown = match library::by_name(name) {
        Ok(family) => return Ok(vec![(name.into(), families::instances(family, seeds))]),
        Err(unknown) => unknown,
    };
    match files::several(name, files::is_problem)? {
        Some(files) => files.iter().map(|file| read(file)).collect(),
        None if files::is_problem(Path::new(name)) => Ok(vec![read(name)?]),
        None if name.contains(['/', '\\', '*']) => {
            let reason = "there is no such file or folder".to_string();
            Err(Error::File { path: name.into(), reason })
        }
        None => Err(unknown),
    }
}
