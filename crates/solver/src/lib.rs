//! Methods that solve an LCP, one per file, all with one trait.
//!
//! A solver sees only numbers, no bodies or contacts. It reports its own view of the answer as a
//! [`Status`]; the crate `lcplab-judge` decides whether the answer is a solution. Methods for
//! circular friction cones have their own trait, [`ConeSolver`].
//!
//! # Four groups, one page per method
//!
//! | group | methods | an iteration |
//! | --- | --- | --- |
//! | [`sweep`] | PGS, SOR, SSOR, colors, Jacobi, blocks | each row in turn, clamped |
//! | [`gradient`] | APGD, spectral, MPRGP, NNCG, ADMM | products with A |
//! | [`newton`] | Newton on two kinds of equations, interior point | a linear system |
//! | [`pivot`] | Dantzig, Lemke, Murty, blocks, enumeration | a row changes its bound |
//!
//! [`theory`] predicts how fast they converge, [`trace`] records what they do.
//!
//! [`textbook`] has short versions of the same methods for students.
//!
//! If no solver is named, a [fallback sequence](solve_by_sequence) of methods is used.
//!
//! Friction rows whose bounds depend on another row are handled within the sweep, or by [`frozen`]
//! bounds.

mod class;
mod cone;
mod entry;
pub mod frozen;
pub mod gradient;
mod iterate;
// Fast loops and factorizations. They are no promise: public for the time stepping, the matrix
// storage formats, the benchmarks and the tests of lcplab, which are other crates.
#[doc(hidden)]
pub mod kernel;
#[doc(hidden)]
pub mod linalg;
mod method;
mod metric;
pub mod newton;
mod observer;
mod options;
pub mod pivot;
mod registry;
mod sequence;
mod settings;
mod solution;
mod stop;
pub mod sweep;
pub mod textbook;
pub mod theory;
mod tolerances;
pub mod trace;
mod warm;

pub use class::{Class, MatrixClass};
pub use cone::{ConeEntry, ConeSolver};
pub use entry::{Entry, Group};
pub use gradient::{Admm, AndersonPgs, Apgd, Mprgp, Nncg, Spectral};
pub use lcplab_lcp::exact::all_solutions;
pub use method::{Method, solve_polyhedral, why_none_takes};
pub use newton::{ConeNewton, Equations, InteriorPoint, Newton};
pub use observer::{
    Centering, Event, Iterate, Leaving, Move, Observer, RowUpdate, StepDetail, Tableau,
};
pub use options::{Choice, Options};
pub use pivot::{BlockPivoting, Dantzig, Enumeration, Lemke, Murty, Side, Variable};
pub use registry::{Registry, default_for};
pub use sequence::{
    Attempt, SequenceAnswer, is_semidefinite, solve as solve_by_sequence,
    solve_boxed as solve_boxed_by_sequence, solve_boxed_without, solve_lcp as solve,
};
pub use settings::Settings;
pub use solution::{Fallback, Solution, Status};
pub use stop::{Reason, Stop, StopObserver};
pub use sweep::{BlockPgs, Code6, ConePgs, Damping, Jacobi, KNOWN_WRONG, Order, Pgs, PolygonPgs};
pub use trace::{Cost, Effort};
pub use warm::Warm;

use lcplab_lcp::{Complementarity, Lcp};

/// A method that solves boxed LCPs.
pub trait Solver: Send + Sync {
    /// The name in the registry, on the command line and in tables.
    fn name(&self) -> &str;

    /// Solves the problem from a start and reports each iterate to the observer.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    /// use lcplab_solver::{Pgs, Settings, Solver, Start};
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// let pgs = Pgs { settings: Settings::default().with_max_iterations(3), ..Pgs::default() };
    /// let solution = pgs.solve(&lcp, &Start::at(&[1.0, 1.0]), &mut ()); // () observes nothing
    /// assert_eq!(solution.to_string(), "solved after 2 iterations: x = (0.5, 0)");
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution;
}

/// Where a solver starts.
#[derive(Debug, Clone, Copy, Default)]
pub struct Start<'a> {
    /// An initial guess of x (n entries), for example the impulses of the last time step; `None`
    /// means 0.
    pub x: Option<&'a [f64]>,
    /// The warm-start cache from a similar problem, for methods that start from an active set.
    pub warm: Option<&'a Warm>,
}

impl<'a> Start<'a> {
    /// A start from an initial guess.
    pub fn at(x: &'a [f64]) -> Self {
        Start { x: Some(x), warm: None }
    }

    /// Passes the warm-start cache to this solve, which updates it.
    fn with_cache<T>(&self, solve: impl FnOnce(&mut warm::Cache) -> T) -> T {
        match self.warm {
            Some(warm) => warm.borrow(solve),
            None => solve(&mut warm::Cache::default()),
        }
    }

    /// The starting point: the guess or 0, projected onto the bounds or cones.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    /// use lcplab_solver::Start;
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// assert_eq!(Start::at(&[3.0, -1.0]).point(&lcp), [3.0, 0.0]); // x ≥ 0
    /// assert_eq!(Start::default().point(&lcp), [0.0, 0.0]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn point(&self, problem: &impl Complementarity) -> Vec<f64> {
        let n = problem.lcp().len();
        let mut x = self.x.map_or_else(|| vec![0.0; n], <[f64]>::to_vec);
        assert_eq!(x.len(), n, "a start needs one entry per row");
        problem.project_all(&mut x);
        x
    }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
