//! Solvers beside clarabel on one problem: those that are right take turns under the clock, the others
//! are named.

use serde::{Deserialize, Serialize};

use super::contest::{Answer, Tried, clocked};
use super::timing::Time;
use lcplab::error::{Error, Result};
use lcplab::lcp::Lcp;
use lcplab::reference::box_qp_to;
use lcplab::report::study::attempt::entries;
use lcplab::solver::{Options, Settings, Start};

/// The name of the yardstick.
pub const YARDSTICK: &str = "clarabel";
/// A run longer than this (s) is timed once and not repeated.
const LONG: f64 = 0.1;

/// What is asked of an answer, and how long to measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Terms<'a> {
    /// The solvers.
    pub solvers: &'a [String],
    /// The scaled residual asked for.
    pub tolerance: f64,
    /// Seconds to spend.
    pub seconds: f64,
}

/// What came of a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The problem.
    pub problem: String,
    /// Its rows.
    pub rows: usize,
    /// The gap and feasibility that clarabel was asked for.
    pub asked: Option<f64>,
    /// Clarabel first, then the solvers.
    pub answers: Vec<Answer>,
}

/// The clock on a problem; only of answers that the judge accepts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The problem.
    pub problem: String,
    /// Its rows.
    pub rows: usize,
    /// By solver, clarabel first.
    pub solvers: Vec<(String, Time)>,
    /// Those without an answer.
    pub failed: Vec<String>,
}

impl Times {
    /// What clarabel took.
    pub fn yardstick(&self) -> Option<Time> {
        self.of(YARDSTICK)
    }

    /// What a solver took.
    pub fn of(&self, solver: &str) -> Option<Time> {
        self.solvers.iter().find(|(name, _)| name == solver).map(|(_, time)| *time)
    }

    /// How many times clarabel's a solver's time is, by the best of all rounds.
    pub fn ratio(&self, solver: &str) -> Option<f64> {
        Some(self.of(solver)?.best / self.yardstick()?.best)
    }
}

/// Lets the solvers and clarabel try a problem, has the answers judged, and times the right ones.
///
/// # Errors
/// If there is no solver of a name, or A is not symmetric.
pub fn measure(problem: String, lcp: &Lcp, terms: &Terms) -> Result<(Finding, Times)> {
    let none = || Error::invalid("yardstick", YARDSTICK, "no quadratic program over a box");
    let clarabel = |asked| box_qp_to(lcp, asked);
    let yardstick = Tried::yardstick(YARDSTICK, lcp, terms.tolerance, clarabel).ok_or_else(none)?;
    let settings = Settings { tolerance: terms.tolerance, ..Settings::default() };
    let options = Options { settings, ..Options::default() };
    let entries = entries(terms.solvers)?;
    let ours = entries.iter().map(|entry| {
        let solver = (entry.build)(&options);
        let run = move || solver.solve(lcp, &Start::default(), &mut ());
        Tried::of(entry.name, lcp, terms.tolerance, run)
    });
    let tried: Vec<Tried> = [yardstick].into_iter().chain(ours).collect();
    let (solvers, failed) = clocked(&tried, terms.seconds, LONG);
    let asked = tried[0].asked;
    let answers = tried.into_iter().map(|tried| tried.answer).collect();
    let rows = lcp.len();
    Ok((
        Finding { problem: problem.clone(), rows, asked, answers },
        Times { problem, rows, solvers, failed },
    ))
}
