//! Guesses a vector that proves that a problem has no solution, by clarabel's interior-point
//! method.
//!
//! ```text
//! minimize  bᵀd + hiᵀp − loᵀq   subject to   Aᵀd = p − q,   p, q ≥ 0,   |d_i| ≤ 1/√s_i
//! ```
//!
//! d_i ≥ 0 if lo_i is finite, d_i ≤ 0 if hi_i is, p_j = 0 if hi_j = ∞, q_j = 0 if lo_j = −∞; d, p
//! and q are 0 in a coupled row. A negative optimum is a Farkas proof, up to rounding. Rows are in
//! units in which a_ii is about 1.

use super::program::{MAX_ITERATIONS, Program};
use crate::residual::Rows;
use lcplab_lcp::Lcp;

/// d, if the optimum appears to be negative.
///
/// ```
/// use lcplab_judge::reference::farkas;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = −1 for every x.
/// let lcp = Lcp::new(Matrix::from([[0.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// assert!(farkas(&lcp).is_some_and(|d| d[0] > 0.0));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn farkas(lcp: &Lcp) -> Option<Vec<f64>> {
    let n = lcp.len();
    if n == 0 {
        // clarabel does not accept an empty program.
        return None;
    }
    let zero = vec![0.0; n];
    let unit: Vec<f64> =
        Rows::at(lcp, &zero).rows.iter().map(|row| row.scale.sqrt().value()).collect();
    let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); n];
    let mut program = Program::with_costs((0..n).map(|i| lcp.b()[i] / unit[i]).collect());
    for i in 0..n {
        for (j, a) in lcp.matrix().row(i).iter().filter(|&(_, a)| a != 0.0) {
            columns[j].push((i, a / unit[i] / unit[j]));
        }
        let (lo, hi) = match lcp.is_coupled(i) {
            // d_i = 0
            true => (0.0, 0.0),
            false => (lcp.lo()[i], lcp.hi()[i]),
        };
        let least = if lo.is_finite() { 0.0 } else { -1.0 };
        program.bound(i, least, if hi.is_finite() { 0.0 } else { 1.0 });
    }
    for (j, mut column) in columns.into_iter().enumerate() {
        for (bound, sign) in [(lcp.hi()[j], 1.0), (lcp.lo()[j], -1.0)] {
            if bound.is_finite() && !lcp.is_coupled(j) {
                let part = program.add_variable(sign * bound * unit[j]);
                program.bound(part, 0.0, f64::INFINITY);
                column.push((part, -sign));
            }
        }
        program.equate(column, 0.0);
    }
    if !program.is_finite() {
        // In these units, some number is too large.
        return None;
    }
    let found = program.solve_within(MAX_ITERATIONS);
    let is_proof = found.solved && found.objective < 0.0;
    is_proof.then(|| (0..n).map(|i| found.point[i] / unit[i]).collect())
}
