//! `lcplab chapter` and `lcplab diagnose` as a user runs them.

use serde_json::Value;

use crate::cli::{err, out, run, run_with};

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&out(&run(&[&["chapter", "--json"], arguments].concat()))).unwrap()
}

#[test]
fn the_list_has_a_line_an_entry_and_is_the_same_for_machines() {
    let text = out(&run(&["chapter"]));
    let entries = json(&[]);
    let entries = entries.as_array().unwrap();
    assert!(text.contains(&format!("{} entries", entries.len())));
    for entry in entries {
        let id = entry["id"].as_str().unwrap();
        let line = text.lines().find(|line| line.trim_start().starts_with(&format!("{id} ")));
        let line = line.unwrap_or_else(|| panic!("no line for {id}"));
        assert!(line.contains(entry["verdict"].as_str().unwrap()), "{line}");
    }
}

#[test]
fn filters_leave_the_selected_entries() {
    let wrong = json(&["--kind", "equations", "--verdict", "wrong"]);
    let ids: Vec<&str> =
        wrong.as_array().unwrap().iter().map(|e| e["id"].as_str().unwrap()).collect();
    let expected = ["(1)", "(4)", "(7)", "(8)", "(9)", "(16)", "(18)", "(20)", "(33)", "(45)"];
    assert_eq!(ids, expected); // the equations that the errata call wrong
    let text = out(&run(&["chapter", "--kind", "equations", "--verdict", "wrong"]));
    assert!(text.contains("10 entries") && !text.contains("Code 6"), "{text}");
}

#[test]
fn one_entry_is_shown_with_its_errata_and_its_code() {
    for name in ["(16)", "16"] {
        let text = out(&run(&["chapter", name]));
        for part in ["K&M (16)", "wrong: ", "E21", "body::State::advanced", "lcplab lesson 3"] {
            assert!(text.contains(part), "{part}\n{text}");
        }
    }
    assert_eq!(json(&["T20"])["errata"][0], "E07");
}

#[test]
fn an_erratum_is_shown_with_its_example_run() {
    let output = run(&["chapter", "e21"]);
    assert_eq!(output.status.code(), Some(0));
    // The printed line gives 1.8038 for a height of 100.019.
    let text = out(&output);
    for part in
        ["E21: ", "1.8038", "100.019", "Shown: the printed form fails, the corrected one holds"]
    {
        assert!(text.contains(part), "{part}\n{text}");
    }
    assert_eq!(json(&["E21"])["example"], "shown");
    let page = out(&run(&["chapter", "E06", "--format", "html"]));
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains("E06"));
}

#[test]
fn the_errata_are_listed_with_what_their_examples_showed() {
    let errata = json(&["errata"]);
    for erratum in errata.as_array().unwrap() {
        assert!(["shown", "in words"].contains(&erratum["example"].as_str().unwrap()), "{erratum}");
    }
    let text = out(&run(&["chapter", "errata"]));
    assert!(text.contains("E06") && !text.contains("not shown"), "{text}");
}

#[test]
fn key_terms_and_literature_are_pages() {
    let glossary = out(&run(&["chapter", "glossary"]));
    assert!(
        glossary.contains("Moment of inertia") && glossary.contains("Unit: kg m²."),
        "{glossary}"
    );
    let page = out(&run(&["chapter", "references", "--format", "markdown"]));
    assert!(page.contains("Cottle, Pang & Stone 1992"), "{page}");
}

#[test]
fn what_is_not_there_is_one_message() {
    for (arguments, message) in [
        (&["chapter", "T66"][..], "there is no entry of the chapter named \"T66\""),
        (&["chapter", "E99"], "there is no erratum named \"e99\""),
        (&["chapter", "--kind", "poems"], "there is no kind of entry named \"poems\""),
        (&["chapter", "--verdict", "fine"], "there is no verdict named \"fine\""),
        (&["chapter", "16", "--kind", "notes"], "options: --kind: applies to the list, not to 16"),
        (&["chapter", "glossary", "--json"], "options: --json: applies only to entries and errata"),
        (&["diagnose", "nothing"], "there is no scene file or shipped scene named \"nothing\""),
        (
            &["diagnose", "-", "--step", "2"],
            "standard input: --step: applies to scenes, but the input is a problem",
        ),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(err(&output).contains(message), "{}", err(&output));
        assert_eq!(out(&output), "");
    }
}

#[test]
fn a_diagnosis_exits_with_1_where_no_step_can_be_taken() {
    let fig8 = run(&["diagnose", "fig8"]);
    assert_eq!(fig8.status.code(), Some(1));
    assert!(out(&fig8).contains("proved in exact arithmetic"));
    let bricard = run(&["diagnose", "bricard"]);
    assert_eq!(bricard.status.code(), Some(0));
    let left = "remaining degrees of freedom";
    assert!(out(&bricard).lines().any(|l| l.contains(left) && l.ends_with(" 1")));
    let wedge = r#"{"A": {"dense": [[1, -1], [-1, 1]]}, "b": [-1, -1]}"#;
    assert_eq!(run_with(wedge, &["diagnose", "-"]).status.code(), Some(1));
}

#[test]
fn a_listing_is_shown_in_both_forms() {
    let text = out(&run(&["chapter", "Code 6"])).replace('\n', " ");
    for part in
        ["Printed, the iterative solver: ", "clamp x after each sweep", "Corrected: ", "E06"]
    {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let entry = json(&["operators"]);
    assert!(entry["corrected"].as_str().unwrap().contains("const references"), "{entry}");
    assert!(json(&["16"]).get("printed").is_none());
}

#[test]
fn a_diagnosis_is_the_same_for_machines() {
    // Two nails and the rod between them: 7 rows in 6 components, one of them too many.
    let fig8 = run(&["diagnose", "fig8", "--json"]);
    assert_eq!(fig8.status.code(), Some(1));
    let found: Value = serde_json::from_str(&out(&fig8)).unwrap();
    assert_eq!((&found["rank"], &found["is_sound"]), (&6.into(), &false.into()));
    assert_eq!(found["rows"].as_array().unwrap().len(), 7);
    assert_eq!(found["degrees_of_freedom"]["left"], 0);
    assert_eq!(found["dependencies"].as_array().unwrap().len(), 1);
    let cause = &found["causes"][0];
    assert_eq!((&cause["name"], &cause["is_fatal"]), (&"impossible".into(), &true.into()));
    assert_eq!(cause["rows"].as_array().unwrap().len(), 3);
    let text = out(&run(&["diagnose", "fig8"])).replace('\n', " ");
    assert!(text.contains(cause["message"].as_str().unwrap()), "{text}");
    // A problem has no bodies whose freedom could be counted.
    let free = r#"{"A": {"dense": [[2, 0], [0, 1]]}, "b": [-1, -1]}"#;
    let output = run_with(free, &["diagnose", "-", "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let found: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((&found["rank"], &found["degrees_of_freedom"]), (&2.into(), &Value::Null));
    assert_eq!(found["causes"], Value::Array(Vec::new()));
}
