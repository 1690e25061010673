//! The examples of the documentation.

use std::path::{Path, PathBuf};
use std::process::Command;

use lcplab_plugin::Plugin;
use lcplab_problem::library;
use lcplab_solver::Status;

use super::{LONG, pushed, solve, start};

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/plugins").join(name)
}

/// Its answers to two problems are right to the last digits.
fn solves(plugin: &Plugin) {
    let definite = library::by_name("pd").unwrap().generate(&[("n", 8.0)]).unwrap().lcp;
    for lcp in [pushed(), definite] {
        let (solution, certificate) = solve(plugin, &lcp);
        assert_eq!(solution.status, Status::Solved);
        assert!(certificate.scaled_residual < 1e-12, "{certificate:?}");
    }
    let (solution, _) = solve(plugin, &pushed());
    assert_eq!(solution.x, [0.5, 0.0]);
}

#[test]
fn eleven_lines_of_python_are_a_solver() {
    let text = std::fs::read_to_string(example("sweeps.py")).unwrap();
    assert_eq!(text.lines().count(), 11);
    let plugin = start(&example("sweeps.py"), LONG);
    assert_eq!(plugin.name(), "sweeps");
    solves(&plugin);
}

#[test]
fn forty_lines_of_c_plus_plus_are_a_solver() {
    let text = std::fs::read_to_string(example("sweeps.cpp")).unwrap();
    assert!(text.lines().count() <= 45);
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("sweeps_cpp");
    let compiler = Command::new("c++")
        .args(["-std=c++17", "-O2", "-o"])
        .args([&program, &example("sweeps.cpp")])
        .output()
        .expect("a C++ compiler");
    assert!(compiler.status.success(), "{}", String::from_utf8_lossy(&compiler.stderr));
    solves(&Plugin::start(&program.display().to_string(), LONG.as_secs_f64()).unwrap());
}
