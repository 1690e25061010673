//! What solvers do: inequalities, pivoting, elimination.

use nalgebra::{DMatrix, Matrix2};

use super::common::{answer, contacts, equations, last, sweeps, tridiagonal};
use super::{Finding, Measure};
use crate::error::Result;
use crate::lcp::{Lcp, library};
use crate::solver::{Jacobi, Lemke, Murty, Pgs, Solver, Start};

const ROWS: usize = 10;
const BODIES: usize = 60;
const RODS: usize = 50;

/// E08: pivoting called recursive, and wrong for many constraints.
///
/// The worst case of the least-index rule, and a column of sixty bodies.
pub(super) fn pivoting() -> Result<Finding> {
    let exchanges =
        Murty::default().solve(&problem("murty", ROWS)?, &Start::default(), &mut ()).iterations;
    let column = problem("stack", BODIES)?;
    let swept = last(sweeps(Pgs::NAME, &column, &[0.0; BODIES], 1000)?);
    let pivoted = answer(Lemke::NAME, &column)?;
    let count = Measure::new("exchanges, n = 10", "", ROWS as f64, exchanges as f64);
    let floor = Measure::new("floor's impulse", "N s", swept[0], pivoted[0]);
    Ok(Finding::new(
        "Murty's matrix, 1 on the diagonal and 2 above it, w = A x + b with b = −1: the least-index rule \
         visits every active set. Printed is a recursion that settles a row with each smaller instance. \
         Then a column of 60 bodies of 1 kg that all fall at 1 m/s, b = (−1, 0, …, 0): the floor's impulse \
         must stop them all. Printed is the method that the chapter takes for the more reliable one, with \
         1000 sweeps; corrected is Lemke's pivoting.",
    )
    .measure(count.truth(&[2_f64.powi(ROWS as i32) - 1.0], "2ⁿ − 1", 0.0))
    .measure(floor.truth(&[BODIES as f64], "momentum", 1e-9))
    .judged("column of 60: sweeps and pivots", &column, &swept, &pivoted))
}

fn problem(family: &str, n: usize) -> Result<Lcp> {
    Ok(library::by_name(family)?.generate(&[("n", n as f64)])?.lcp)
}

/// E09: contacts called equalities, and Jacobi's method taken to converge like Gauss-Seidel.
///
/// A contact that opens, and a matrix on which Jacobi's method overshoots.
pub(super) fn equality_contacts() -> Result<Finding> {
    let speed = 1.0;
    let v_next = |x: Vec<f64>| speed + x[0];
    let glued = v_next(answer(Pgs::NAME, &equations(&[1.0], &[speed])?)?);
    let free = v_next(answer(Pgs::NAME, &contacts(&[1.0], &[speed])?)?);
    let shared = equations(&[1.0, 0.9, 0.9, 0.9, 1.0, 0.9, 0.9, 0.9, 1.0], &[-2.8; 3])?;
    let first = |solver: &str, count: usize| -> Result<f64> {
        Ok(last(sweeps(solver, &shared, &[0.0; 3], count)?)[0])
    };
    let velocity = Measure::new("velocity of an open contact", "m/s", glued, free);
    let x =
        Measure::new("x₁ after the sweeps", "", first(Jacobi::NAME, 30)?, first(Pgs::NAME, 200)?);
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

/// E11: solving described as inverting.
///
/// A chain's matrix and its inverse; a division from both sides.
pub(super) fn no_inverse() -> Result<Finding> {
    let a = tridiagonal(RODS, 2.0);
    let inverse = a.to_dense().try_inverse().unwrap_or_else(|| DMatrix::zeros(0, 0));
    let felt = inverse.iter().filter(|entry| entry.abs() > 1e-9).count();
    let (left, right) = (Matrix2::new(1.0, 1.0, 0.0, 1.0), Matrix2::new(1.0, 0.0, 1.0, 1.0));
    let inverted = Matrix2::new(1.0, -1.0, 0.0, 1.0);
    let by_rows = |x: Matrix2<f64>| [x.m11, x.m12, x.m21, x.m22];
    let solved = left.lu().solve(&right).unwrap_or_else(Matrix2::zeros);
    let entries = Measure::new("entries, n = 50", "", felt as f64, a.pattern().len() as f64);
    let quotient = Measure::new("X by rows", "", by_rows(right * inverted), by_rows(solved));
    Ok(Finding::new(
        "The matrix of a chain of 50 rods, tridiag(−1, 2, −1): how many entries other than 0 does the solver \
         work with, and how many has the inverse? Then A X = B with A = [1 1; 0 1] and B = [1 0; 1 1]: \
         printed is B A⁻¹, corrected the X found by elimination.",
    )
    .measure(entries.truth(&[(3 * RODS - 2) as f64], "3n − 2", 0.0))
    .measure(quotient.truth(&[0.0, -1.0, 1.0, 1.0], "by hand", 1e-15)))
}
