//! Commands that write a document: `explain`, `verify`, `report`.

use std::process::Command;

use serde_json::Value;

use super::{GOOD, err, out, run, run_with};

#[test]
fn explain_writes_each_form_and_refuses_what_it_does_not_know() {
    let text = out(&run(&["explain", "fig6", "--solver", "pgs"]));
    assert!(text.contains("x₀ = 2 N s") && !text.contains('\u{1b}'), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("fig6.html");
    let page = page.to_str().unwrap();
    assert_eq!(run(&["explain", "fig6", "--format", "html", "--out", page]).status.code(), Some(0));
    assert!(std::fs::read_to_string(page).unwrap().starts_with("<!DOCTYPE html>"));
    let problem = run_with(GOOD, &["explain", "-", "--format", "markdown"]);
    assert!(out(&problem).starts_with("# pair, by dantzig\n"));
    for (arguments, message) in [
        (&["fig6", "--solver", "simplex"][..], "there are pgs, sor, dantzig, lemke"),
        (&["fig6", "--format", "pdf"], "possible values: text, markdown, html"),
        (&["fig6", "--solver", "pgs", "--omega", "1.2"], "pgs does not use it; sor does"),
        (&["fig6", "--solver", "sor", "--omega", "2.5"], "must lie between 0 and 2, is 2.5"),
        (&["-", "--steps", "2"], "--steps: is for scenes, this is a problem"),
        (&["nothing"], "there is no scene file or shipped scene named \"nothing\""),
    ] {
        let refused = run(&[&["explain"], arguments].concat());
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}");
        assert!(err(&refused).contains(message), "{arguments:?}: {}", err(&refused));
    }
}

#[test]
fn verify_prints_a_row_a_closed_form_and_says_how_many_pass() {
    let table = run(&["verify", "--only", "free-fall", "--fast"]);
    assert_eq!(table.status.code(), Some(0), "{}", err(&table));
    assert!(out(&table).ends_with("8 of 8 rows pass\n"), "{}", out(&table));
    let json = run(&["verify", "--only", "free-fall", "--fast", "--json"]);
    let page: Value = serde_json::from_str(&out(&json)).unwrap();
    // Semi-implicit Euler's height is of first order: the derived order, and the observed one.
    let row = &page["rows"][1];
    assert_eq!(row["row"]["criterion"]["order"], 1.0);
    assert!((row["observed_order"].as_f64().unwrap() - 1.0).abs() < 0.1, "{row}");
    let unknown = run(&["verify", "--only", "free-fly"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(err(&unknown).contains("there is no closed form named \"free-fly\""));
}

#[test]
fn a_report_is_not_begun_if_nothing_can_print_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    command.args(["report", "chapter", "--pdf", "--out"]).arg(path.join("out")).env("PATH", path);
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        err(&output),
        "error: --pdf: PATH: has none of chromium, chromium-browser, google-chrome, one of which prints the \
         page\n"
    );
    assert!(!path.join("out").exists());
}
