//! What a solver returns: x, the w that belongs to it, and the solver's own word on it.

use std::fmt;

use lcplab_problem::Lcp;
use lcplab_problem::memory::Memory;

/// A solver's answer. There is no time in it: a solution is the same on every machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The unknowns, n entries; finite, unless a solver falsely claims otherwise.
    pub x: Vec<f64>,
    /// w = A x + b, recomputed from x when the solution was made.
    pub w: Vec<f64>,
    /// The solver's claim.
    pub status: Status,
    /// Sweeps, pivots or Newton steps that were done.
    pub iterations: usize,
    /// What else than the method itself had a part in it; none by default.
    pub fallback: Option<Fallback>,
    /// Whether *solved* is only implied: a plug-in or a function gave x and no status. Such an x
    /// may be the last iterate of a solver that ran out of sweeps.
    pub is_claim_implied: bool,
}

impl Solution {
    /// The solution with this x; w is recomputed. An x that overflowed becomes zero, moved into the
    /// bounds, with the status [`Status::NotFinite`], unless the solver claims that it is a
    /// solution: a claim is never rewritten, so that a false one can be found.
    pub fn new(lcp: &Lcp, mut x: Vec<f64>, mut status: Status, iterations: usize) -> Self {
        if status != Status::Solved && !x.iter().all(|x| x.is_finite()) {
            x.fill(0.0);
            lcp.project_all(&mut x);
            status = Status::NotFinite;
        }
        Solution { w: lcp.w(&x), x, status, iterations, fallback: None, is_claim_implied: false }
    }

    /// The same, with the part that something else had in it.
    pub fn with_fallback(self, fallback: Option<Fallback>) -> Self {
        Solution { fallback, ..self }
    }

    /// The same, where *solved* is implied by an x without a status.
    pub fn with_implied_claim(self, is_claim_implied: bool) -> Self {
        Solution { is_claim_implied, ..self }
    }
}

/// What a method does where it does not get on by itself. No solver transforms a problem before it
/// starts (presolve) or hands it on to another one; these are all the exceptions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fallback {
    /// Block pivoting made no progress, and single rows were exchanged by Murty's rule.
    LeastIndex,
    /// Block pivoting met a singular block or made no progress, or Dantzig's or Lemke's method met
    /// rows that depend on each other too nearly to tell, and a sequence of regular problems was
    /// solved. Their fixed point solves the problem as it was posed; no row was softened.
    Proximal,
    /// Lemke's path ended at no solution and was followed once more with fresh tableaux.
    SecondPath,
    /// Sweeps of projected Gauss-Seidel took away what rounding Dantzig's method had left.
    Sweeps,
    /// In a simulation, polygons at redundant contacts: the answer is that of rows that yield by
    /// 1e-9 of A's diagonal at most, and solves the rigid problem within the tolerance too.
    Softened,
}

impl fmt::Display for Fallback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Fallback::LeastIndex => "least-index rule",
            Fallback::Proximal => "proximal steps",
            Fallback::SecondPath => "second path",
            Fallback::Sweeps => "Gauss-Seidel sweeps",
            Fallback::Softened => "softened rows",
        })
    }
}

/// A solver's own word on its answer. Only [`Status::Solved`] claims that x is a solution.
#[derive(Debug, Clone, PartialEq)]
pub enum Status {
    /// The scaled residual of x is at most the tolerance.
    Solved,
    /// The method ended, but the residual of x is above the tolerance; x is the best it found.
    Inaccurate,
    /// The iteration limit was reached; x is the last iterate.
    IterationLimit,
    /// No progress any more; x is the last iterate.
    Stalled,
    /// The observer asked to stop; x is the last iterate.
    Stopped,
    /// The iterates grow without bound; x is the last finite iterate.
    Diverged,
    /// An iterate was not finite, since a number was beyond 1.8e308; x is the last finite iterate,
    /// or zero moved into the bounds where the method keeps none.
    NotFinite,
    /// Row `row` has a_ii ≤ 0, by which the method divides; x is the iterate before that.
    ZeroDiagonal {
        /// The row.
        row: usize,
    },
    /// The equations of the active set that contains `row` could not be solved.
    Singular {
        /// The row.
        row: usize,
    },
    /// x can move along `direction` for ever without moving w_`row` towards 0: as far as the
    /// solver can tell there is no solution. x is the point where the ray starts.
    Ray {
        /// The row that could not be satisfied.
        row: usize,
        /// The ray, n entries.
        direction: Vec<f64>,
    },
    /// All active sets were tried in exact arithmetic and none carries a solution; x is the start.
    NoSolution,
    /// The method would take more memory than it may; x is the start.
    TooLarge {
        /// What it would take.
        needs: Memory,
        /// What it may take.
        limit: Memory,
    },
    /// The method is not made for this problem; x is the start.
    OutsideClass {
        /// Which property the problem lacks.
        reason: &'static str,
    },
    /// A solver from outside gave no answer; x is the start.
    NoAnswer {
        /// Why.
        reason: String,
    },
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Status::Solved => write!(f, "solved"),
            Status::Inaccurate => write!(f, "ended above the tolerance"),
            Status::IterationLimit => write!(f, "iteration limit"),
            Status::Stalled => write!(f, "no more progress"),
            Status::Stopped => write!(f, "stopped by the observer"),
            Status::Diverged => write!(f, "diverged"),
            Status::NotFinite => write!(f, "an iterate was not finite; x is not an answer"),
            Status::ZeroDiagonal { row } => write!(f, "the diagonal of row {row} is not positive"),
            Status::Singular { row } => write!(f, "singular at row {row}"),
            Status::Ray { row, .. } => {
                write!(f, "a ray: row {row} is not reached, which alone proves nothing")
            }
            Status::NoSolution => {
                write!(f, "all active sets were tried, and none carries a solution")
            }
            Status::TooLarge { needs, limit } => {
                write!(f, "needs {needs}; the limit is {limit}")
            }
            Status::OutsideClass { reason } => write!(f, "outside the solver's class: {reason}"),
            Status::NoAnswer { reason } => write!(f, "no answer: {reason}"),
        }
    }
}
