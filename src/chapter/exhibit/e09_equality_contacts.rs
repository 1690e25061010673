//! E09: contacts called equalities, and Jacobi's method taken to converge like Gauss-Seidel.

use super::common::{answer, contacts, equations, last, sweeps};
use super::{Finding, Measure};
use crate::error::Result;

/// A contact that opens, and a matrix on which Jacobi's method overshoots.
pub(super) fn example() -> Result<Finding> {
    let speed = 1.0;
    let v_next = |x: Vec<f64>| speed + x[0];
    let glued = v_next(answer("pgs", &equations(&[1.0], &[speed])?)?);
    let free = v_next(answer("pgs", &contacts(&[1.0], &[speed])?)?);
    let shared = equations(&[1.0, 0.9, 0.9, 0.9, 1.0, 0.9, 0.9, 0.9, 1.0], &[-2.8; 3])?;
    let first = |solver: &str, count: usize| -> Result<f64> {
        Ok(last(sweeps(solver, &shared, &[0.0; 3], count)?)[0])
    };
    let velocity = Measure::new("velocity of an open contact", "m/s", glued, free);
    let x = Measure::new("x₁ after the sweeps", "", first("jacobi", 30)?, first("pgs", 200)?);
    Ok(Finding::new(
        "A body of 1 kg leaves the floor at 1 m/s: w = x + 1 (A = 1, b = 1 in this \
         library's sign, −1 in the chapter's). As an equation, then as an inequality. Second, A with 1 on the diagonal and 0.9 elsewhere, three rows, b = −2.8: A is positive \
         definite (eigenvalues 0.1, 0.1, 2.8) and x = (1, 1, 1). Printed is x₁ after 30 sweeps of \
         Jacobi's method, each of which multiplies the error by −1.8; corrected, after 200 of Gauss-Seidel, \
         which in the long run multiply it by 0.854.",
    )
    .measure(velocity.truth(&[speed], "no force acts", 1e-12))
    .measure(x.truth(&[1.0], "by hand", 1e-9)))
}
