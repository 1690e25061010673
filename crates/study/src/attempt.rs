//! One solver's go at one problem: what it claims, what the judge says, what it cost.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use lcplab_judge::{Demand, Verdict, judge};
use lcplab_problem::error::Result;
use lcplab_problem::{Lcp, merit};
use lcplab_solver::trace::Work;
use lcplab_solver::{ALL, Entry, Options, Settings, Solution, Start, Status};

/// What came of an attempt.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Claimed, and the judge proves that an exact solution has this active set.
    Proved,
    /// Claimed, and the judge finds x within the tolerance.
    Accepted,
    /// Claimed, and the judge does not: this must not happen.
    Refuted,
    /// The residual is within the tolerance, but the answer is hardly better than x = 0: the solver
    /// takes its claim back. A loose tolerance invites this where masses are far apart.
    Withdrawn,
    /// Not claimed, for this reason.
    Failed(String),
    /// The solver says that it is not made for the problem: no attempt.
    Outside(String),
}

impl Outcome {
    /// What came of a solve: a claim is judged by this tolerance.
    pub fn of(solution: &Solution, lcp: &Lcp, tolerance: f64) -> Outcome {
        let demand = Demand { tolerance, prove_up_to: Demand::EXACT_ROWS };
        let is_within = || merit::scaled_residual(lcp, &solution.x) <= tolerance;
        match &solution.status {
            Status::Solved => match judge(lcp, &solution.x, &demand).verdict {
                Verdict::Proved { .. } => Outcome::Proved,
                Verdict::WithinTolerance => Outcome::Accepted,
                Verdict::NotASolution { .. } => Outcome::Refuted,
            },
            Status::Diverged if is_within() => Outcome::Withdrawn,
            Status::OutsideClass { reason } => Outcome::Outside((*reason).to_string()),
            status => Outcome::Failed(status.to_string()),
        }
    }

    /// Whether the solver claims a solution and the judge agrees.
    pub fn is_solved(&self) -> bool {
        matches!(self, Outcome::Proved | Outcome::Accepted)
    }

    /// Whether the solver took the problem on.
    pub fn is_attempt(&self) -> bool {
        !matches!(self, Outcome::Outside(_))
    }

    /// Whether the solver says that it has a solution.
    pub fn is_claim(&self) -> bool {
        matches!(self, Outcome::Proved | Outcome::Accepted | Outcome::Refuted)
    }

    /// In a word or two, or the reason.
    pub fn words(&self) -> &str {
        match self {
            Outcome::Proved => "proved",
            Outcome::Accepted => "within tolerance",
            Outcome::Refuted => "claimed, rejected",
            Outcome::Withdrawn => "within tolerance, but hardly better than x = 0: no claim",
            Outcome::Failed(reason) | Outcome::Outside(reason) => reason,
        }
    }
}

/// A solver on a problem, from x = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Attempt {
    /// The solver.
    pub solver: String,
    /// What came of it.
    pub outcome: Outcome,
    /// Sweeps, steps or pivots.
    pub iterations: usize,
    /// Multiplications ([`Work`]); NaN where nobody counts them, as a plug-in's.
    #[serde(with = "crate::number::always")]
    pub work: f64,
}

/// An attempt with what is not stored of it.
pub struct Attempted {
    /// The attempt.
    pub attempt: Attempt,
    /// The answer.
    pub x: Vec<f64>,
    /// Wall time of the solve (s).
    pub seconds: f64,
}

/// The options of an attempt to this tolerance with at most so many iterations.
pub fn options(tolerance: f64, max_iterations: usize) -> Options {
    let settings = Settings { tolerance, max_iterations, ..Settings::default() };
    Options { settings, ..Options::default() }
}

/// Lets a solver try a problem, and has the answer judged by the tolerance it was asked for.
pub fn attempt(entry: &Entry, lcp: &Lcp, options: &Options) -> Attempted {
    let mut work = Work::of(entry, lcp);
    let start = Instant::now();
    let solution = (entry.build)(options).solve(lcp, &Start::default(), &mut work);
    let seconds = start.elapsed().as_secs_f64();
    let outcome = Outcome::of(&solution, lcp, options.settings.tolerance);
    let (iterations, work) = (solution.iterations, work.multiplications);
    let attempt = Attempt { solver: entry.name.to_string(), outcome, iterations, work };
    Attempted { attempt, x: solution.x, seconds }
}

/// The solvers of these names, all registered ones if there are none.
///
/// # Errors
/// If there is none of a name.
pub fn entries(names: &[String]) -> Result<Vec<Entry>> {
    if names.is_empty() {
        return Ok(ALL.to_vec());
    }
    names.iter().map(|name| lcplab_solver::entry(name).copied()).collect()
}
