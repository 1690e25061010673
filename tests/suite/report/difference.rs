//! What changed between two results files.

use lcplab::report::difference::{Tolerance, between, table};
use serde_json::json;

fn places(old: &serde_json::Value, new: &serde_json::Value, tolerance: f64) -> Vec<String> {
    between(old, new, relative(tolerance)).into_iter().map(|change| change.place).collect()
}

fn relative(relative: f64) -> Tolerance {
    Tolerance { relative, absolute: 0.0 }
}

#[test]
fn a_row_is_found_by_its_name_wherever_it_stands() {
    let old = json!({"runs": [{"scene": "fig6", "steps": 3}, {"scene": "fig7", "steps": 5}]});
    let new = json!({"runs": [
        {"scene": "new", "steps": 1}, {"scene": "fig6", "steps": 3}, {"scene": "fig7", "steps": 6},
    ]});
    assert_eq!(places(&old, &new, 0.0), ["runs › fig7 › steps", "runs › new"]);
}

#[test]
fn circumstances_are_no_difference() {
    let old = json!({"machine": {"seconds": 3}, "version": "1", "x": 1});
    let new = json!({"machine": {"seconds": 4}, "version": "2", "x": 1});
    assert!(between(&old, &new, relative(0.0)).is_empty());
}

#[test]
fn a_tolerance_lets_the_last_bits_pass_and_nothing_else() {
    let old = json!({"x": 1.0, "y": 0.0, "verdict": "proved"});
    let new = json!({"x": 1.0 + 1e-12, "y": 1e-300, "verdict": "not_a_solution"});
    // The relative change of 1 + 1e-12 is 1e-12; from 0 to anything it is 1.
    assert_eq!(places(&old, &new, 1e-9), ["y", "verdict"]);
    assert_eq!(places(&old, &new, 0.0), ["x", "y", "verdict"]);
}

#[test]
fn what_has_gone_and_what_has_come_is_said() {
    let changes = between(&json!({"a": 1}), &json!({"b": [1, 2]}), relative(0.0));
    let rows: Vec<Vec<String>> = table(&changes)
        .rows
        .into_iter()
        .map(|row| row.into_iter().map(|cell| cell.text).collect())
        .collect();
    assert_eq!(rows, [["a", "1", "–", "1"], ["b", "–", "2 entries", "1"]]);
}

#[test]
fn an_absolute_tolerance_lets_residuals_near_rounding_pass() {
    let (old, new) = (json!({"residual": 1e-17}), json!({"residual": 4e-17}));
    assert!(between(&old, &new, Tolerance { relative: 0.0, absolute: 1e-9 }).is_empty());
    assert_eq!(between(&old, &new, relative(1e-6)).len(), 1);
}
