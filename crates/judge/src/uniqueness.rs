//! Checks whether x is the only solution.
//!
//! If A is symmetric positive semidefinite, w is the same for all solutions. x is unique if A_FF is
//! regular; F are the rows strictly between their bounds. A null vector of A_FF is a direction in
//! which x can change without changing the motion: redundant contacts can share a load in many
//! ways.

use faer::{Mat, Side};

use lcplab_lcp::Lcp;

/// An eigenvalue below this fraction of the largest counts as zero.
const RELATIVE_ZERO: f64 = 1e-11;

/// The number of rows strictly between their bounds at x, and the numerical rank of A there.
///
/// A is first scaled to a unit diagonal, so that units and masses do not affect the decision.
///
/// ```
/// use lcplab_judge::uniqueness::free_rank;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // Two contacts share a load of 1: only the sum of x is determined.
/// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// assert_eq!(free_rank(&lcp, &[0.25, 0.75]), (2, 1));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn free_rank(lcp: &Lcp, x: &[f64]) -> (usize, usize) {
    let free: Vec<usize> = (0..lcp.len())
        .filter(|&i| {
            let (lo, hi) = lcp.bounds(i, x);
            lo < x[i] && x[i] < hi
        })
        .collect();
    let scale = |i: usize| match lcp.matrix().diagonal(i).sqrt() {
        root if root > 0.0 => root,
        _ => 1.0,
    };
    let a = Mat::from_fn(free.len(), free.len(), |r, c| {
        lcp.matrix().entry(free[r], free[c]) / (scale(free[r]) * scale(free[c]))
    });
    let Ok(eigenvalues) = a.self_adjoint_eigenvalues(Side::Lower) else { return (free.len(), 0) };
    let largest = eigenvalues.iter().copied().fold(0.0, f64::max);
    let rank = eigenvalues.iter().filter(|&&value| value > RELATIVE_ZERO * largest).count();
    (free.len(), rank)
}
