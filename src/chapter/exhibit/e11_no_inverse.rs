//! E11: solving described as inverting.

use nalgebra::{DMatrix, Matrix2};

use super::common::tridiagonal;
use super::{Finding, Measure};
use crate::error::Result;

const RODS: usize = 50;

/// A chain's matrix and its inverse; a division from both sides.
pub(super) fn example() -> Result<Finding> {
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
