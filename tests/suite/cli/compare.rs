//! `compare` on problems: the library × the solvers.

use serde_json::Value;

use super::{err, out, run};

#[test]
fn the_comparison_has_clarabel_beside_the_solvers_and_a_row_a_model() {
    let output = run(&["compare", "pushed-mass", "stack", "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let result: Value = serde_json::from_str(&out(&output)).unwrap();
    let rows = result["rows"].as_array().unwrap();
    let of = |family: &str, solver: &str| -> Vec<&Value> {
        let of_this = |row: &&Value| row["family"] == family && row["solver"] == solver;
        rows.iter().filter(of_this).map(|row| &row["model"]).collect()
    };
    assert_eq!(of("stack", "clarabel"), [&Value::Null]);
    assert_eq!(of("pushed-mass", "clarabel"), ["frozen-box", "associated-cone"]);
    assert_eq!(of("pushed-mass", "cone-pgs"), ["associated-cone", "coulomb-cone"]);
    assert_eq!(of("pushed-mass", "lemke").len(), 5);
    let none = run(&["compare", "family:stack", "--model", "coulomb-cone"]);
    assert_eq!(none.status.code(), Some(2));
    assert_eq!(err(&none), "error: options: --model: none of these families has friction\n");
}

/// A mass on the ground in the plane, one tangent: x_n = 2, and friction of μ x_n = 1 does not hold
/// it.
const PLANE: &str = r#"{"A": {"dense": [[1, 0], [0, 1]]}, "b": [-2, -3], "friction_index": [-1, 0], "mu": [0, 0.5]}"#;

#[test]
fn contacts_with_one_tangent_are_compared_as_a_coupled_box() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plane.json");
    std::fs::write(&path, PLANE).unwrap();
    let path = path.to_str().unwrap();
    let output = run(&["compare", path, "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let result: Value = serde_json::from_str(&out(&output)).unwrap();
    let rows = result["rows"].as_array().unwrap();
    assert!(rows.iter().all(|row| row["model"] == "coupled-box" && row["problems"] == 1));
    for solver in ["pgs", "dantzig"] {
        let row = rows.iter().find(|row| row["solver"] == solver).unwrap();
        assert_eq!((&row["claimed"], &row["accepted"]), (&1.into(), &1.into()), "{solver}");
    }
    let note = "compared only as a coupled box, because it has no pairs of tangents: ";
    let reason = "contacts: row 0: bounds 1 friction rows, not 2";
    assert_eq!(err(&output), format!("note: {path}: {note}{reason}\n"));
}

/// In the plane Coulomb's cone is the coupled box.
#[test]
fn a_cone_in_the_plane_is_compared_as_the_box_that_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plane.json");
    std::fs::write(&path, PLANE.replacen('{', r#"{"model": "coulomb-cone", "#, 1)).unwrap();
    let output = run(&["compare", path.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let result: Value = serde_json::from_str(&out(&output)).unwrap();
    assert!(result["rows"].as_array().unwrap().iter().any(|row| row["accepted"] == 1));
}

#[test]
fn what_leaves_nothing_to_compare_is_the_option_that_was_given() {
    let reported = |options: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plane.json");
        std::fs::write(&path, PLANE).unwrap();
        let output = run(&[&["compare", path.to_str().unwrap()], options].concat());
        assert_eq!(output.status.code(), Some(2));
        err(&output).lines().last().unwrap().to_string()
    };
    let error = "error: options: --model: none of these problems can be stated under this model";
    assert_eq!(reported(&["--model", "coulomb-cone"]), error);
}

#[test]
fn a_named_solver_that_is_not_made_for_the_problem_is_a_row_with_the_reason() {
    let compare = |arguments: &[&str]| {
        let output = run(&[&["compare", "--json"], arguments].concat());
        let table: Value = serde_json::from_str(&out(&output)).unwrap();
        (table["rows"].as_array().unwrap().clone(), output.status.code(), err(&output))
    };
    let (rows, code, reported) = compare(&["family:stack", "--solver", "cone-pgs"]);
    let reason = "not run: it supports only friction cones, and the problem has none";
    let row = &rows[0];
    assert_eq!(
        (rows.len(), &row["solver"], &row["trouble"]),
        (1, &"cone-pgs".into(), &reason.into())
    );
    assert_eq!((&row["outside"], &row["claimed"]), (&row["problems"], &0.into()));
    assert_eq!(code, Some(1));
    assert!(reported.contains("failed: cone-pgs solves none of"), "{reported}");
    // Beside one that takes part it is a row all the same, and still solves nothing.
    let (rows, code, _) = compare(&["family:stack", "--solver", "cone-pgs", "--solver", "dantzig"]);
    assert_eq!((rows.len(), code), (2, Some(1)));
    // Under a model that was asked for the reason is due under that model; under the usual ones a
    // solver is not expected under all of them.
    let cones = ["pushed-mass", "--model", "coulomb-cone"];
    let named = ["--solver", "pgs", "--solver", "cone-pgs"];
    let (rows, code, _) = compare(&[&cones[..], &named[..]].concat());
    let left_out = rows.iter().find(|row| row["solver"] == "pgs").unwrap();
    assert_eq!(left_out["trouble"], "not run: it supports boxes, not coulomb-cone");
    assert_eq!(code, Some(1));
    let (rows, code, _) = compare(&[&["pushed-mass"], &named[..]].concat());
    let models: Vec<&Value> =
        rows.iter().filter(|row| row["solver"] == "pgs").map(|row| &row["model"]).collect();
    assert_eq!((models, code), (vec![&"frozen-box".into(), &"coupled-box".into()], Some(0)));
}

#[test]
fn who_claims_nothing_has_no_worst_residual() {
    // 0 on the diagonal of cps-2: a sweep divides by it.
    let named = ["compare", "cps-2", "--solver", "pgs", "--solver", "lemke"];
    let output = run(&[&named[..], &["--json"]].concat());
    let result: Value = serde_json::from_str(&out(&output)).unwrap();
    for row in result["rows"].as_array().unwrap() {
        let has_claims = row["claimed"] != 0;
        assert_eq!(row["worst_residual"].is_number(), has_claims, "{row}");
        assert_eq!(has_claims, row["solver"] == "lemke");
    }
    let text = out(&run(&named));
    let row = text.lines().find(|line| line.contains("pgs")).unwrap();
    assert!(row.split_whitespace().any(|word| word == "–"), "{row}");
}

#[test]
fn a_name_of_a_scene_and_of_a_family_is_the_scene_unless_it_says_family() {
    let scene = run(&["compare", "stack", "--steps", "1", "--solver", "dantzig", "--json"]);
    let compared: Value = serde_json::from_str(&out(&scene)).unwrap();
    assert_eq!(compared["comparison"]["scene"], "stack");
    let family = run(&["compare", "family:stack", "--solver", "dantzig", "--json"]);
    let compared: Value = serde_json::from_str(&out(&family)).unwrap();
    assert_eq!(compared["rows"][0]["family"], "stack");
}

#[test]
fn an_option_for_the_other_kind_of_input_is_bad_usage() {
    for (arguments, message) in [
        (
            &["fig6", "--seeds", "2"][..],
            "error: fig6: --seeds: applies to problems, but the input is a scene\n",
        ),
        (&["fig6", "--all"], "error: fig6: --all: applies to problems, but the input is a scene\n"),
        (
            &["pd", "--steps", "2"],
            "error: problems: --steps: applies to a scene, but the inputs are problems\n",
        ),
        (
            &["--dt", "0.1"],
            "error: problems: --dt: applies to a scene, but the inputs are problems\n",
        ),
        (
            &["sliding", "--model", "frozen-box", "--model", "coupled-box"],
            "error: sliding: --model: a scene has one friction model\n",
        ),
    ] {
        let output = run(&[&["compare"], arguments].concat());
        assert_eq!((output.status.code(), err(&output)), (Some(2), message.to_string()));
    }
}

#[test]
fn several_named_solvers_step_a_scene() {
    let named = ["--solver", "pgs", "--solver", "dantzig", "--scheme", "velocity"];
    let output = run(&[&["compare", "fig6", "--steps", "1", "--json"][..], &named].concat());
    let compared: Value = serde_json::from_str(&out(&output)).unwrap();
    let runs = compared["comparison"]["runs"].as_array().unwrap();
    let solvers: Vec<&Value> = runs.iter().map(|run| &run["solver"]).collect();
    assert_eq!(solvers, ["pgs", "dantzig"]);
}
