//! Commands that write a document: `explain`, `report`.

use std::process::Command;

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
        (&["-", "--steps", "2"], "--steps: applies to scenes, but the input is a problem"),
        (&["nothing"], "there is no scene file or shipped scene named \"nothing\""),
    ] {
        let refused = run(&[&["explain"], arguments].concat());
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}");
        assert!(err(&refused).contains(message), "{arguments:?}: {}", err(&refused));
    }
}

#[test]
fn a_list_sums_up_each_case_shows_each_closed_form_in_100_columns_and_writes_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let case = |name: &str| {
        let text = format!(
            "title = 'One'\nlead = ''\n[[section]]\nstudy = 'verification'\nsize = 'fast'\n\
             cases = ['{name}']\n"
        );
        std::fs::write(folder.path().join("one.toml"), text).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
        command.args(["report", "one.toml", "--list"]).current_dir(&folder).output().unwrap()
    };
    let table = case("free-fall");
    let text = out(&table);
    assert_eq!(table.status.code(), Some(0), "{}", err(&table));
    // The case, and two numbers under four methods.
    let found: Vec<&str> =
        text.lines().filter(|line| line.trim_start().starts_with("free fall")).collect();
    assert_eq!(found.len(), 1 + 8, "{text}");
    assert!(found[0].ends_with("passed"), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    let heights = text.lines().filter(|line| line.contains("height after 1 s"));
    assert!(heights.into_iter().all(|line| !line.contains('✗')), "{text}");
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
    let unknown = case("free-fly");
    assert_eq!(unknown.status.code(), Some(1));
    assert!(out(&unknown).contains("there is no closed form named \"free-fly\""), "{unknown:?}");
}

#[test]
fn a_report_is_not_begun_if_nothing_can_print_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    command.args(["report", "chapter", "--out", "out.pdf"]).current_dir(path).env("PATH", path);
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        err(&output),
        "error: --out: PATH: contains none of chromium, chromium-browser, google-chrome; one of them is needed to \
         print the page\n"
    );
    assert_eq!(std::fs::read_dir(path).unwrap().count(), 0);
}
