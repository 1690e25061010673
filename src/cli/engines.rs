//! `report engines --engine NAMES`: the Python package runs physics engines before the page is drawn.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use lcplab::error::{Error, Result};
use lcplab::file;

/// The environment variable that names another interpreter than `python3`.
const INTERPRETER: &str = "LCPLAB_PYTHON";
/// All engines that are installed.
const ALL: &str = "all";

/// Runs these engines, with commas between them, on every phenomenon; returns the record, which is in this folder.
///
/// # Errors
/// If there is no interpreter or package, or an engine is not installed.
pub fn run(names: &str, folder: &Path) -> Result<PathBuf> {
    file::prepare(folder)?;
    let record = folder.join("engines.json");
    let python = env::var_os(INTERPRETER).unwrap_or_else(|| "python3".into());
    let mut command = Command::new(&python);
    command.args(["-m", "lcplab.cards", "--out"]).arg(&record);
    if names != ALL {
        command.args(["--engine", names]);
    }
    let refused = |reason: String| {
        let hint = "it needs lcplab's Python package (pip install ./python)";
        let program = python.display();
        Error::invalid("--engine", "engines", format!("{program} -m lcplab.cards {reason}; {hint}"))
    };
    match command.status() {
        Ok(status) if status.success() => Ok(record),
        Ok(status) => Err(refused(format!("ended with {status}"))),
        Err(cause) => Err(refused(format!("did not start: {cause}"))),
    }
}
