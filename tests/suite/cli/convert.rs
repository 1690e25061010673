//! `convert`, and problems in the formats of other programs.

use serde_json::Value;

use super::friction::pushed;
use super::{GOOD, err, out, run, run_with};

#[test]
fn problems_are_converted_and_taken_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    for name in ["good.mtx", "good.npz", "good.qps", "good.dat"] {
        let written = run_with(GOOD, &["convert", "-", &path(name)]);
        assert_eq!((written.status.code(), err(&written).as_str()), (Some(0), ""), "{name}");
        let solved = run(&["solve", &path(name), "--json"]);
        let answer: Value = serde_json::from_str(&out(&solved)).unwrap();
        assert_eq!((&answer["verdict"], &answer["x"]), (&"proved".into(), &serde_json::json!([0.5, 0.0])));
        assert_eq!(run(&["diagnose", &path(name)]).status.code(), Some(0));
    }
    let back = run(&["convert", &path("good"), "-"]); // the stem of good.mtx
    let problem: Value = serde_json::from_str(&out(&back)).unwrap();
    assert_eq!(problem["b"], serde_json::json!([-1.0, 2.0]));
    let compared = run(&["compare-solvers", &path("good.npz"), "--solver", "pgs", "--json"]);
    let rows: Value = serde_json::from_str(&out(&compared)).unwrap();
    assert_eq!((&rows["rows"][0]["accepted"], compared.status.code()), (&1.into(), Some(0)));
}

#[test]
fn what_a_format_cannot_carry_is_refused_or_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let refused = run_with(&pushed(), &["convert", "-", &path("pushed.qps")]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(err(&refused).contains("qps: friction_index: is given"));
    let named = run_with(&pushed(), &["convert", "-", &path("pushed.npz")]);
    assert_eq!(err(&named), "note: left behind: source, frozen_at\n");
    assert!(err(&run_with(GOOD, &["convert", "-", "-", "--to", "npz"])).contains("it needs a file"));
    assert!(out(&run(&["convert", "--list"])).contains("siconos        Siconos: "));
}
