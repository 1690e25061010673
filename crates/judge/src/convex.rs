//! Whether A belongs to a convex program: only then does the duality gap bound the objective's
//! error.

use faer::{Mat, Side};
use lcplab_lcp::Lcp;

/// The number of rows up to which A is factored.
const FACTORED: usize = 300;
/// With a unit diagonal, an eigenvalue that is less than this below zero is rounding.
const ROUNDING: f64 = 1e-10;

/// Whether A is symmetric and positive semidefinite, up to rounding. With more than [`FACTORED`]
/// rows only pairs of rows are examined: a negative 2 × 2 minor shows that A is indefinite.
pub fn is_convex(lcp: &Lcp) -> bool {
    let (a, n) = (lcp.matrix(), lcp.len());
    let root: Vec<f64> = (0..n).map(|i| a.diagonal(i).sqrt()).collect();
    // The root of a negative diagonal entry is not a number and fulfills no inequality.
    let is_bounded = |i: usize| {
        let bound = |j: usize| (1.0 + ROUNDING) * root[i] * root[j];
        root[i] >= 0.0 && a.row(i).iter().all(|(j, entry)| entry.abs() <= bound(j))
    };
    if !a.is_nearly_symmetric() || !(0..n).all(is_bounded) {
        return false;
    }
    let unit = |i: usize, j: usize| match root[i] * root[j] {
        0.0 => 0.0,
        size => a.entry(i, j) / size,
    };
    let shifted = |i, j| if i == j { 1.0 + n as f64 * ROUNDING } else { unit(i, j) };
    n > FACTORED || Mat::from_fn(n, n, shifted).llt(Side::Lower).is_ok()
}
