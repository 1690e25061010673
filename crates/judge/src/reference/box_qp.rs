//! The LCP as a quadratic program over a box, by clarabel's interior-point method, and Newton's
//! steps from its point.
//!
//! ```text
//! minimize ½ xᵀA x + bᵀx   subject to   lo ≤ x ≤ hi
//! ```
//!
//! For symmetric positive semidefinite A its minimizers are the LCP's solutions; the multipliers of
//! the bounds are the positive and negative parts of w.

use super::Reference;
use super::program::{MAX_ITERATIONS, Program};
use lcplab_lcp::Lcp;

/// Solves the problem as a box QP; `None` if the LCP is not a QP: A is not symmetric, or a row is
/// coupled (freeze the bounds first with [`Lcp::frozen_at`]).
///
/// ```
/// use lcplab_judge::reference::box_qp;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // The minimum of x² − 2x is −1, at x = 1.
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
/// let reference = box_qp(&lcp).expect("A is symmetric");
/// assert!((reference.point[0] - 1.0).abs() < 1e-9 && (reference.objective + 1.0).abs() < 1e-6);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn box_qp(lcp: &Lcp) -> Option<Reference> {
    box_qp_within(lcp, MAX_ITERATIONS)
}

/// [`box_qp`] with a limit on clarabel's iterations.
///
/// ```
/// use lcplab_judge::reference::box_qp_within;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// assert!(box_qp_within(&lcp, 100).unwrap().solved);
/// let early = box_qp_within(&lcp, 1).unwrap();
/// assert!(!early.solved && early.iterations == 1);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn box_qp_within(lcp: &Lcp, max_iterations: usize) -> Option<Reference> {
    Some(program(lcp)?.solve_within(max_iterations).refined(lcp, &[]))
}

/// Clarabel's own point, without Newton's steps, to a tolerance on gap and feasibility; its default
/// is 1e-8.
///
/// ```
/// use lcplab_judge::reference::box_qp_to;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // The minimum of x² − 2x is at x = 1, well inside x ≥ 0.
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
/// let reference = box_qp_to(&lcp, 1e-4).expect("A is symmetric");
/// assert!((reference.point[0] - 1.0).abs() < 1e-2);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn box_qp_to(lcp: &Lcp, tolerance: f64) -> Option<Reference> {
    Some(program(lcp)?.solve_to(tolerance, MAX_ITERATIONS))
}

fn program(lcp: &Lcp) -> Option<Program> {
    if lcp.coupling().is_some() || !lcp.matrix().is_nearly_symmetric() {
        return None;
    }
    let mut program = Program::with_objective(lcp);
    for i in 0..lcp.len() {
        program.bound(i, lcp.lo()[i], lcp.hi()[i]);
    }
    Some(program)
}
