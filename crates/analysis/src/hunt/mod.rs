//! Tests solvers for false claims: hard random problems are given to every solver, and each answer
//! is compared with the truth.
//!
//! A solver may fail, but it must not claim success falsely, and the judge must not give a false
//! verdict. These count as a [`FalseClaim`]:
//!
//! - *solved*, but x is not finite, violates a row, or is no nearer to a solution than zero;
//! - *no solution*, but one exists;
//! - accepted by the judge, but none exists; rejected by the judge as impossible, but one exists.
//!
//! The truth is decided in rational arithmetic by trying all pieces of the problem
//! ([`all_solutions`](lcplab_lcp::exact::all_solutions)), including coupled rows. *Solved*
//! means that x solves a problem whose numbers differ by no more than the tolerance. A problem
//! without solution may have such a neighbor, so a solver may accept an x for it, but the judge may
//! not ([`Claim::Refused`]).
//!
//! Cones have closed forms instead: [`cone`]. Under a friction model, the judge of that model
//! decides.
//!
//! An x without a status, as from a plug-in, counts as *solved* only if a solver that merely ran
//! out of sweeps would have come nearer.
//!
//! ```
//! use lcplab_solver::{Dantzig, Pgs, Solver};
//! use lcplab_analysis::hunt::Hunt;
//!
//! let solvers: [Box<dyn Solver>; 2] = [Box::new(Pgs::default()), Box::new(Dantzig::default())];
//! let record = Hunt { problems: 40, seed: 7, tolerance: 1e-8 }.of(&solvers, &|| ());
//! assert!(record.tallies.iter().all(|tally| tally.false_claims.is_empty()));
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```
//!
//! Problem k of a seed is the same in every hunt, for any number of threads: [`problem`].
//!
//! A [`Search`] goes further: starting from random problems, it hill-climbs towards one on which a
//! solver fails ([`Measure`]) and shrinks it; a [`Finding`] explains it. The initial problems and
//! all reported ones have the requested matrix class and friction model: [`Given`].

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
pub use measure::{Exclusion, Friction, Measure, Score, Target};
pub use posing::pose;
pub use problem::{KINDS, Kind, contact_problem, problem};
pub use right::RightAnswer;
pub use search::{Counterexample, Search, SearchResult};
pub use tally::{Record, Tally};
pub use truth::{Claim, FalseClaim, Truth};

use rayon::prelude::*;

use crate::trial::Trial;
use lcplab_lcp::Lcp;
use lcplab_lcp::friction::Model;
use lcplab_solver::{Method, Options, Solver, Start, Stop};

/// A hunt over a number of problems of a seed.
///
/// ```
/// use lcplab_analysis::hunt::{Hunt, claims, cone, pose, problem};
/// use lcplab_lcp::friction::{Model, ProblemForm};
/// use lcplab_solver::{Dantzig, Options, Registry, Settings, Solver, Stop};
///
/// let hunt = Hunt { problems: 20, seed: 7, tolerance: 1e-8 };
/// let solvers: [Box<dyn Solver>; 1] = [Box::new(Dantzig::default())];
/// let record = hunt.until(&Stop::default(), &solvers, &|| ());
/// assert!(record.has_no_false_claims() && record.tallies[0].right() > 0);
///
/// // One of these problems by itself: a claim for each solver.
/// let (lcp, start) = problem(7, 0);
/// assert_eq!(claims(&lcp, start.as_deref(), &solvers, 1e-8).len(), 1);
/// assert!(matches!(pose(&lcp, None)?, ProblemForm::Boxed(_))); // no friction model: a box
///
/// // Methods under a friction model, and cones, whose answers have closed forms.
/// let methods = [Registry::standard().method("cone-pgs", Some(Model::CoulombCone))?.clone()];
/// let (model, options) = (Model::CoulombCone, Options::default());
/// let record = hunt.under(model, &Stop::default(), &methods, &options, &|| ());
/// assert!(record.has_no_false_claims());
/// let settings = Settings::default();
/// assert_eq!(cone::tallies(7, 20, &settings).len(), 2); // cone-pgs and apgd
/// assert!(record.with_cones(7, 20, &settings).has_no_false_claims());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hunt {
    /// The number of problems, cycling through the kinds in [`KINDS`].
    pub problems: usize,
    /// The seed of all problems.
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

    /// The same with a stop condition; the record counts the problems that were given.
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

    /// The claims of methods on problems with friction ([`contact_problem`]) under a model, and
    /// whether the judge of that model agrees, until the stop condition.
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
                let trial = Trial::run(method, &posed, options, &mut ());
                Claim::under(&posed, &trial.solution, self.tolerance)
            };
            let claims: Vec<(&str, Claim)> =
                methods.iter().map(|method| (method.name(), claim(method))).collect();
            tick();
            Record::of(k, "friction", &claims)
        };
        (0..self.problems).into_par_iter().map(one).reduce(empty, Record::and)
    }
}

/// The claim of every solver on a problem, and whether it is true.
pub fn claims<'s>(
    lcp: &Lcp,
    start: Option<&[f64]>,
    solvers: &'s [Box<dyn Solver>],
    tolerance: f64,
) -> Vec<(&'s str, Claim)> {
    let start = Start { x: start, ..Start::default() };
    let solve = |solver: &'s dyn Solver| {
        (solver.name(), Claim::of(lcp, &solver.solve(lcp, &start, &mut ()), tolerance))
    };
    let mut claims: Vec<(&str, Claim)> =
        solvers.iter().map(|solver| solve(solver.as_ref())).collect();
    let truth = Truth::of(lcp, claims.iter().map(|(_, claim)| claim));
    for (_, claim) in &mut claims {
        claim.weigh(truth);
    }
    claims
}
