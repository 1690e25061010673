//! The examples in the documentation are those of a run.

use super::{out, run, run_with};

/// The first lines of an output, without the number of iterations, which rounding on another
/// processor may change.
fn lines(text: &str, count: usize) -> Vec<String> {
    let without_count = |line: &str| {
        let end = if line.starts_with("status") { line.rfind(", ") } else { None };
        line[..end.unwrap_or(line.len())].to_string()
    };
    text.lines().take(count).map(without_count).collect()
}

/// The lines that follow a command in a page.
fn shown(page: &str, command: &str, count: usize) -> Vec<String> {
    let (_, rest) = page.split_once(command).unwrap_or_else(|| panic!("{command} is not shown"));
    let (_, rest) = rest.split_once('\n').unwrap();
    lines(rest, count)
}

#[test]
fn the_examples_of_the_readme_are_those_of_a_run() {
    let readme = include_str!("../../../README.md");
    let folder = tempfile::tempdir().unwrap();
    let stack = folder.path().join("stack.json").display().to_string();
    run(&["export", "stack", "--step", "1", "--out", &stack]);
    for (solver, more, count) in [("pgs", &["--sweeps", "10"][..], 5), ("dantzig", &[], 4)] {
        let output = out(&run(&[&["solve", &stack, "--solver", solver], more].concat()));
        let command = format!("lcplab solve stack.json --solver {solver}");
        assert_eq!(shown(readme, &command, count), lines(&output, count));
    }
}

#[test]
fn the_example_of_the_page_on_solvers_is_that_of_a_run() {
    let page = include_str!("../../../docs/solvers.md");
    let rod = out(&run(&["generate", "pushed-rod"]));
    let output = out(&run_with(&rod, &["solve", "-", "--model", "coulomb-cone"]));
    let command = "lcplab generate pushed-rod | lcplab solve - --model coulomb-cone";
    assert_eq!(shown(page, command, 5), lines(&output, 5));
}
