//! `gradient`: its options, and what it refuses.

use std::fs;

use serde_json::Value;

use super::{GOOD, err, out, run, run_with};

#[test]
fn both_sides_of_a_kink_are_printed() {
    let folder = tempfile::tempdir().unwrap();
    let change = folder.path().join("change.json").display().to_string();
    fs::write(&change, r#"{"b": [2]}"#).unwrap();
    // x = max(0, −b/4)
    let contact = r#"{"A": {"dense": [[4]]}, "b": [0]}"#;
    let output = run_with(contact, &["gradient", "-", "--direction", &change]);
    let text = out(&output);
    assert_eq!(output.status.code(), Some(0));
    assert!(text.contains("derivative kink at row 0, at a bound with w = 0"), "{text}");
    assert!(text.ends_with("derivative from the left\n  dx         0: −0.5\n"), "{text}");
    let output = run_with(contact, &["gradient", "-", "--direction", &change, "--json"]);
    let json: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((&json["kinks"][0], &json["left"]["dx"][0]), (&0.into(), &(-0.5).into()));
}

#[test]
fn the_motion_of_a_step_is_differentiated() {
    let folder = tempfile::tempdir().unwrap();
    let step = folder.path().join("step.json").display().to_string();
    run(&["export", "stack", "--step", "1", "--out", &step]);
    // Four corners carry each box: only the motion has a derivative, which is 0 for a box at rest.
    let text = out(&run(&["gradient", &step, "--motion", "2"]));
    assert!(
        text.contains("derivative x is not unique: derivatives are those of the motion"),
        "{text}"
    );
    assert!(text.ends_with("gradient of u_2\n  all entries are 0\n"), "{text}");
}

#[test]
fn what_has_no_derivative_is_refused_with_its_reason() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name).display().to_string();
        fs::write(&path, text).unwrap();
        path
    };
    let wrong = file("wrong.json", r#"{"x": [3, 3]}"#);
    let direction = file("direction.json", r#"{"b": [1]}"#);
    let theirs = file("theirs.json", r#"{"dx_db": [[1, 2]]}"#);
    let unknown = file("unknown.json", r#"{"beta": [1]}"#);
    for (arguments, message) in [
        (&["--row", "2"][..], "error: options: --row: is 2, x has 2 entries"),
        (&["--motion", "0"], "error: options: --motion: is 0, u has 0 entries"),
        (&[&wrong], "error: answer: x: no exact solution is known next to it (not a solution"),
        (&["--direction", &direction], "error: direction: b: has 1 entries, must have 2"),
        (&["--direction", &unknown], "unknown field `beta`"),
        (&["--theirs", &theirs], "dx_db: must be 2 × 2"),
    ] {
        let output = run_with(GOOD, &[&["gradient", "-"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(err(&output).contains(message), "{}", err(&output));
    }
    // Two supports share a load.
    let output =
        run_with(r#"{"A": {"dense": [[1, 1], [1, 1]]}, "b": [-1, -1]}"#, &["gradient", "-"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("derivative x is not unique: it has no derivative"));
}
