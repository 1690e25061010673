//! `compare-solvers`: the library × the solvers.

use serde_json::Value;

use super::{err, out, run};

#[test]
fn the_comparison_has_clarabel_beside_the_solvers_and_a_row_a_model() {
    let output = run(&["compare-solvers", "pushed-mass", "stack", "--json"]);
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
    let none = run(&["compare-solvers", "stack", "--model", "coulomb-cone"]);
    assert_eq!(none.status.code(), Some(2));
    assert_eq!(err(&none), "error: options: --model: none of these families has friction\n");
}

/// A mass on the ground in the plane, one tangent: x_n = 2, and friction of μ x_n = 1 does not hold it.
const PLANE: &str = r#"{"A": {"dense": [[1, 0], [0, 1]]}, "b": [-2, -3], "friction_index": [-1, 0], "mu": [0, 0.5]}"#;

#[test]
fn contacts_with_one_tangent_are_compared_as_a_coupled_box() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plane.json");
    std::fs::write(&path, PLANE).unwrap();
    let path = path.to_str().unwrap();
    let output = run(&["compare-solvers", path, "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let result: Value = serde_json::from_str(&out(&output)).unwrap();
    let rows = result["rows"].as_array().unwrap();
    assert!(rows.iter().all(|row| row["model"] == "coupled-box" && row["problems"] == 1));
    for solver in ["pgs", "dantzig"] {
        let row = rows.iter().find(|row| row["solver"] == solver).unwrap();
        assert_eq!((&row["claimed"], &row["accepted"]), (&1.into(), &1.into()), "{solver}");
    }
    let note = "compared as a coupled box alone, for it has no pairs of tangents: ";
    let reason = "contacts: row 0: bounds 1 friction rows, not 2";
    assert_eq!(err(&output), format!("note: {path}: {note}{reason}\n"));
}

#[test]
fn what_leaves_nothing_to_compare_is_the_option_that_was_given() {
    let told = |options: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plane.json");
        std::fs::write(&path, PLANE).unwrap();
        let output = run(&[&["compare-solvers", path.to_str().unwrap()], options].concat());
        assert_eq!(output.status.code(), Some(2));
        err(&output).lines().last().unwrap().to_string()
    };
    let error = "error: options: --model: none of these problems can be stated under this model";
    assert_eq!(told(&["--model", "coulomb-cone"]), error);
    assert_eq!(
        told(&["--solver", "cone-pgs"]),
        "error: options: --solver: takes none of these problems"
    );
}

#[test]
fn who_claims_nothing_has_no_worst_residual() {
    // 0 on the diagonal of cps-2: a sweep divides by it.
    let named = ["compare-solvers", "cps-2", "--solver", "pgs", "--solver", "lemke"];
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
