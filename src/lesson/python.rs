//! The files that pages need to run their Python cells.

use std::path::Path;

use serde_json::Value;

use super::ARRAYS;
use crate::error::{Error, Result};
use crate::file;
use crate::memory::Memory;
use crate::page::PYTHON_WORKER;

/// Size limit for a file of a Pyodide distribution.
const LARGEST: Memory = Memory::bytes(200_000_000);

/// The parts of the interpreter besides its script.
const PARTS: [&str; 3] = ["pyodide.mjs", "pyodide.asm.wasm", "python_stdlib.zip"];

/// The script of the interpreter in newer and older distributions.
const SCRIPTS: [&str; 2] = ["pyodide.asm.mjs", "pyodide.asm.js"];

/// Copies what the pages of a folder need to run their Python cells into it: Pyodide from an
/// unpacked distribution, with its NumPy if it has it, and `arrays.py` for where it does not.
///
/// ```
/// use lcplab::lesson::write_python;
///
/// let folder = tempfile::tempdir().unwrap();
/// assert!(write_python(folder.path(), folder.path()).is_err()); // no Pyodide in it
/// ```
///
/// # Errors
/// If the folder is not a Pyodide distribution, or a file cannot be written.
pub fn write_python(pyodide: &Path, folder: &Path) -> Result<()> {
    let from = |name: &str| pyodide.join(name);
    let script = SCRIPTS.into_iter().find(|name| from(name).exists()).unwrap_or(SCRIPTS[0]);
    for name in PARTS.into_iter().chain([script]) {
        copy(&from(name), folder, name)?;
    }
    let mut lock = read_lock(&from("pyodide-lock.json"))?;
    let numpy = lock["packages"]["numpy"]["file_name"].as_str().map(String::from);
    let numpy = numpy.filter(|name| is_wheel(name) && from(name).exists());
    if let Some(name) = &numpy {
        copy(&from(name), folder, name)?;
    }
    if let Some(packages) = lock["packages"].as_object_mut() {
        packages.retain(|name, _| name == "numpy" && numpy.is_some());
    }
    file::write_in(folder, "python/pyodide/pyodide-lock.json", lock.to_string())?;
    file::write_in(folder, "python/worker.js", PYTHON_WORKER)?;
    file::write_in(folder, "arrays.py", ARRAYS)
}

fn is_wheel(name: &str) -> bool {
    name.ends_with(".whl") && !name.contains(['/', '\\'])
}

fn read_lock(path: &Path) -> Result<Value> {
    let text = file::read(path, LARGEST).map_err(not_pyodide)?;
    serde_json::from_str(&text)
        .map_err(|error| Error::invalid(path.display().to_string(), "JSON", error.to_string()))
}

fn copy(path: &Path, folder: &Path, name: &str) -> Result<()> {
    let bytes = file::read_bytes(path, LARGEST).map_err(not_pyodide)?;
    file::write_in(folder, format!("python/pyodide/{name}"), bytes)
}

/// The error of a file that is missing, with what the folder should be.
fn not_pyodide(error: Error) -> Error {
    match error {
        Error::File { path, reason } => Error::File {
            path,
            reason: format!(
                "{reason}; the folder must be an unpacked Pyodide distribution, for example \
                 node_modules/pyodide after `npm install pyodide`"
            ),
        },
        other => other,
    }
}
