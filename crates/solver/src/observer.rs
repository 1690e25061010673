//! Someone who looks over a solver's shoulder.

use std::ops::ControlFlow;

use super::{Side, Variable};
use lcplab_problem::Lcp;

/// Is told of every iterate, and may ask the solver to stop. `()` observes nothing.
pub trait Observer {
    /// Looks at an iterate; `Break` ends the solve with
    /// [`Status::Stopped`](super::Status::Stopped).
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()>;

    /// Whether it wants to see the parts of an iteration too; nothing is made of them otherwise.
    fn asks_for_parts(&self) -> bool {
        false
    }

    /// Looks at a part of the iteration under way, if it asks for parts.
    fn part(&mut self, _: &Part<'_>) {}
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
    /// The unknowns now.
    pub x: &'a [f64],
    /// What led here.
    pub event: Event,
}

/// What a solver did to reach an iterate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// The starting point.
    Start,
    /// One pass over all rows.
    Sweep,
    /// One step of a Newton or first-order method, all rows at once.
    Step,
    /// A pivoting method moved x while driving row `driven`; row `blocking` ended the move.
    Pivot {
        /// The row whose w is driven to 0.
        driven: usize,
        /// The row that changed sides, `driven` itself when it got there.
        blocking: usize,
    },
    /// A block of rows changed sides at once.
    Exchange {
        /// How many rows.
        rows: usize,
    },
    /// An enumeration looked at another active set.
    Trial,
}

/// A part of an iteration: what a student would write down. The sweeps of PGS and SOR tell their
/// rows, Dantzig's method its moves, Lemke's its tableaux.
#[derive(Debug, Clone, Copy)]
pub enum Part<'a> {
    /// Bounds that depend on x are frozen at it; what follows is about this problem.
    Frozen(&'a Lcp),
    /// A row of a sweep: x_i ← Π_i(x_i − ω w_i / a_ii).
    Row(RowUpdate),
    /// A row that need not be driven: it is satisfied as it stands.
    Satisfied {
        /// The row.
        row: usize,
        /// Its w.
        w: f64,
        /// Where it stands from now on.
        side: Side,
    },
    /// A move of x along a direction.
    Move(Move<'a>),
    /// A move of x that changes no w, to the middle of where it may go.
    Centring(Centring<'a>),
    /// A tableau, and the pivot that will be done in it.
    Tableau(Tableau<'a>),
}

/// One row of a sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowUpdate {
    /// The row i.
    pub row: usize,
    /// w_i with the newest x.
    pub w: f64,
    /// a_ii, by which it is divided.
    pub diagonal: f64,
    /// ω.
    pub omega: f64,
    /// x_i before.
    pub before: f64,
    /// x_i − ω w_i / a_ii.
    pub unclamped: f64,
    /// The same within the bounds.
    pub after: f64,
}

/// A move of x in Dantzig's method: x_i by `sign`, x_C by `sign` times `direction`, for `length`.
#[derive(Debug, Clone, Copy)]
pub struct Move<'a> {
    /// The problem; its bounds are frozen where rows are coupled.
    pub lcp: &'a Lcp,
    /// The row i that is driven.
    pub driven: usize,
    /// +1 if x_i rises, −1 if it falls.
    pub sign: f64,
    /// x before, n entries.
    pub x: &'a [f64],
    /// w before, n entries; kept for rows at a bound and the driven one.
    pub w: &'a [f64],
    /// Where the rows stand, n entries.
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
    /// The row that ends it.
    pub blocking: usize,
    /// Where that row goes.
    pub to: Side,
}

/// A move to the middle in Dantzig's method: x_j by a length, x_C by the same times `direction`,
/// along which A d = 0.
#[derive(Debug, Clone, Copy)]
pub struct Centring<'a> {
    /// The row j, which depends on C and is idle from now on.
    pub row: usize,
    /// The row of C that has met a bound and, since x moves, stays in C; `None` where row j itself
    /// has just been looked at.
    pub keeps: Option<usize>,
    /// x before, n entries.
    pub x: &'a [f64],
    /// The free rows C.
    pub free: &'a [usize],
    /// d_C, in the order of C.
    pub direction: &'a [f64],
    /// How far x may go along d.
    pub forward: f64,
    /// How far it may go along −d.
    pub back: f64,
}

impl Centring<'_> {
    /// The length of the move, negative if it goes along −d.
    pub fn length(&self) -> f64 {
        (self.forward - self.back) / 2.0
    }
}

/// A tableau of Lemke's method, v_B = c + T v_N.
#[derive(Debug, Clone, Copy)]
pub struct Tableau<'a> {
    /// The basic variables, one a row.
    pub basic: &'a [Variable],
    /// The nonbasic variables, one a column; they are 0.
    pub nonbasic: &'a [Variable],
    /// c, the values of the basic variables.
    pub constant: &'a [f64],
    /// T by rows.
    pub rows: &'a [Vec<f64>],
    /// How large the basic variables may become.
    pub ranges: &'a [f64],
    /// So many of the first rows are variables that must not be negative.
    pub pairs: usize,
    /// The column of the variable that enters; `None` where the path has ended.
    pub entering: Option<usize>,
    /// The variable that leaves; `None` on a ray, or where the path has ended.
    pub leaving: Option<Leaving>,
}

/// The variable that becomes zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leaving {
    /// The basic one of this row.
    Basic(usize),
    /// The mirror image of the entering one, which has come to the end of its range.
    Mirrored,
}
