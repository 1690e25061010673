//! Are the solvers honest? Random problems made to hurt, each given to every solver, each answer
//! held against what is true.
//!
//! A solver may fail; it must not say that it has not. Nor may the judge say what is not so. These
//! count as a [`Lie`]:
//!
//! - *solved*, and x is not finite, misses a row, or is no nearer to a solution than zero is;
//! - *no solution*, and one exists;
//! - accepted by the judge, and none exists; refused by the judge as impossible, and one exists.
//!
//! What is true is decided in rational numbers, by trying all pieces of the problem
//! ([`all_solutions`](lcplab_problem::exact::all_solutions)), coupled rows included. *Solved* means
//! that x solves a problem whose numbers differ by no more than the tolerance, and one without
//! solution may have such a neighbour: a solver may take that for a solution, the judge may not
//! ([`Claim::Refused`]).
//!
//! Cones have closed forms instead: [`cone`]. Under a friction model the judge of that model
//! decides.
//!
//! An x without a status, as a plug-in may give it, counts as *solved* only where a solver that
//! merely ran out of sweeps would have come nearer: [`Claim::under`].
//!
//! ```
//! use lcplab_solver::{Options, by_name};
//! use lcplab_study::hunt::Hunt;
//!
//! let solvers = [by_name("pgs", &Options::default())?, by_name("dantzig", &Options::default())?];
//! let record = Hunt { problems: 40, seed: 7, tolerance: 1e-8 }.of(&solvers, &|| ());
//! assert!(record.tallies.iter().all(|tally| tally.lies.is_empty()));
//! # Ok::<(), lcplab_problem::error::Error>(())
//! ```
//!
//! Problem k of a seed is the same in every hunt, on any number of threads: [`problem`].
//!
//! A [`Search`] goes on from there: it climbs from random problems towards one that breaks a solver
//! ([`Measure`]) and makes that as small as it can; a [`Finding`] explains it. What a search begins
//! with, and all that it reports, is of the class of matrices and under the friction model that
//! were asked for: [`Given`].

mod change;
pub mod cone;
mod finding;
mod given;
mod measure;
mod membership;
mod numbers;
mod posing;
mod problem;
mod right;
mod search;
mod shrink;
mod sweeps;
mod tally;
mod truth;

pub use finding::Finding;
pub use given::Given;
pub use measure::{Friction, Measure, Score, Trial, Unfair};
pub use posing::{frozen_at, pose};
pub use problem::{KINDS, Kind, contact_problem, problem};
pub use right::RightAnswer;
pub use search::{Catch, Search, Searched};
pub use tally::{Record, Tally};
pub use truth::{Claim, Lie, Truth};

use rayon::prelude::*;

use lcplab_problem::Lcp;
use lcplab_problem::friction::Model;
use lcplab_solver::{Method, Options, Solver, Start, Stop};

/// So many problems of a seed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hunt {
    /// How many problems, the kinds of [`KINDS`] in turns.
    pub problems: usize,
    /// The seed of them all.
    pub seed: u64,
    /// The largest scaled residual of a solution.
    pub tolerance: f64,
}

impl Hunt {
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
        let empty = || Record::empty(solvers.iter().map(|solver| solver.name()));
        let one = |k: usize| {
            if stop.reason().is_some() {
                return empty();
            }
            let (lcp, start) = problem(self.seed, k);
            let claims = claims(&lcp, start.as_deref(), solvers, self.tolerance);
            tick();
            Record::of(k, KINDS[k % KINDS.len()].name, &claims)
        };
        (0..self.problems).into_par_iter().map(one).reduce(empty, Record::and)
    }

    /// What methods claim of problems with friction ([`contact_problem`]) under a model, and
    /// whether the judge of that model agrees, until it is time to stop.
    pub fn under(
        &self,
        model: Model,
        stop: &Stop,
        methods: &[Method],
        options: &Options,
        tick: &(dyn Fn() + Sync),
    ) -> Record {
        let empty = || Record::empty(methods.iter().map(Method::name));
        let one = |k: usize| {
            let posed = pose(&contact_problem(self.seed, k), Some(model));
            let Some(posed) = posed.ok().filter(|_| stop.reason().is_none()) else {
                return empty();
            };
            let claim = |method: &Method| {
                let solution = method.solve(&posed, options, &mut ());
                (method.name(), Claim::under(&posed, &solution, self.tolerance))
            };
            let claims: Vec<(&'static str, Claim)> = methods.iter().map(claim).collect();
            tick();
            Record::of(k, "friction", &claims)
        };
        (0..self.problems).into_par_iter().map(one).reduce(empty, Record::and)
    }
}

/// What every solver says of a problem, and whether it is true.
pub fn claims(
    lcp: &Lcp,
    start: Option<&[f64]>,
    solvers: &[Box<dyn Solver>],
    tolerance: f64,
) -> Vec<(&'static str, Claim)> {
    let start = Start { x: start, ..Start::default() };
    let solve = |solver: &dyn Solver| {
        (solver.name(), Claim::of(lcp, &solver.solve(lcp, &start, &mut ()), tolerance))
    };
    let mut claims: Vec<(&'static str, Claim)> =
        solvers.iter().map(|solver| solve(solver.as_ref())).collect();
    let truth = Truth::of(lcp, claims.iter().map(|(_, claim)| claim));
    for (_, claim) in &mut claims {
        claim.weigh(truth);
    }
    claims
}
