//! `report engines --engine NAMES`: the Python package runs physics engines before the page is
//! drawn.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};
use std::time::Duration;
use std::{env, thread};

use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::memory::Memory;
use lcplab::plugin::group::ProcessGroup;
use lcplab::solver::{Reason, Stop};

/// The environment variable for an interpreter other than `python3`.
const INTERPRETER: &str = "LCPLAB_PYTHON";
/// The file of the record in the report's folder.
const RECORD: &str = "engines.json";
/// The name for all installed engines.
const ALL: &str = "all";
/// The interval for checking whether the engines have finished, or a stop is due.
const LOOK: Duration = Duration::from_millis(50);

/// Runs these engines, separated by commas, on every phenomenon; returns the record, which is in
/// this folder, or why they were stopped.
///
/// # Errors
/// If no engine is named, there is no interpreter or package, an engine is not installed, or no
/// record was written.
pub fn run(
    names: &str,
    folder: &Path,
    stop: &Stop,
) -> Result<std::result::Result<PathBuf, Reason>> {
    if names.split(',').any(|name| name.trim().is_empty()) {
        let reason = format!("{names:?} names no engine; {ALL} runs all installed engines");
        return Err(Error::invalid("--engine", "engines", reason));
    }
    file::prepare(folder, &[RECORD])?;
    // Python follows links, so its file is not created in a folder that may contain some.
    let own = tempfile::tempdir().map_err(|cause| Error::file(&env::temp_dir(), &cause))?;
    let part = own.path().join(RECORD);
    let python = env::var_os(INTERPRETER).filter(|name| !name.is_empty());
    let python = python.unwrap_or_else(|| "python3".into());
    let refused = |reason: String| {
        let words = format!("{} -m lcplab.cards {reason}", python.display());
        Error::invalid("--engine", "engines", words)
    };
    let mut command = Command::new(&python);
    command.args(["-m", "lcplab.cards", "--out"]).arg(&part);
    if names != ALL {
        command.args(["--engine", names]);
    }
    let group = ProcessGroup::spawn(&mut command);
    let group = group.map_err(|cause| {
        refused(format!("did not start: {cause}; set {INTERPRETER} to use another interpreter"))
    })?;
    match ended(group, stop).map_err(|cause| refused(cause.to_string()))? {
        Err(reason) => return Ok(Err(reason)),
        Ok(status) if !status.success() => {
            // The package exists if it has rejected its arguments.
            let package = match status.code() {
                Some(2) => "",
                _ => "; to install lcplab's Python package: pip install ./python",
            };
            return Err(refused(format!("ended with {status}; its message is above{package}")));
        }
        Ok(_) => {}
    }
    if !part.is_file() {
        return Err(refused("wrote no record".into()));
    }
    file::write_in(folder, RECORD, file::read(&part, Memory::default())?)?;
    Ok(Ok(folder.join(RECORD)))
}

/// How a process ended, or why it was stopped.
fn ended(
    mut group: ProcessGroup,
    stop: &Stop,
) -> std::io::Result<std::result::Result<ExitStatus, Reason>> {
    loop {
        if let Some(status) = group.try_wait()? {
            return Ok(Ok(status));
        }
        if let Some(reason) = stop.reason() {
            return Ok(Err(reason));
        }
        thread::sleep(LOOK);
    }
}
