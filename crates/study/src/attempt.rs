//! One attempt of a solver at one problem: its claim, the judge's verdict, and its cost.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use lcplab_judge::{Demand, Verdict, judge};
use lcplab_problem::error::Result;
use lcplab_problem::{Lcp, merit};
use lcplab_solver::trace::Work;
use lcplab_solver::{ALL, Entry, Options, Settings, Solution, Start, Status};

/// The outcome of an attempt.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Claimed, and the judge proves that an exact solution has this active set.
    Proved,
    /// Claimed, and the judge finds x within the tolerance.
    Accepted,
    /// Claimed, but the judge rejects it: this must not happen.
    Refuted,
    /// The residual is within the tolerance, but the answer is hardly better than x = 0: the solver
    /// withdraws its claim. A loose tolerance can cause this if masses are very different.
    Withdrawn,
    /// Not claimed, for this reason.
    Failed(String),
    /// The solver reports that it is not made for the problem: this does not count as an attempt.
    Outside(String),
}

impl Outcome {
    /// The outcome of a solve, with claims judged by this tolerance.
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

    /// Whether the solver attempted the problem.
    pub fn is_attempt(&self) -> bool {
        !matches!(self, Outcome::Outside(_))
    }

    /// Whether the solver claims a solution.
    pub fn is_claim(&self) -> bool {
        matches!(self, Outcome::Proved | Outcome::Accepted | Outcome::Refuted)
    }

    /// The outcome in one or two words, or the reason.
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
    /// Its outcome.
    pub outcome: Outcome,
    /// The number of sweeps, steps or pivots.
    pub iterations: usize,
    /// Multiplications ([`Work`]); NaN if they are not counted, as for a plug-in.
    #[serde(with = "crate::number::always")]
    pub work: f64,
}

/// An attempt with the data that is not stored.
pub struct Attempted {
    /// The attempt.
    pub attempt: Attempt,
    /// The answer.
    pub x: Vec<f64>,
    /// Wall time of the solve (s).
    pub seconds: f64,
}

/// The options of an attempt with this tolerance and iteration limit.
pub fn options(tolerance: f64, max_iterations: usize) -> Options {
    let settings = Settings { tolerance, max_iterations, ..Settings::default() };
    Options { settings, ..Options::default() }
}

/// Runs a solver on a problem, and judges the answer by the same tolerance.
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

/// The solvers with these names; all registered ones if the list is empty.
///
/// # Errors
/// If no solver has one of the names.
pub fn entries(names: &[String]) -> Result<Vec<Entry>> {
    if names.is_empty() {
        return Ok(ALL.to_vec());
    }
    names.iter().map(|name| lcplab_solver::entry(name).copied()).collect()
}
