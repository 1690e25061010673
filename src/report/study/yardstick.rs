//! Solvers beside clarabel on one problem. Each answer is judged first; those that are right take turns
//! under the clock, the others are named.
//!
//! Both sides must arrive: clarabel is asked for no more than it needs to reach the same scaled
//! residual, 1e-8 of gap and feasibility at first.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::attempt::{Attempted, Outcome, attempt, entries};
use super::timing::{Contender, Time, interleaved, timed};
use crate::error::{Error, Result};
use crate::lcp::{Lcp, merit};
use crate::reference::{Reference, box_qp_to};
use crate::solver::{Entry, Options, Settings, Solution, Start, Status};

/// The name of the yardstick.
pub const YARDSTICK: &str = "clarabel";
/// What clarabel is asked for, one after the other, until its residual is as small as ours must be.
const ASKED: [f64; 3] = [1e-8, 1e-10, 1e-12];
/// A run longer than this (s) is timed once and not repeated.
const LONG: f64 = 0.1;
/// More rounds say nothing new.
const MOST_ROUNDS: usize = 101;

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
    pub asked: f64,
    /// Clarabel first, then the solvers.
    pub answers: Vec<Answer>,
}

/// An answer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The solver.
    pub solver: String,
    /// What came of it.
    pub outcome: Outcome,
    /// Of its x.
    #[serde(with = "crate::report::results::number")]
    pub residual: f64,
    /// Steps or pivots.
    pub iterations: usize,
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
    let settings = Settings { tolerance: terms.tolerance, ..Settings::default() };
    let options = Options { settings, ..Options::default() };
    let (asked, yardstick) = by_clarabel(lcp, terms.tolerance)?;
    let entries = entries(terms.solvers)?;
    let ours = entries.iter().map(|entry| by(entry, lcp, &options));
    let tried: Vec<Tried> = [yardstick].into_iter().chain(ours).collect();
    let (solvers, failed) = clocked(&tried, terms.seconds);
    let answers = tried.into_iter().map(|tried| tried.answer).collect();
    let rows = lcp.len();
    Ok((
        Finding { problem: problem.clone(), rows, asked, answers },
        Times { problem, rows, solvers, failed },
    ))
}

/// An answer and how to obtain it again.
struct Tried<'a> {
    answer: Answer,
    /// What the first run took (s).
    once: f64,
    again: Box<dyn Fn() + 'a>,
}

impl Tried<'_> {
    fn again(&self) -> f64 {
        timed(|| (self.again)())
    }
}

/// The times of those whose answer is accepted, in turns, and the names of the others.
fn clocked(tried: &[Tried], seconds: f64) -> (Vec<(String, Time)>, Vec<String>) {
    let (good, bad): (Vec<&Tried>, Vec<&Tried>) =
        tried.iter().partition(|tried| tried.answer.outcome.is_solved());
    let quick = || good.iter().filter(|tried| tried.once <= LONG);
    let a_round: f64 = quick().map(|tried| tried.once).sum();
    let rounds = ((seconds / a_round) as usize).min(MOST_ROUNDS);
    let mut contenders: Vec<Contender> =
        quick().map(|tried| Contender::new(|| tried.again())).collect();
    let mut times = interleaved(rounds, &mut contenders).into_iter();
    let mut time = |tried: &Tried| {
        let repeated = if tried.once <= LONG { times.next() } else { None };
        repeated.unwrap_or_else(|| {
            let once = tried.again(); // the first run was watched, which costs
            Time { median: once, best: once }
        })
    };
    let times = good.iter().map(|tried| (tried.answer.solver.clone(), time(tried))).collect();
    (times, bad.into_iter().map(|tried| tried.answer.solver.clone()).collect())
}

fn by<'a>(entry: &Entry, lcp: &'a Lcp, options: &Options) -> Tried<'a> {
    let Attempted { attempt, x, seconds } = attempt(entry, lcp, options);
    let solver = (entry.build)(options);
    Tried {
        answer: Answer {
            solver: attempt.solver,
            outcome: attempt.outcome,
            residual: merit::scaled_residual(lcp, &x),
            iterations: attempt.iterations,
        },
        once: seconds,
        again: Box::new(move || drop(solver.solve(lcp, &Start::default(), &mut ()))),
    }
}

/// Clarabel's answer, asked for no more than it needs to be within the tolerance.
fn by_clarabel(lcp: &Lcp, tolerance: f64) -> Result<(f64, Tried<'_>)> {
    let ask = |asked: f64| -> Result<(f64, Reference, f64)> {
        let start = Instant::now();
        let reference = box_qp_to(lcp, asked).ok_or_else(|| {
            Error::invalid("yardstick", YARDSTICK, "no quadratic program over a box")
        })?;
        Ok((asked, reference, start.elapsed().as_secs_f64()))
    };
    let is_there = |reference: &Reference| {
        reference.solved && merit::scaled_residual(lcp, &reference.point) <= tolerance
    };
    let mut last = ask(ASKED[0])?;
    for asked in &ASKED[1..] {
        if !is_there(&last.1) {
            last = ask(*asked)?;
        }
    }
    let (asked, reference, once) = last;
    let status = if is_there(&reference) { Status::Solved } else { Status::Inaccurate };
    let iterations = reference.iterations;
    let claim = Solution::new(lcp, reference.point, status, iterations);
    let answer = Answer {
        solver: YARDSTICK.into(),
        outcome: Outcome::of(&claim, lcp, tolerance),
        residual: merit::scaled_residual(lcp, &claim.x),
        iterations,
    };
    Ok((asked, Tried { answer, once, again: Box::new(move || drop(box_qp_to(lcp, asked))) }))
}
