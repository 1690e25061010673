//! Are the solvers honest? Random problems made to hurt, each given to every solver, each answer held
//! against what is true.
//!
//! A solver may fail; it must not say that it has not. These count as a [`Lie`]:
//!
//! - *solved*, and the judge refutes x, or x is not finite;
//! - *no solution*, and exact arithmetic says that one exists.
//!
//! *Solved* means that x solves a problem whose numbers differ by no more than the tolerance. One
//! without solution may have such a neighbour, with a far away x; answers to those are counted apart,
//! as *strained* ([`Claim::Strained`]).
//!
//! What is true is decided problem by problem in rational numbers: an answer that the judge *proves*
//! shows that a solution exists; enumeration of all active sets, or a Farkas vector that was checked
//! exactly, shows that none does. Where neither is shown (coupled rows, for the most part), the judge
//! alone counts.
//!
//! ```
//! use lcplab::solver::{Options, by_name};
//! use lcplab::trial::Trial;
//!
//! let solvers = [by_name("pgs", &Options::default())?, by_name("dantzig", &Options::default())?];
//! let record = Trial { problems: 40, seed: 7 }.of(&solvers, &|| ());
//! assert!(record.tallies.iter().all(|tally| tally.lies.is_empty()));
//! # Ok::<(), lcplab::error::Error>(())
//! ```
//!
//! Problem k of a seed is the same in every trial, on any number of threads: [`problem`].

mod problem;
mod tally;
mod truth;

pub use problem::{KINDS, Kind, problem};
pub use tally::{Record, Tally};
pub use truth::{Claim, Lie, Truth};

use rayon::prelude::*;

use crate::lcp::Lcp;
use crate::solver::{Solver, Start, Stop};

/// So many problems of a seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Trial {
    /// How many problems, the kinds of [`KINDS`] in turns.
    pub problems: usize,
    /// The seed of them all.
    pub seed: u64,
}

impl Trial {
    /// Gives every problem to every solver, on all threads of the pool; `tick` is called after each
    /// problem.
    pub fn of(&self, solvers: &[Box<dyn Solver>], tick: &(dyn Fn() + Sync)) -> Record {
        self.until(&Stop::default(), solvers, tick)
    }

    /// The same until it is time to stop; the record counts the problems that were given.
    pub fn until(
        &self,
        stop: &Stop,
        solvers: &[Box<dyn Solver>],
        tick: &(dyn Fn() + Sync),
    ) -> Record {
        let empty = || Record::empty(solvers);
        let one = |k: usize| {
            if stop.reason().is_some() {
                return empty();
            }
            let (lcp, start) = problem(self.seed, k);
            let claims = claims(&lcp, start.as_deref(), solvers);
            tick();
            Record::of(k, &claims)
        };
        (0..self.problems).into_par_iter().map(one).reduce(empty, Record::and)
    }
}

/// What every solver says of a problem, and whether it is true.
pub fn claims(
    lcp: &Lcp,
    start: Option<&[f64]>,
    solvers: &[Box<dyn Solver>],
) -> Vec<(&'static str, Claim)> {
    let solve = |solver: &dyn Solver| {
        (
            solver.name(),
            Claim::of(lcp, solver.solve(lcp, &Start { x: start, ..Start::default() }, &mut ())),
        )
    };
    let mut claims: Vec<(&'static str, Claim)> =
        solvers.iter().map(|solver| solve(solver.as_ref())).collect();
    let truth = Truth::of(lcp, claims.iter().map(|(_, claim)| claim));
    for (_, claim) in &mut claims {
        claim.weigh(truth);
    }
    claims
}
