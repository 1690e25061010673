//! The warm-start cache.

use std::cell::RefCell;

use super::pivot::active_set::ActiveSet;
use super::pivot::free_rows::FreeRows;

/// The warm-start cache: the last active set and the factor of its free rows, for the next solve of
/// a similar problem.
///
/// The caller keeps it and passes it with each [`Start`](super::Start); it is empty at first.
/// Principal pivoting starts from the cached set and stores its final set. The other methods do not
/// use it.
///
/// [`BlockPivoting`](super::BlockPivoting) reuses the factor only if the free rows and the matrix
/// are unchanged. The matrix must be *the same object*, shared between the problems as by
/// [`Lcp::with_b`](lcplab_lcp::Lcp::with_b), not just an equal one. Matrices are immutable, and
/// the cache keeps a reference to this one, so no other matrix can be mistaken for it.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{BlockPivoting, Solver, Start, Warm};
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let (solver, warm) = (BlockPivoting::default(), Warm::default());
/// let start = Start { warm: Some(&warm), ..Start::default() };
/// assert!((solver.solve(&lcp, &start, &mut ()).x[0] - 0.5).abs() < 1e-15);
/// let next = lcp.with_b(vec![-1.25, 2.0])?;
/// let solution = solver.solve(&next, &start, &mut ());
/// assert!((solution.x[0] - 0.625).abs() < 1e-15 && solution.iterations == 0);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct Warm(RefCell<Cache>);

/// The contents of the cache.
#[derive(Debug, Default)]
pub(super) struct Cache {
    pub(super) set: Option<ActiveSet>,
    pub(super) equations: Option<FreeRows>,
}

impl Warm {
    /// Passes the contents to a solve, and keeps what it stores.
    pub(super) fn borrow<T>(&self, solve: impl FnOnce(&mut Cache) -> T) -> T {
        let mut cache = self.0.take();
        let solution = solve(&mut cache);
        self.0.replace(cache);
        solution
    }
}
