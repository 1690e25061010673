//! The program as a user runs it: messages, exit codes, pipes.

mod adapters;
mod agreement;
mod bad_input;
mod compare;
mod convert;
mod diagnose;
mod document;
mod exit_code;
mod friction;
mod gradient;
mod hostile;
mod limits;
#[cfg(unix)] // its links
mod links;
mod loads;
mod mistake;
mod plugin;
mod precision;
mod problem_set;
mod proof;
mod readme;
mod receipts;
mod report;
mod scene;
#[cfg(target_os = "linux")] // /proc says whether a process listens
mod signals;
mod solve;
#[cfg(target_os = "linux")] // it has /dev/full, /dev/zero and /proc
mod surroundings;
mod test;
mod usage;
mod wording;

use std::io::Write;
use std::process::{Command, Output, Stdio};

pub const GOOD: &str = r#"{"name": "pair", "A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, 2]}"#;

pub fn run_with(input: &str, arguments: &[&str]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lcplab"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // A program that refuses its arguments need not read its input.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

pub fn run(arguments: &[&str]) -> Output {
    run_with("", arguments)
}

pub fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}
