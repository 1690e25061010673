//! Lessons and problems: every cell runs, and checks tell right answers from wrong ones.

mod assignment;
mod handout;
mod kernel;
mod notebook;
mod problem;
mod python;
mod second_way;
mod sentences;
mod template;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

/// Runs lcplab, which has to succeed.
fn run(arguments: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_lcplab")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// The notebook of this lesson for the Rust kernel, with the outputs of its cells; all are written
/// when the first is wanted.
fn written(name: &str) -> String {
    const FOLDER: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/notebooks");
    static WRITTEN: LazyLock<()> =
        LazyLock::new(|| run(&["lesson", "--all", "--ipynb", "--rust", "--out", FOLDER]));
    LazyLock::force(&WRITTEN);
    fs::read_to_string(Path::new(FOLDER).join(format!("{name}_rust.ipynb"))).unwrap()
}

/// The folder of the pages of all lessons, which are written when it is first wanted.
pub fn pages() -> &'static Path {
    static WRITTEN: LazyLock<PathBuf> = LazyLock::new(|| fresh("lessons", &["lesson", "--all"]));
    &WRITTEN
}

/// The folder of the handout's page, which is written when it is first wanted.
pub fn handout() -> &'static Path {
    static WRITTEN: LazyLock<PathBuf> = LazyLock::new(|| fresh("chapter", &["report", "chapter"]));
    &WRITTEN
}

/// A folder with what this command writes, and nothing of an earlier run.
fn fresh(name: &str, arguments: &[&str]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    run(&[arguments, &["--out", folder.to_str().unwrap()]].concat());
    folder
}
