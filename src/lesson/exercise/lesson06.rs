//! Checks of lesson 6, is it solved?

use super::Verdict;

/// The natural residual: 0 exactly on the three segments, and elsewhere the middle one of x − lo, w and
/// x − hi in size.
///
/// # Errors
/// Says at which pair it is wrong.
pub fn residual(answer: fn(f64, f64, f64, f64) -> f64) -> Verdict {
    let infinity = f64::INFINITY;
    for (x, w, lo, hi) in [
        (0.0, 2.0, 0.0, infinity),
        (3.0, 0.0, 0.0, infinity),
        (2.0, -1.0, -2.0, 2.0),
        (0.5, 0.25, 0.0, infinity),
        (0.5, 4.0, 0.0, infinity),
        (1.0, -3.0, -2.0, 2.0),
        (-1.0, 1.0, 0.0, 2.0),
        (5.0, 0.75, -infinity, infinity),
    ] {
        let mut sizes = [x - lo, w, x - hi];
        sizes.sort_by(f64::total_cmp);
        let (got, truth) = (answer(x, w, lo, hi), sizes[1].abs());
        let at = format!("x = {x}, w = {w} on [{lo}, {hi}]: the answer is {got}");
        if truth == 0.0 && got != 0.0 {
            return Err(format!("{at}, but this pair is allowed"));
        }
        if truth != 0.0 && got == 0.0 {
            return Err(format!("{at}, but this pair is not allowed"));
        }
        if !((got - truth).abs() < 1e-12) {
            return Err(format!("{at}; Π(x − w) is not that far from x"));
        }
    }
    Ok(())
}

/// The gap of [2 −1; −1 2] with b = (−1, 3), solved by (½, 0) with the objective −¼: 0 there, and never below
/// the true error.
///
/// # Errors
/// Says at which point it is wrong.
pub fn gap(answer: fn([[f64; 2]; 2], [f64; 2], [f64; 2]) -> f64) -> Verdict {
    let (a, b) = ([[2.0, -1.0], [-1.0, 2.0]], [-1.0, 3.0]);
    let at_solution = answer(a, b, [0.5, 0.0]);
    if at_solution != 0.0 {
        return Err(format!(
            "at the solution (½, 0) the gap must be 0, the answer is {at_solution}"
        ));
    }
    for x in [[1.0, 0.0], [0.5, 0.0], [1.0, 1.0], [2.0, 0.5], [0.75, 0.25]] {
        let quadratic = 2.0 * (x[0] * x[0] - x[0] * x[1] + x[1] * x[1]);
        let objective = 0.5 * quadratic - x[0] + 3.0 * x[1];
        let got = answer(a, b, x);
        let at = format!("A = {a:?}, b = {b:?}, x = {x:?}: the answer is {got}");
        if got < objective + 0.25 - 1e-12 {
            return Err(format!(
                "{at}, but the objective is {} above its least value",
                objective + 0.25
            ));
        }
        if (got - (objective + 0.5 * quadratic)).abs() > 1e-12 {
            return Err(format!("{at}; it is above the error, but not objective minus bound"));
        }
    }
    Ok(())
}

/// A proof of infeasibility: held against problems whose solvability is known by construction, and vectors
/// that miss one condition each.
///
/// # Errors
/// Says which vector was misjudged.
pub fn farkas(answer: fn([[f64; 2]; 2], [f64; 2], [f64; 2]) -> bool) -> Verdict {
    let pressed = [[1.0, -1.0], [-1.0, 1.0]];
    let skewed = [[0.0, -1.0], [1.0, 0.0]];
    for (a, b, d, truth, why) in [
        (pressed, [-1.0, -1.0], [1.0, 1.0], true, "dᵀw = −2 for every x"),
        (pressed, [1.0, -2.0], [1.0, 1.0], true, "dᵀw = −1 for every x"),
        (pressed, [2.0, -1.0], [1.0, 1.0], false, "x = (0, 1) solves the problem"),
        (pressed, [1.0, -1.0], [-1.0, -2.0], false, "x = (0, 1) solves the problem"),
        (
            [[1.0, 0.0], [0.0, 1.0]],
            [-1.0, -1.0],
            [1.0, 1.0],
            false,
            "x = (1, 1) solves the problem",
        ),
        (
            [[1.0, 0.0], [0.0, 1.0]],
            [1.0, 1.0],
            [-1.0, -1.0],
            false,
            "x = (0, 0) solves the problem",
        ),
        (skewed, [-1.0, 2.0], [1.0, 0.0], true, "w₀ = −x₁ − 1 for every x"),
        (skewed, [1.0, -1.0], [0.0, 1.0], false, "x = (1, 1) solves the problem"),
    ] {
        let got = answer(a, b, d);
        if got != truth {
            return Err(format!("A = {a:?}, b = {b:?}, d = {d:?}: the answer is {got}, but {why}"));
        }
    }
    Ok(())
}
