//! Public bug reports and questions as their authors would bring them to the program, with the
//! right answer from a source other than lcplab. `tests/field.md` lists them, and those that were
//! not tried.

mod mistakes;
mod problems;
mod scenes;

use serde_json::Value;

use super::cli::{out, run, run_with};

/// A number compared with a value of another source.
#[track_caller]
fn assert_near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value}, expected {expected}");
}

/// A problem of these rows, with the bounds 0 and ∞ unless `more` states others.
fn problem(a: &[&[f64]], b: &[f64], more: &str) -> String {
    let comma = if more.is_empty() { "" } else { ", " };
    format!(r#"{{"A": {{"dense": {a:?}}}, "b": {b:?}{comma}{more}}}"#)
}

/// The output of a command that prints one JSON object about a problem.
fn json(problem: &str, command: &[&str]) -> Value {
    let output = run_with(problem, &[command, &["--json"]].concat());
    let text = out(&output);
    serde_json::from_str(&text).unwrap_or_else(|_| panic!("{command:?}: {text}"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// The files of a test in a folder for it alone.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Folder(tempfile::tempdir().unwrap())
    }

    /// Writes a file and returns its path.
    fn file(&self, name: &str, text: &str) -> String {
        let path = self.0.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    }
}

/// The judge's verdict on x.
fn verdict(problem: &str, x: &[f64]) -> Value {
    let folder = Folder::new();
    let answer = folder.file("x.json", &format!("{{\"x\": {x:?}}}"));
    json(problem, &["judge", "-", &answer])
}

/// What `simulate --json` prints about a scene.
fn simulated(scene: &str, more: &[&str]) -> Value {
    let folder = Folder::new();
    let path = folder.file("scene.toml", scene);
    let output = run(&[&["simulate", &path, "--json"], more].concat());
    serde_json::from_str(&out(&output)).unwrap()
}

/// A body at the end of a simulation: what is under this key.
fn at_end(simulated: &Value, body: &str, key: &str) -> Vec<f64> {
    let states = simulated["states"].as_array().unwrap();
    numbers(&states.iter().find(|state| state["body"] == body).unwrap()[key])
}
