//! The LCP of A = Ĵ Ĵᵀ as a quadratic program in velocities and impulses, by clarabel's
//! interior-point method.
//!
//! ```text
//! minimize ½ |v|² + bᵀx   subject to   v = Ĵᵀ x,   lo ≤ x ≤ hi
//! ```
//!
//! This is the program of [`box_qp`](super::box_qp()) with A in factors: for a pile it has a few
//! more unknowns and far fewer entries.

use super::Reference;
use super::program::{MAX_ITERATIONS, Program};
use lcplab_lcp::Lcp;

/// Solves the problem with b and the bounds of the LCP and these entries (row, column, value) of Ĵ,
/// to a tolerance on gap and feasibility; `None` if a row is coupled (freeze the bounds first with
/// [`Lcp::frozen_at`]).
///
/// ```
/// use lcplab_judge::reference::velocity_qp_to;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // A = 2 is Ĵ Ĵᵀ with Ĵ = (1, 1).
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
/// let entries = [(0, 0, 1.0), (0, 1, 1.0)];
/// let reference = velocity_qp_to(&lcp, &entries, 2, 1e-9).expect("no row is coupled");
/// assert!((reference.point[0] - 1.0).abs() < 1e-6);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Panics
/// If an entry lies outside the rows or `velocities` columns.
pub fn velocity_qp_to(
    lcp: &Lcp,
    jacobian: &[(usize, usize, f64)],
    velocities: usize,
    tolerance: f64,
) -> Option<Reference> {
    if lcp.coupling().is_some() {
        return None;
    }
    let n = lcp.len();
    let mut program = Program::with_costs([lcp.b(), &vec![0.0; velocities]].concat());
    let mut equations: Vec<Vec<(usize, f64)>> =
        (n..n + velocities).map(|v| vec![(v, 1.0)]).collect();
    for &(i, column, value) in jacobian {
        equations[column].push((i, -value));
    }
    for (k, equation) in equations.into_iter().enumerate() {
        program.quadratic.push((n + k, n + k, 1.0));
        program.equate(equation, 0.0);
    }
    for i in 0..n {
        program.bound(i, lcp.lo()[i], lcp.hi()[i]);
    }
    let mut reference = program.solve_to(tolerance, MAX_ITERATIONS);
    reference.point.truncate(n);
    Some(reference)
}
