//! What a solve leaves to the next one.

use std::cell::RefCell;

use super::pivot::active_set::ActiveSet;
use super::pivot::free_rows::FreeRows;

/// The last active set, and the factor of its free rows: what a solve leaves to the next one of a
/// similar problem.
///
/// The caller holds it and passes it with each [`Start`](super::Start); empty at first. Principal
/// pivoting begins with the set and goes on from there, and leaves its own last one. The other
/// methods have no use for it.
///
/// [`BlockPivoting`](super::BlockPivoting) uses the factor only while the free rows and the matrix
/// are the same: *the same matrix*, not an equal one, that is one which the problems share, as
/// [`Lcp::with_b`](lcplab_problem::Lcp::with_b) makes them. A matrix never changes, and this one is
/// held here, so that no other one can take its place.
///
/// ```
/// use lcplab_problem::{Lcp, Matrix};
/// use lcplab_solver::{BlockPivoting, Solver, Start, Warm};
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let (solver, warm) = (BlockPivoting::default(), Warm::default());
/// let start = Start { warm: Some(&warm), ..Start::default() };
/// assert_eq!(solver.solve(&lcp, &start, &mut ()).iterations, 1);
/// let next = lcp.with_b(vec![-1.25, 2.0])?;
/// let solution = solver.solve(&next, &start, &mut ());
/// assert!((solution.x[0] - 0.625).abs() < 1e-15 && solution.iterations == 0);
/// # Ok::<(), lcplab_problem::error::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct Warm(RefCell<Left>);

/// What was left.
#[derive(Debug, Default)]
pub(super) struct Left {
    pub(super) set: Option<ActiveSet>,
    pub(super) equations: Option<FreeRows>,
}

impl Warm {
    /// Lends what was left to a solve, and keeps what that leaves.
    pub(super) fn lend<T>(&self, solve: impl FnOnce(&mut Left) -> T) -> T {
        let mut left = self.0.take();
        let solution = solve(&mut left);
        self.0.replace(left);
        solution
    }
}
