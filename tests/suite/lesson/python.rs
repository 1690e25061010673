//! The folder with which pages run their Python cells.

use std::fs;
use std::path::Path;

use lcplab::lesson::{ARRAYS, write_python};
use serde_json::{Value, json};

/// A distribution of one-word files, whose lock names two packages.
fn distribution(folder: &Path, script: &str) {
    for name in ["pyodide.mjs", "pyodide.asm.wasm", "python_stdlib.zip", script] {
        fs::write(folder.join(name), name).unwrap();
    }
    let lock = json!({
        "info": { "python": "3.14.2" },
        "packages": {
            "numpy": { "file_name": "numpy-2.4.6-wasm32.whl" },
            "scipy": { "file_name": "scipy-1.17.0-wasm32.whl" },
        },
    });
    fs::write(folder.join("pyodide-lock.json"), lock.to_string()).unwrap();
}

fn packages(out: &Path) -> Vec<String> {
    let lock = fs::read_to_string(out.join("python/pyodide/pyodide-lock.json")).unwrap();
    let lock: Value = serde_json::from_str(&lock).unwrap();
    assert_eq!(lock["info"]["python"], "3.14.2");
    lock["packages"].as_object().unwrap().keys().cloned().collect()
}

#[test]
fn a_distribution_is_copied_with_numpy_where_it_has_it_and_with_arrays_for_where_not() {
    let (from, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    distribution(from.path(), "pyodide.asm.mjs");
    write_python(from.path(), out.path()).unwrap();
    let copied = |name: &str| fs::read_to_string(out.path().join(name)).ok();
    assert_eq!(copied("python/pyodide/pyodide.asm.mjs").as_deref(), Some("pyodide.asm.mjs"));
    assert_eq!(copied("arrays.py").as_deref(), Some(ARRAYS));
    assert!(copied("python/worker.js").unwrap().contains("./pyodide/pyodide.mjs"));
    assert!(packages(out.path()).is_empty());
    for package in ["numpy-2.4.6", "scipy-1.17.0"] {
        fs::write(from.path().join(format!("{package}-wasm32.whl")), package).unwrap();
    }
    write_python(from.path(), out.path()).unwrap();
    assert_eq!(packages(out.path()), ["numpy"]);
    assert_eq!(copied("python/pyodide/numpy-2.4.6-wasm32.whl").as_deref(), Some("numpy-2.4.6"));
    assert_eq!(copied("python/pyodide/scipy-1.17.0-wasm32.whl"), None);
}

#[test]
fn an_older_distribution_has_its_script_under_another_name() {
    let (from, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    distribution(from.path(), "pyodide.asm.js");
    write_python(from.path(), out.path()).unwrap();
    assert!(out.path().join("python/pyodide/pyodide.asm.js").exists());
}

#[test]
fn a_wheel_outside_of_the_distribution_is_not_copied() {
    let (from, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let inside = from.path().join("pyodide");
    fs::create_dir(&inside).unwrap();
    distribution(&inside, "pyodide.asm.mjs");
    fs::write(from.path().join("other.whl"), "other").unwrap();
    let lock = json!({ "info": { "python": "3.14.2" }, "packages": { "numpy": { "file_name": "../other.whl" } } });
    fs::write(inside.join("pyodide-lock.json"), lock.to_string()).unwrap();
    write_python(&inside, out.path()).unwrap();
    assert!(packages(out.path()).is_empty() && !out.path().join("python/other.whl").exists());
}

#[test]
fn a_folder_without_pyodide_is_an_error_that_says_what_it_should_be() {
    let (from, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let error = write_python(from.path(), out.path()).unwrap_err().to_string();
    assert!(error.contains("pyodide.mjs: No such file"), "{error}");
    assert!(error.contains("npm install pyodide"), "{error}");
}
