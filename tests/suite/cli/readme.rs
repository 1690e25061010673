//! The examples in the documentation are those of a run.

use lcplab::number::plain;
use lcplab::report::view;

use super::{out, run, run_with};
use crate::report::reference::STANDARD;

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
fn the_summary_on_the_page_of_reports_is_that_of_a_run() {
    let page = include_str!("../../../docs/reports.md");
    let document = view::document(&STANDARD).unwrap();
    let (_, table) = document.tables.iter().find(|(id, _)| id == "summary").unwrap();
    // A number near rounding differs between processors.
    let exact =
        |text: &str| text.split(' ').filter(|word| !word.contains("e-")).collect::<String>();
    let table = plain(&table.csv());
    let (_, rest) = page.split_once("$ lcplab report\n").unwrap();
    // The text follows the id of the section; long lines continue below.
    let mut shown: Vec<String> = Vec::new();
    for line in rest.lines().take_while(|line| !line.starts_with("reports/")) {
        match (line.split_at(15), shown.last_mut()) {
            ((id, more), Some(result)) if id.trim().is_empty() => *result += &format!(" {more}"),
            ((_, result), _) => shown.push(result.to_string()),
        }
    }
    assert_eq!(shown.len(), table.lines().count() - 1);
    for result in shown {
        assert!(exact(&table).contains(&exact(&result)), "{result}");
    }
}

#[test]
fn the_examples_of_the_page_on_gradients_are_those_of_a_run() {
    let page = include_str!("../../../docs/gradients.md");
    let problem = out(&run(&["problems", "pushed-mass"]));
    let output = out(&run_with(&problem, &["gradient", "-", "--row", "1"]));
    assert!(page.contains(&output), "{output}");
    let folder = tempfile::tempdir().unwrap();
    let [step, theirs] = ["step.json", "theirs.json"].map(|name| folder.path().join(name));
    run(&["export", "fig7", "--step", "1", "--out", &step.display().to_string()]);
    std::fs::write(&theirs, r#"{"dx_db": [[3, 2, 1], [2, 2, 1], [1, 1, 1]]}"#).unwrap();
    let arguments = [&step, &theirs].map(|path| path.display().to_string());
    let wrong = run(&["gradient", &arguments[0], "--theirs", &arguments[1]]);
    assert_eq!(wrong.status.code(), Some(1));
    let (_, found) = page.split_once("--theirs mine.json\n").unwrap();
    assert!(out(&wrong).ends_with(&found[..found.find("```").unwrap()]), "{}", out(&wrong));
}

#[test]
fn the_example_of_the_page_on_single_precision_is_that_of_a_run() {
    let page = include_str!("../../../docs/precision.md");
    let (_, problem) = page.split_once("```json\n").unwrap();
    let (problem, _) = problem.split_once("```").unwrap();
    let output = run_with(problem, &["precision", "-", "--solver", "pgs"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(page.contains(&out(&output)), "{}", out(&output));
}

#[test]
fn the_examples_of_the_page_on_commands_are_those_of_a_run() {
    let page = include_str!("../../../docs/commands.md");
    let folder = tempfile::tempdir().unwrap();
    let stack = folder.path().join("stack.json").display().to_string();
    run(&["export", "stack", "--step", "1", "--out", &stack]);
    let output = out(&run(&["solve", &stack, "--solver", "pgs"]));
    assert_eq!(shown(page, "lcplab solve stack.json --solver pgs", 4), lines(&output, 4));
    assert!(output.contains("e-") && !output.contains("×10"), "powers of ten: {output}");
    let row = output.lines().find(|line| line.trim_start().starts_with("row ")).unwrap();
    assert!(page.contains(row), "{row}");
    for arguments in [
        &["chapter", "E21"][..],
        &["diagnose", "mass_ratio3", "--solver", "pgs", "--sweeps", "10"],
        &["diagnose", "fig8"],
    ] {
        let output = words(&out(&run(arguments)));
        let (_, rest) = page.split_once(&format!("$ lcplab {}\n", arguments.join(" "))).unwrap();
        let (block, _) = rest.split_once("```").unwrap();
        for part in block.split("...").map(words).filter(|part| !part.is_empty()) {
            assert!(output.contains(&part), "{part}\n{output}");
        }
    }
}

/// The words of a text, however they are spread over lines.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn the_example_of_the_page_on_the_hunt_is_that_of_a_run() {
    let page = include_str!("../../../docs/hunt.md");
    let output = out(&run(&["hunt", "--solver", "code6", "--measure", "failure"]));
    let command = "lcplab hunt --solver code6 --measure failure | head -12";
    assert_eq!(shown(page, command, 12), lines(&output, 12));
}

#[test]
fn the_example_of_the_page_on_solvers_is_that_of_a_run() {
    let page = include_str!("../../../docs/solvers.md");
    let rod = out(&run(&["problems", "pushed-rod"]));
    let output = out(&run_with(&rod, &["solve", "-", "--model", "coulomb-cone"]));
    let command = "lcplab problems pushed-rod | lcplab solve - --model coulomb-cone";
    // The last digits of the distance depend on the processor.
    let without = |line: String| match line.split_once(" within ") {
        Some((start, rest)) => format!("{start} {}", rest.trim_start_matches(|c| c != ' ')),
        None => line,
    };
    let cut = |lines: Vec<String>| lines.into_iter().map(without).collect::<Vec<_>>();
    assert_eq!(cut(shown(page, command, 5)), cut(lines(&output, 5)));
}
