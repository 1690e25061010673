//! The callback that receives each iterate of a solver.

use std::ops::ControlFlow;

use super::{Side, Variable};
use lcplab_lcp::Lcp;

/// Receives every iterate and may ask the solver to stop. `()` observes nothing.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Iterate, Observer, Pgs, Solver, Start, StepDetail};
///
/// /// Keeps the first change of each row in a sweep.
/// #[derive(Default)]
/// struct Changes(Vec<(usize, f64)>);
///
/// impl Observer for Changes {
///     fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
///         // One sweep is enough.
///         if iterate.iteration == 1 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
///     }
///
///     fn wants_details(&self) -> bool {
///         true
///     }
///
///     fn part(&mut self, detail: &StepDetail<'_>) {
///         if let StepDetail::Row(update) = detail {
///             self.0.push((update.row, update.after - update.before));
///         }
///     }
/// }
///
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let mut changes = Changes::default();
/// Pgs::default().solve(&lcp, &Start::default(), &mut changes);
/// assert_eq!(changes.0, [(0, 0.5), (1, 0.75)]); // 1/2, then (1 + 1/2)/2
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub trait Observer {
    /// Receives an iterate; `Break` ends the solve with
    /// [`Status::Stopped`](super::Status::Stopped).
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()>;

    /// Whether the observer also wants the details of an iteration; if not, the solver does not
    /// compute them.
    fn wants_details(&self) -> bool {
        false
    }

    /// Receives a detail of the current iteration, if the observer wants details.
    fn part(&mut self, _: &StepDetail<'_>) {}
}

impl Observer for () {
    fn observe(&mut self, _: &Iterate<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// One iterate of a solver.
#[derive(Debug, Clone, Copy)]
pub struct Iterate<'a> {
    /// 0 for the start, then 1, 2, …
    pub iteration: usize,
    /// The current unknowns.
    pub x: &'a [f64],
    /// The event that produced it.
    pub event: Event,
}

/// What a solver did to reach an iterate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// The starting point.
    Start,
    /// One pass over all rows.
    Sweep,
    /// One step of a Newton or first-order method on all rows at once.
    Step,
    /// A pivoting method moved x while driving row `driven`; row `blocking` ended the move.
    Pivot {
        /// The row whose w is driven to 0.
        driven: usize,
        /// The row that changed sides; `driven` itself if its w reached 0.
        blocking: usize,
    },
    /// A block of rows changed sides at once.
    Exchange {
        /// The number of rows.
        rows: usize,
    },
    /// An enumeration tried another active set.
    Trial,
}

/// A detail of an iteration, as in a calculation by hand. PGS and SOR report the rows of a sweep,
/// Dantzig's method its moves, Lemke's method its tableaux.
#[derive(Debug, Clone, Copy)]
pub enum StepDetail<'a> {
    /// Bounds that depend on x are frozen at x; the details that follow are about this problem.
    Frozen(&'a Lcp),
    /// A row of a sweep: x_i ← Π_i(x_i − ω w_i / a_ii).
    Row(RowUpdate),
    /// A row that need not be driven because it is already satisfied.
    Satisfied {
        /// The row.
        row: usize,
        /// Its w.
        w: f64,
        /// Its side from now on.
        side: Side,
    },
    /// A move of x along a direction.
    Move(Move<'a>),
    /// A move of x that changes no w, to the middle of the feasible range.
    Centering(Centering<'a>),
    /// A tableau and its next pivot.
    Tableau(Tableau<'a>),
}

/// One row of a sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowUpdate {
    /// The row i.
    pub row: usize,
    /// w_i at the newest x.
    pub w: f64,
    /// a_ii, the divisor.
    pub diagonal: f64,
    /// ω.
    pub omega: f64,
    /// x_i before.
    pub before: f64,
    /// x_i − ω w_i / a_ii.
    pub unclamped: f64,
    /// The same, clamped to the bounds.
    pub after: f64,
}

/// A move of x in Dantzig's method: x_i changes by `sign` × `length`, x_C by
/// `sign` × `length` × `direction`.
#[derive(Debug, Clone, Copy)]
pub struct Move<'a> {
    /// The problem; bounds of coupled rows are frozen.
    pub lcp: &'a Lcp,
    /// The row i that is driven.
    pub driven: usize,
    /// +1 if x_i rises, −1 if it falls.
    pub sign: f64,
    /// x before, n entries.
    pub x: &'a [f64],
    /// w before, n entries; valid for rows at a bound and the driven row.
    pub w: &'a [f64],
    /// The side of each row, n entries.
    pub side: &'a [Side],
    /// The free rows C.
    pub free: &'a [usize],
    /// d_C, in the order of C.
    pub direction: &'a [f64],
    /// s = Δw_i for d_i = 1; 0 where row i depends on C.
    pub schur: f64,
    /// Δw of the rows at a bound for d_i = 1, n entries.
    pub delta_w: &'a [f64],
    /// The length t of the move.
    pub length: f64,
    /// The row that ends the move.
    pub blocking: usize,
    /// The new side of that row.
    pub to: Side,
}

/// A centering move in Dantzig's method: x_j changes by a length, x_C by the same length times
/// `direction`, with A d = 0.
#[derive(Debug, Clone, Copy)]
pub struct Centering<'a> {
    /// The row j, which depends on C and has the side [`Side::Dependent`] from now on.
    pub row: usize,
    /// The row of C that reached a bound and stays in C because x moves away from it; `None` if row
    /// j itself has just been processed.
    pub keeps: Option<usize>,
    /// x before, n entries.
    pub x: &'a [f64],
    /// The free rows C.
    pub free: &'a [usize],
    /// d_C, in the order of C.
    pub direction: &'a [f64],
    /// How far x can move along d.
    pub forward: f64,
    /// How far x can move along −d.
    pub back: f64,
}

impl Centering<'_> {
    /// The signed length of the move, negative along −d.
    ///
    /// ```
    /// use lcplab_solver::Centering;
    ///
    /// // Support 0 carries the whole load of 1; half of it can move to support 1.
    /// let centering = Centering {
    ///     row: 1,
    ///     keeps: None,
    ///     x: &[1.0, 0.0],
    ///     free: &[0],
    ///     direction: &[-1.0],
    ///     forward: 1.0,
    ///     back: 0.0,
    /// };
    /// assert_eq!(centering.length(), 0.5);
    /// ```
    pub fn length(&self) -> f64 {
        (self.forward - self.back) / 2.0
    }
}

/// A tableau of Lemke's method, v_B = c + T v_N.
#[derive(Debug, Clone, Copy)]
pub struct Tableau<'a> {
    /// The basic variables, one per row.
    pub basic: &'a [Variable],
    /// The nonbasic variables, one per column; they are 0.
    pub nonbasic: &'a [Variable],
    /// c, the values of the basic variables.
    pub constant: &'a [f64],
    /// T, row by row.
    pub rows: &'a [Vec<f64>],
    /// The upper limits of the basic variables.
    pub ranges: &'a [f64],
    /// The number of leading rows whose variables must not be negative.
    pub pairs: usize,
    /// The column of the entering variable; `None` if the path has ended.
    pub entering: Option<usize>,
    /// The leaving variable; `None` on a ray, or if the path has ended.
    pub leaving: Option<Leaving>,
}

/// The variable that leaves the basis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leaving {
    /// The basic variable of this row.
    Basic(usize),
    /// The mirror image of the entering variable, which has reached the end of its range.
    Mirrored,
}
