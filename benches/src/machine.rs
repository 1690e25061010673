//! The machine and the day of a run, as far as the system reports them.

use std::fs::read_to_string;
use std::process::Command;

use crate::recording::Machine;

/// This machine.
pub fn describe() -> Machine {
    Machine {
        processor: field("/proc/cpuinfo", "model name").unwrap_or(std::env::consts::ARCH.into()),
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        system: field("/etc/os-release", "PRETTY_NAME").unwrap_or(std::env::consts::OS.into()),
        compiler: said("rustc", &["--version"]).unwrap_or("rustc".into()),
    }
}

/// Year-month-day, in universal time.
pub fn today() -> String {
    said("date", &["-u", "+%Y-%m-%d"]).unwrap_or_default()
}

/// The value of `key : value` or `key=value`.
fn field(path: &str, key: &str) -> Option<String> {
    let text = read_to_string(path).ok()?;
    let line = text.lines().find(|line| line.starts_with(key))?;
    let value = line.split_once([':', '='])?.1;
    Some(value.trim().trim_matches('"').into())
}

fn said(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    Some(String::from_utf8(output.stdout).ok()?.trim().into())
}
