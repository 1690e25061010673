//! Lessons and exercises: every cell runs, and checks tell right answers from wrong ones.

mod exercise;
mod handout;
mod kernel;
mod notebook;
mod problem;
mod sentences;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::LazyLock;

/// The notebook of this lesson for the Rust kernel, with the outputs of its cells; all are written when the first is wanted.
fn written(name: &str) -> String {
    const FOLDER: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/notebooks");
    static WRITTEN: LazyLock<()> = LazyLock::new(|| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
        let arguments = ["lesson", "--all", "--ipynb", "--rust", "--out", FOLDER];
        let output = command.args(arguments).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    });
    LazyLock::force(&WRITTEN);
    fs::read_to_string(Path::new(FOLDER).join(format!("{name}_rust.ipynb"))).unwrap()
}
