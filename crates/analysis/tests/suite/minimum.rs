use lcplab_analysis::minimum::Descent;
use lcplab_lcp::Question;
use lcplab_lcp::file::Problem;
use proptest::prelude::*;
use serde_json::json;

use lcplab_testing::cases;

/// The program over a box, or with the given rows.
fn program(mut file: serde_json::Value) -> Question {
    file["objective"] = true.into();
    let problem = Problem::parse(&file.to_string(), "p.json").unwrap();
    Question::new(&problem, None, "p.json").unwrap()
}

fn over_box(p: [[f64; 2]; 2], lo: f64, hi: f64) -> Question {
    program(json!({ "A": { "dense": p }, "b": [0, 0], "lo": [lo, lo], "hi": [hi, hi] }))
}

#[test]
fn a_saddle_is_no_minimum_and_its_minima_are_not_accused() {
    let question = over_box([[1.0, 3.0], [3.0, 1.0]], -1.0, 1.0);
    let found = Descent::of(&question, &[0.0, 0.0]).unwrap();
    // (x, −x): x² − 3 x² = −2 x².
    assert!((found.curvature + 4.0).abs() < 1e-12, "{found:?}");
    for minimum in [[1.0, -1.0], [-1.0, 1.0]] {
        assert_eq!(Descent::of(&question, &minimum), None);
    }
    let text = Descent::text(&question, &[0.0, 0.0]);
    assert!(text.contains("no minimum: x satisfies the optimality conditions"), "{text}");
    assert_eq!(Descent::json(&question, &[0.0, 0.0]).unwrap().1["is_minimum"], false);
}

#[test]
fn at_a_corner_only_directions_into_the_box_count() {
    // x y has a minimum on the quadrant, −x y has not.
    let up = over_box([[0.0, 1.0], [1.0, 0.0]], 0.0, 9.0);
    assert_eq!(Descent::of(&up, &[0.0, 0.0]), None);
    let down = over_box([[0.0, -1.0], [-1.0, 0.0]], 0.0, 9.0);
    let found = Descent::of(&down, &[0.0, 0.0]).unwrap();
    assert!(found.direction.iter().all(|d| (d - 1.0).abs() < 1e-9), "{found:?}");
}

#[test]
fn constraints_bar_directions() {
    // x² − y² has a minimum at 0 on the line y = 0, and a saddle on the line x = 0.
    let on = |a: [f64; 2]| {
        let rows = [[2.0, 0.0, -a[0]], [0.0, -2.0, -a[1]], [a[0], a[1], 0.0]];
        let kinds = ["column", "column", "multiplier"].map(|kind| json!({ "kind": kind }));
        let inf = ["inf"; 3];
        program(
            json!({ "A": { "dense": rows }, "b": [0, 0, 0], "lo": ["-inf", "-inf", "-inf"], "hi": inf, "rows": kinds }),
        )
    };
    assert_eq!(Descent::of(&on([0.0, 1.0]), &[0.0; 3]), None);
    let found = Descent::of(&on([1.0, 0.0]), &[0.0; 3]).unwrap();
    assert!(found.direction[0].abs() < 1e-9 && (found.curvature + 2.0).abs() < 1e-9, "{found:?}");
}

/// x² − y² has a strict minimum on the edge y = 1 of y ≤ 1, where the multiplier is 2, and on the
/// bound y ≤ 1. Neither the units of the objective or of the variables nor an error as large as the
/// tolerance make it something else; with the multiplier 0, at y = 0, it is a saddle in all units.
#[test]
fn units_and_small_errors_accuse_no_minimum() {
    let kinds = ["column", "column", "multiplier"].map(|kind| json!({ "kind": kind }));
    for units in [1e-12, 1e-6, 1.0, 1e6, 1e12] {
        for length in [1e-9, 1.0, 1e9] {
            // w of the rows: 2 x, −2 y + z, and 1 − y, times their units.
            let a = [[2.0 * units, 0.0, 0.0], [0.0, -2.0 * units, 1.0], [0.0, -1.0, 0.0]];
            let file = json!({
                "A": { "dense": a }, "b": [0.0, 0.0, length], "lo": ["-inf", "-inf", 0],
                "hi": ["inf", "inf", "inf"], "rows": kinds,
            });
            let bounded = json!({
                "A": { "dense": [[2.0 * units, 0.0], [0.0, -2.0 * units]] }, "b": [0, 0],
                "lo": [-length, -length], "hi": [length, length],
            });
            for off in [0.0, 1e-9, -1e-9] {
                let y = length * (1.0 + off);
                let x = [0.0, y, 2.0 * units * y];
                assert_eq!(Descent::of(&program(file.clone()), &x), None, "{units} {length} {off}");
                let x = [0.0, length * (1.0 - f64::abs(off))];
                assert_eq!(
                    Descent::of(&program(bounded.clone()), &x),
                    None,
                    "{units} {length} {off}"
                );
            }
            assert!(Descent::of(&program(bounded), &[0.0, 0.0]).is_some(), "{units} {length}");
        }
    }
}

#[test]
fn a_problem_without_an_objective_has_no_minimum_to_miss() {
    let file =
        json!({ "A": { "dense": [[1, 3], [3, 1]] }, "b": [0, 0], "lo": [-1, -1], "hi": [1, 1] });
    let problem = Problem::parse(&file.to_string(), "p.json").unwrap();
    let question = Question::new(&problem, None, "p.json").unwrap();
    assert_eq!(Descent::of(&question, &[0.0, 0.0]), None);
}

proptest! {
    #![proptest_config(cases(256))]

    /// At 0, where w = 0, a found direction is a descent, and a minimum by its definition has none.
    #[test]
    fn what_is_found_is_lower(
        entries in proptest::array::uniform6(-3i32..=3),
        corner in proptest::array::uniform3(any::<bool>()),
    ) {
        let [a, b, c, d, e, f] = entries.map(f64::from);
        let p = [[a, b, c], [b, d, e], [c, e, f]];
        let lo = corner.map(|is_corner| if is_corner { 0.0 } else { -1.0 });
        let question = program(json!({
            "A": { "dense": p }, "b": [0, 0, 0], "lo": lo, "hi": [1, 1, 1],
        }));
        let value = |x: &[f64]| -> f64 {
            (0..9).map(|k| 0.5 * p[k / 3][k % 3] * x[k / 3] * x[k % 3]).sum()
        };
        // Directions of small integers: enough to see most descents of small integers.
        let grid = (0..343).map(|k| [k / 49 - 3, k / 7 % 7 - 3, k % 7 - 3].map(f64::from));
        let inside = |d: &[f64]| d.iter().zip(lo).all(|(d, lo)| lo < 0.0 || *d >= -1e-12);
        match Descent::of(&question, &[0.0; 3]) {
            Some(found) => {
                prop_assert!(inside(&found.direction) && value(&found.direction) < 0.0, "{found:?}");
            }
            None => {
                let lower = grid.clone().find(|d| inside(d) && value(d) < -1e-9);
                prop_assert_eq!(lower, None);
            }
        }
    }
}
