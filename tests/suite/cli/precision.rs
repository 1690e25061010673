//! `precision`: its output, exit codes, and what it refuses.

use serde_json::Value;

use super::{GOOD, err, out, run, run_with};

const THIRDS: &str = r#"{"A": {"dense": [[3, 1], [1, 7]]}, "b": [-1, -1]}"#;

#[test]
fn stages_are_listed_for_people_and_programs() {
    let text = out(&run_with(GOOD, &["precision", "-"]));
    assert!(text.contains("\nsingle precision suffices: "), "{text}");
    assert!(text.contains("solver      dantzig; reference solution proved"), "{text}");
    let output = run_with(GOOD, &["precision", "-", "--json", "--solver", "pgs", "--sweeps", "40"]);
    let json: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((&json["suffices"], &json["sweeps"]), (&true.into(), &40.into()));
    let names: Vec<&Value> =
        json["stages"].as_array().unwrap().iter().map(|stage| &stage["name"]).collect();
    assert_eq!(names, ["data", "sums"]); // no masses, no factor
    assert_eq!(json["x"][0], 0.5);
}

#[test]
fn a_method_that_has_not_converged_is_no_question_of_precision() {
    let output = run_with(GOOD, &["precision", "-", "--solver", "pgs", "--sweeps", "0"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("rounding is not the limit: pgs in double precision"));
    // Also if rounding brings x nearer to the solution than the limit.
    let runs = (1..20).map(|sweeps| {
        let sweeps = sweeps.to_string();
        let arguments = ["precision", "-", "--solver", "pgs", "--json", "--sweeps", &sweeps];
        let json: Value = serde_json::from_str(&out(&run_with(THIRDS, &arguments))).unwrap();
        let [single, double] = ["single", "double"].map(|run| json[run]["relative"].as_f64());
        (sweeps, single.unwrap(), double.unwrap())
    });
    let (sweeps, single, double) = runs.into_iter().find(|run| run.1 < run.2).unwrap();
    let between = (0.5 * (single + double)).to_string();
    let arguments = ["--solver", "pgs", "--sweeps", &sweeps, "--tolerance", &between];
    let output = run_with(THIRDS, &[&["precision", "-"], &arguments[..]].concat());
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("rounding is not the limit"), "{}", out(&output));
}

#[test]
fn the_step_of_a_scene_is_measured_by_its_motion() {
    let step = out(&run(&["export", "bridge", "--step", "1"]));
    let text = out(&run_with(&step, &["precision", "-"]));
    let stages = ["data", "assembly", "sums", "velocity", "all"];
    let rows = text.lines().skip_while(|line| !line.starts_with("stage")).skip(1);
    let names: Vec<&str> = rows.map(|row| row.split(' ').next().unwrap()).collect();
    assert_eq!(names, stages, "{text}");
    assert!(text.contains("most is lost in stage sums"), "{text}");
}

#[test]
fn what_cannot_be_measured_is_refused_with_its_reason() {
    let singular = r#"{"A": {"dense": [[1, 1], [1, 1]]}, "b": [-1, -1]}"#;
    let cone = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, -3],
        "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5], "model": "coulomb-cone"}"#;
    let skew = r#"{"A": {"dense": [[2, 1], [0, 2]]}, "b": [-1, -1]}"#;
    let boxed = r#"{"A": {"dense": [[2]]}, "b": [-1], "hi": [1]}"#;
    for (problem, solver, message) in [
        (singular, "dantzig", "problem: A: is singular: the textbook's dantzig and newton need"),
        (singular, "newton", "problem: A: is singular: the textbook's dantzig and newton need"),
        (skew, "pgs", "problem: A: must be symmetric"),
        (boxed, "interior-point", "has other bounds than 0 and ∞"),
        (cone, "pgs", "model: is coulomb-cone, but errors by precision are about boxes only"),
        (r#"{"A": {"dense": [[0]]}, "b": [1]}"#, "pgs", "A: [0][0] must be positive"),
    ] {
        let output = run_with(problem, &["precision", "-", "--solver", solver]);
        assert_eq!(output.status.code(), Some(2), "{}", out(&output));
        assert!(err(&output).contains(message), "{}", err(&output));
    }
}
