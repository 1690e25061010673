//! The convex cone problem of friction as a second-order cone program, by clarabel, and Newton's
//! steps from its point.
//!
//! ```text
//! minimize ½ xᵀA x + bᵀx   subject to   |x_t| ≤ μ x_n for each contact,   lo ≤ x ≤ hi elsewhere
//! ```
//!
//! This is model 4a. The multipliers of the cones are the w in their dual cones.

use super::Reference;
use super::program::{MAX_ITERATIONS, Program};
use lcplab_lcp::Complementarity;
use lcplab_lcp::friction::ConeProblem;

/// Solves the cone program; `None` if the problem is not convex: A is not symmetric, or the law is
/// Coulomb's (freeze the shift first with [`ConeProblem`]'s
/// [`frozen_at`](lcplab_lcp::Complementarity::frozen_at)).
///
/// ```
/// use lcplab_judge::reference::cone_qp;
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // With A = 1, x is the point of the cone |x_t| ≤ x_n / 2 that is nearest to (2, 3, 0).
/// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let reference = cone_qp(&ConeProblem::new(problem, Law::Associated)).expect("convex");
/// for (x, expected) in reference.point.iter().zip([2.8, 1.4, 0.0]) {
///     assert!((x - expected).abs() < 1e-7);
/// }
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn cone_qp(problem: &ConeProblem) -> Option<Reference> {
    cone_qp_within(problem, MAX_ITERATIONS)
}

/// [`cone_qp`] with a limit on clarabel's iterations.
///
/// ```
/// use lcplab_judge::reference::cone_qp_within;
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let problem = ConeProblem::new(problem, Law::Associated);
/// assert!(cone_qp_within(&problem, 100).unwrap().solved);
/// assert!(!cone_qp_within(&problem, 1).unwrap().solved);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn cone_qp_within(problem: &ConeProblem, max_iterations: usize) -> Option<Reference> {
    let (lcp, friction) = (problem.lcp(), problem.friction());
    if !problem.is_frozen() || !lcp.matrix().is_nearly_symmetric() {
        return None;
    }
    let mut program = Program::with_objective(lcp);
    for &i in friction.others() {
        program.bound(i, lcp.lo()[i], lcp.hi()[i]);
    }
    for contact in friction.contacts() {
        let [n, t1, t2] = contact.rows;
        if contact.mu > 0.0 {
            program.within_cone(contact.mu, contact.rows);
        } else {
            program.bound(n, 0.0, f64::INFINITY);
            program.bound(t1, 0.0, 0.0);
            program.bound(t2, 0.0, 0.0);
        }
    }
    Some(program.solve_within(max_iterations).refined(problem, friction.contacts()))
}
