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
