//! Solvers beside a yardstick: each answer is judged first, and only those that are accepted are timed,
//! in turns in one process.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::timing::{Contender, Time, interleaved, timed};
use lcplab::lcp::{Lcp, merit};
use lcplab::reference::Reference;
use lcplab::report::study::attempt::Outcome;
use lcplab::solver::{Solution, Status};

/// The gap and feasibility that a yardstick is asked for, one after the other, until its residual is as
/// small as ours must be.
const ASKED: [f64; 5] = [1e-8, 1e-9, 1e-10, 1e-11, 1e-12];
/// More rounds say nothing new.
const MOST_ROUNDS: usize = 101;

/// An answer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The solver.
    pub solver: String,
    /// What came of it.
    pub outcome: Outcome,
    /// Of its x.
    #[serde(with = "lcplab_study::number::always")]
    pub residual: f64,
    /// Steps or pivots.
    pub iterations: usize,
}

/// An answer and how to obtain it again.
pub struct Tried<'a> {
    /// What is stored of it.
    pub answer: Answer,
    /// Its x.
    pub x: Vec<f64>,
    /// The gap and feasibility that a yardstick was asked for.
    pub asked: Option<f64>,
    /// What the first run took (s).
    once: f64,
    again: Box<dyn Fn() + 'a>,
}

impl<'a> Tried<'a> {
    /// A solver's answer, judged by this tolerance.
    pub fn of(solver: &str, lcp: &Lcp, tolerance: f64, run: impl Fn() -> Solution + 'a) -> Self {
        let start = Instant::now();
        let solution = run();
        let once = start.elapsed().as_secs_f64();
        Tried::judged(solver, lcp, tolerance, solution, once, move || drop(run()))
    }

    /// The answer of a yardstick, asked for no more than it needs to be within the tolerance; nothing if
    /// it is not made for the problem.
    pub fn yardstick(
        name: &str,
        lcp: &Lcp,
        tolerance: f64,
        ask: impl Fn(f64) -> Option<Reference> + 'a,
    ) -> Option<Self> {
        for (k, asked) in ASKED.into_iter().enumerate() {
            let start = Instant::now();
            let Reference { point, iterations, solved, .. } = ask(asked)?;
            let once = start.elapsed().as_secs_f64();
            let is_there = solved && merit::scaled_residual(lcp, &point) <= tolerance;
            if is_there || k + 1 == ASKED.len() {
                let status = if is_there { Status::Solved } else { Status::Inaccurate };
                let claim = Solution::new(lcp, point, status, iterations);
                let again = move || drop(ask(asked));
                let tried = Tried::judged(name, lcp, tolerance, claim, once, again);
                return Some(Tried { asked: Some(asked), ..tried });
            }
        }
        None
    }

    fn judged(
        solver: &str,
        lcp: &Lcp,
        tolerance: f64,
        solution: Solution,
        once: f64,
        again: impl Fn() + 'a,
    ) -> Self {
        let answer = Answer {
            solver: solver.into(),
            outcome: Outcome::of(&solution, lcp, tolerance),
            residual: merit::scaled_residual(lcp, &solution.x),
            iterations: solution.iterations,
        };
        Tried { answer, x: solution.x, asked: None, once, again: Box::new(again) }
    }
}

/// The times of those whose answer is accepted, and the names of the others. Rounds are made for so many
/// seconds; a run that is longer than `long` (s) is not repeated.
pub fn clocked(tried: &[Tried], seconds: f64, long: f64) -> (Vec<(String, Time)>, Vec<String>) {
    let (good, bad): (Vec<&Tried>, Vec<&Tried>) =
        tried.iter().partition(|tried| tried.answer.outcome.is_solved());
    let quick = || good.iter().filter(|tried| tried.once <= long);
    let a_round: f64 = quick().map(|tried| tried.once).sum();
    let rounds = ((seconds / a_round) as usize).min(MOST_ROUNDS);
    let mut contenders: Vec<Contender> =
        quick().map(|tried| Contender::new(|| timed(|| (tried.again)()))).collect();
    let mut times = interleaved(rounds, &mut contenders).into_iter();
    let time = |tried: &&Tried| {
        let once = Time { median: tried.once, best: tried.once };
        let time = if tried.once <= long { times.next().unwrap_or(once) } else { once };
        (tried.answer.solver.clone(), time)
    };
    let names = bad.into_iter().map(|tried| tried.answer.solver.clone()).collect();
    (good.iter().map(time).collect(), names)
}
