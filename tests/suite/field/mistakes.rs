//! Wrong answers, and the mistake that gives them.

use super::*;

/// What `diagnose` says about an answer to a problem.
fn diagnosed(problem: &str, x: &[f64]) -> String {
    let folder = Folder::new();
    let answer = folder.file("x.json", &format!("{{\"x\": {x:?}}}"));
    out(&run_with(problem, &["diagnose", "-", &answer]))
}

fn three_contacts(b: &[f64]) -> String {
    problem(&[&[2.0, 1.0, 0.0], &[1.0, 2.0, 1.0], &[0.0, 1.0, 2.0]], b, "")
}

/// Ten sweeps by hand, each change clamped at 0 instead of the sum: (1, 1, 0) after the first, and
/// no change is positive any more.
#[test]
fn clamped_increments_are_among_the_mistakes_that_fit() {
    let found = diagnosed(&three_contacts(&[-2.0, -3.0, -1.0]), &[1.0, 1.0, 0.0]);
    assert!(found.contains("Gauss-Seidel with clamped increments"), "{found}");
}

/// A x = −b has the solution (3.375, −5.75, 4.125), by elimination; then one clamp.
#[test]
fn one_clamp_at_the_end_is_named() {
    let found = diagnosed(&three_contacts(&[-1.0, 4.0, -2.5]), &[3.375, 0.0, 4.125]);
    assert!(found.contains("without bounds, clamped at the end"), "{found}");
}

/// Slides at x_n = 1, |x_t| = ½ opposite to w_t = A_t x_t + b_t. With w_t = −s x_t, the sum of
/// squares of (A_t + s)⁻¹ (2, 1.5) is ¼ at the s that bisection finds.
#[test]
fn the_answer_of_a_cone_to_a_box_is_named() {
    let tangent = |s: f64| {
        let (p, q, r) = (2.0 + s, 0.5, 1.0 + s);
        let determinant = p * r - q * q;
        [(2.0 * r - 1.5 * q) / determinant, (1.5 * p - 2.0 * q) / determinant]
    };
    let (mut least, mut most) = (0.0, 100.0);
    for _ in 0..100 {
        let middle = 0.5 * (least + most);
        let [x, y] = tangent(middle);
        if x.hypot(y) > 0.5 { least = middle } else { most = middle }
    }
    let [x, y] = tangent(least);
    let sliding = problem(
        &[&[1.0, 0.0, 0.0], &[0.0, 2.0, 0.5], &[0.0, 0.5, 1.0]],
        &[-1.0, -2.0, -1.5],
        r#""friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5]"#,
    );
    let found = diagnosed(&sliding, &[1.0, x, y]);
    assert!(found.contains("under the model coulomb-cone"), "{found}");
}
