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
//! let record = Hunt { numbers: 0..40, seed: 7, tolerance: 1e-8 }.of(&solvers, &|| ());
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
mod progress;
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
pub use problem::{KINDS, Kind, contact_problem, problem, problem_file};
pub use progress::Progress;
pub use right::RightAnswer;
pub use search::{Counterexample, Search, SearchResult};
pub use tally::{Record, Tally};
pub use truth::{Claim, FalseClaim, Truth};

use std::ops::Range;

use crate::trial::Trial;
use lcplab_lcp::Lcp;
use lcplab_lcp::friction::Model;
use lcplab_solver::{Method, Options, Registry, Settings, Solver, Start, Stop};

/// A hunt over a number of problems of a seed.
///
/// ```
/// use lcplab_analysis::hunt::{Hunt, Progress, claims, pose, problem, problem_file};
/// use lcplab_lcp::friction::{Model, ProblemForm};
/// use lcplab_solver::{Dantzig, Options, Registry, Settings, Solver, Stop};
///
/// let hunt = Hunt { numbers: 0..20, seed: 7, tolerance: 1e-8 };
/// let solvers: [Box<dyn Solver>; 1] = [Box::new(Dantzig::default())];
/// let (stop, progress) = (Stop::default(), Progress::default());
/// let record = hunt.until(&stop, &solvers, &progress, &|| ());
/// assert!(record.has_no_false_claims() && record.tallies[0].right() > 0);
/// assert_eq!(progress.record(), record); // another thread can read it at any time
///
/// // One of these problems by itself: a claim for each solver.
/// let (lcp, start) = problem(7, 0);
/// assert_eq!(claims(&lcp, start.as_deref(), &solvers, 1e-8).len(), 1);
/// assert_eq!(problem_file(7, 0, None).lcp.b(), lcp.b()); // as a file
/// assert!(matches!(pose(&lcp, None)?, ProblemForm::Boxed(_))); // no friction model: a box
///
/// // Methods under a friction model, and cones, whose answers have closed forms.
/// let methods = [Registry::standard().method("cone-pgs", Some(Model::CoulombCone))?.clone()];
/// let (model, options) = (Model::CoulombCone, Options::default());
/// let progress = Progress::default();
/// let record = hunt.under(model, &stop, &methods, &options, &progress, &|| ());
/// assert!(record.has_no_false_claims());
/// let record = hunt.with_cones(20, &stop, &Settings::default(), &progress);
/// assert!(record.has_no_false_claims() && record.contacts == 20);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Hunt {
    /// The numbers of the problems, which cycle through the kinds in [`KINDS`].
    pub numbers: Range<usize>,
    /// The seed of all problems.
    pub seed: u64,
    /// The largest scaled residual of a solution.
    pub tolerance: f64,
}

impl Hunt {
    /// Gives every problem to every solver, on all threads of the pool; `tick` is called after each
    /// problem.
    pub fn of(&self, solvers: &[Box<dyn Solver>], tick: &(dyn Fn() + Sync)) -> Record {
        self.until(&Stop::default(), solvers, &Progress::default(), tick)
    }

    /// The same with a stop condition, at which the problems in work are given up. Problems are
    /// given in the order of their numbers; `progress` has the record of those that are finished.
    pub fn until(
        &self,
        stop: &Stop,
        solvers: &[Box<dyn Solver>],
        progress: &Progress,
        tick: &(dyn Fn() + Sync),
    ) -> Record {
        let names = solvers.iter().map(|solver| solver.name());
        progress.work(names, self.numbers.clone(), stop, &|k| {
            let (lcp, start) = problem(self.seed, k);
            let claims = claims_until(stop, &lcp, start.as_deref(), solvers, self.tolerance)?;
            tick();
            Some(Record::of(k, KINDS[k % KINDS.len()].name, &claims))
        })
    }

    /// The claims of methods on problems with friction ([`contact_problem`]) under a model, and
    /// whether the judge of that model agrees, until the stop condition.
    pub fn under(
        &self,
        model: Model,
        stop: &Stop,
        methods: &[Method],
        options: &Options,
        progress: &Progress,
        tick: &(dyn Fn() + Sync),
    ) -> Record {
        let names = methods.iter().map(Method::name);
        progress.work(names, self.numbers.clone(), stop, &|k| {
            let posed = pose(&contact_problem(self.seed, k), Some(model)).ok()?;
            let mut claims = Vec::with_capacity(methods.len());
            for method in methods {
                let trial = Trial::run(method, &posed, options, &mut stop.watch(&mut ()));
                if stop.reason().is_some() {
                    return None;
                }
                let claim = Claim::under(&posed, &trial.solution, self.tolerance);
                claims.push((method.name(), claim));
            }
            tick();
            Some(Record::of(k, "friction", &claims))
        })
    }

    /// The record in `progress` with the claims of the cone solvers on the first contacts of the
    /// seed ([`cone`]) among those of [`contact_problem`], until the stop condition.
    pub fn with_cones(
        &self,
        contacts: usize,
        stop: &Stop,
        settings: &Settings,
        progress: &Progress,
    ) -> Record {
        let names = Registry::standard().cone_entries().map(|entry| &*entry.name);
        // With the numbers that they have as problems with friction.
        let one = |k| Some(cone::record(self.seed, 2 * k, settings));
        progress.add_cones(Progress::default().work(names, 0..contacts, stop, &one));
        progress.record()
    }
}

/// The claim of every solver on a problem, and whether it is true.
pub fn claims<'s>(
    lcp: &Lcp,
    start: Option<&[f64]>,
    solvers: &'s [Box<dyn Solver>],
    tolerance: f64,
) -> Vec<(&'s str, Claim)> {
    claims_until(&Stop::default(), lcp, start, solvers, tolerance)
        .expect("a condition that is never met")
}

/// The same; none if the stop condition is met before all solvers have answered.
fn claims_until<'s>(
    stop: &Stop,
    lcp: &Lcp,
    start: Option<&[f64]>,
    solvers: &'s [Box<dyn Solver>],
    tolerance: f64,
) -> Option<Vec<(&'s str, Claim)>> {
    let start = Start { x: start, ..Start::default() };
    let solve = |solver: &'s dyn Solver| {
        let solution = solver.solve(lcp, &start, &mut stop.watch(&mut ()));
        let is_in_time = stop.reason().is_none();
        is_in_time.then(|| (solver.name(), Claim::of(lcp, &solution, tolerance)))
    };
    let answers = solvers.iter().map(|solver| solve(solver.as_ref()));
    let mut claims = answers.collect::<Option<Vec<_>>>()?;
    let truth = Truth::of(lcp, claims.iter().map(|(_, claim)| claim));
    for (_, claim) in &mut claims {
        claim.weigh(truth);
    }
    Some(claims)
}
