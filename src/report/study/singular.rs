//! Redundant contacts: what an exact answer costs where A is singular. Stacks of cubes with a contact at
//! each corner, with and without friction (its bounds frozen), as they are and with a little of
//! the mean diagonal added to A, beside clarabel's interior point.
//!
//! Both sides must arrive: a solver's claim is judged, and clarabel is asked for no more than it needs
//! to reach the same scaled residual, 1e-8 of gap and feasibility at first.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::Study;
use super::attempt::{Attempted, Outcome, attempt, entries};
use super::timing::{Contender, Time, interleaved, timed};
use crate::error::{Error, Result};
use crate::lcp::{Lcp, Matrix, library, merit};
use crate::reference::{Reference, box_qp_to};
use crate::solver::{Entry, Options, Settings, Solution, Start, Status};

/// The name of the yardstick.
pub const YARDSTICK: &str = "clarabel";
/// What clarabel is asked for, one after the other, until its residual is as small as ours must be.
const ASKED: [f64; 3] = [1e-8, 1e-10, 1e-12];
/// A run longer than this (s) is not repeated.
const LONG: f64 = 0.1;
/// More rounds say nothing new.
const MOST_ROUNDS: usize = 101;

/// Which stacks and which solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Stacks of so many cubes.
    pub boxes: Vec<usize>,
    /// Coefficients of friction.
    pub friction: Vec<f64>,
    /// Parts of the mean diagonal that are added to the diagonal: 0 leaves A singular.
    pub compliance: Vec<f64>,
    /// The solvers.
    pub solvers: Vec<String>,
    /// The scaled residual asked for.
    pub tolerance: f64,
    /// Seconds to spend on a problem.
    pub seconds: f64,
    /// What is asked of the times: at most so many times clarabel's.
    pub goal: f64,
}

impl Default for Plan {
    fn default() -> Self {
        Plan {
            boxes: vec![5, 10, 20, 50],
            friction: vec![0.0, 0.5],
            compliance: vec![0.0, 1e-8],
            solvers: ["interior-point", "dantzig", "lemke"].map(String::from).to_vec(),
            tolerance: 1e-9,
            seconds: 0.5,
            goal: 2.0,
        }
    }
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
}

/// A stack.
struct Stack {
    boxes: usize,
    friction: f64,
    compliance: f64,
}

impl Plan {
    fn stacks(&self) -> Vec<Stack> {
        let mut stacks = Vec::new();
        for &compliance in &self.compliance {
            for &friction in &self.friction {
                let stack = |&boxes: &usize| Stack { boxes, friction, compliance };
                stacks.extend(self.boxes.iter().map(stack));
            }
        }
        stacks
    }
}

impl Study for Plan {
    const NAME: &'static str = "singular";
    const ALONE: bool = true;
    type Finding = Finding;
    type Times = Times;

    fn tasks(&self) -> Vec<String> {
        self.stacks().iter().map(Stack::name).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, Times)> {
        let stack = self.stacks().swap_remove(task);
        let (problem, lcp) = (stack.name(), stack.lcp()?);
        let settings = Settings { tolerance: self.tolerance, ..Settings::default() };
        let options = Options { settings, ..Options::default() };
        let (asked, yardstick) = by_clarabel(&lcp, self.tolerance)?;
        let entries = entries(&self.solvers)?;
        let ours = entries.iter().map(|entry| by(entry, &lcp, &options));
        let tried: Vec<Tried> = [yardstick].into_iter().chain(ours).collect();
        let (solvers, failed) = self.clocked(&tried);
        let answers = tried.into_iter().map(|tried| tried.answer).collect();
        let rows = lcp.len();
        Ok((
            Finding { problem: problem.clone(), rows, asked, answers },
            Times { problem, rows, solvers, failed },
        ))
    }
}

/// An answer and how to obtain it again.
struct Tried<'a> {
    answer: Answer,
    /// What the first run took (s).
    once: f64,
    again: Box<dyn Fn() + 'a>,
}

impl Plan {
    /// The times of those whose answer is accepted, in turns, and the names of the others.
    fn clocked(&self, tried: &[Tried]) -> (Vec<(String, Time)>, Vec<String>) {
        let (good, bad): (Vec<&Tried>, Vec<&Tried>) =
            tried.iter().partition(|tried| tried.answer.outcome.is_solved());
        let quick = || good.iter().filter(|tried| tried.once <= LONG);
        let a_round: f64 = quick().map(|tried| tried.once).sum();
        let rounds = ((self.seconds / a_round) as usize).min(MOST_ROUNDS);
        let mut contenders: Vec<Contender> =
            quick().map(|tried| Contender::new(|| timed(|| (tried.again)()))).collect();
        let mut times = interleaved(rounds, &mut contenders).into_iter();
        let time = |tried: &&Tried| {
            let once = Time { median: tried.once, best: tried.once };
            let time = if tried.once <= LONG { times.next().unwrap_or(once) } else { once };
            (tried.answer.solver.clone(), time)
        };
        let names = bad.into_iter().map(|tried| tried.answer.solver.clone()).collect();
        (good.iter().map(time).collect(), names)
    }
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
            Error::invalid(Plan::NAME, YARDSTICK, "no quadratic program over a box")
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

impl Stack {
    fn name(&self) -> String {
        let kind = if self.friction > 0.0 { "friction" } else { "stack" };
        let name = format!("{kind} {}", self.boxes);
        if self.compliance > 0.0 { format!("{name}, regularised") } else { name }
    }

    fn lcp(&self) -> Result<Lcp> {
        let given = [("boxes", self.boxes as f64), ("mu", self.friction)];
        let lcp = library::by_name("box-stack")?.generate(&given)?.lcp;
        if self.compliance > 0.0 { softened(&lcp, self.compliance) } else { Ok(lcp) }
    }
}

/// A with this part of its mean diagonal added to the diagonal.
fn softened(lcp: &Lcp, part: f64) -> Result<Lcp> {
    let n = lcp.len();
    let gamma = part * (0..n).map(|i| lcp.matrix().diagonal(i)).sum::<f64>() / n as f64;
    let entries = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let added = (0..n).map(|i| (i, i, gamma));
    let matrix = Matrix::sparse(n, &entries.chain(added).collect::<Vec<_>>());
    Lcp::new(matrix, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec())
}
