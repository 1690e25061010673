//! Recorded times of solvers on problems of several sizes, mass ratios and friction.
//!
//! Nothing is timed here, so a report is the same in every run. The benchmarks write the record
//! (`cargo run --release -p lcplab-benches -- solver-times`).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::posed::Source;
use crate::error::{Error, Result};
use crate::solver::Registry;

/// The record that lcplab ships.
const SHIPPED: &str = include_str!("../../../reports/solver_times.json");

/// The relative difference up to which two times count as equal.
pub const NOISE: f64 = 0.05;

/// Shows the shipped record.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {}

/// The times of all solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The day, year-month-day.
    pub date: String,
    /// The processor, of which one thread is used.
    pub processor: String,
    /// The required scaled residual.
    pub tolerance: f64,
    /// The maximum number of iterations.
    pub max_iterations: usize,
    /// ω of SOR.
    pub omega: f64,
    /// The problems.
    pub problems: Vec<TimedProblem>,
    /// What each solver solves of the frames recorded from engines, under coupled boxes.
    pub frames: Frames,
}

/// Recorded frames, whose contacts rest, slide and separate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Frames {
    /// The number of frames.
    pub all: usize,
    /// The maximum number of iterations.
    pub max_iterations: usize,
    /// Each solver and the number of frames that it solves.
    pub solved: Vec<(String, usize)>,
}

impl Frames {
    /// The number of frames that a solver solves.
    pub fn solved_by(&self, solver: &str) -> Option<usize> {
        self.solved.iter().find(|own| own.0 == solver).map(|own| own.1)
    }
}

/// A problem, solved by all solvers from x = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TimedProblem {
    /// The problem.
    pub problem: Source,
    /// The number of rows.
    pub rows: usize,
    /// The number of stored entries of A; rows², if A is stored as dense.
    pub stored: usize,
    /// Ten sweeps of PGS.
    pub ten_sweeps: TenSweeps,
    /// The solvers.
    pub solvers: Vec<SolverTime>,
}

/// Ten sweeps of PGS, a typical budget of engines.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TenSweeps {
    /// Their time (s).
    pub seconds: f64,
    /// The fraction of the weight that they leave unsupported, if the problem is that of a stack.
    pub unsupported: Option<f64>,
}

/// The time of a solver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SolverTime {
    /// The solver.
    pub solver: String,
    /// The number of sweeps, steps or pivots.
    pub iterations: usize,
    /// The time of a solve (s), the best of all rounds; `None` if the judge did not accept the
    /// answer.
    pub seconds: Option<f64>,
}

/// A solver that solves every problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recommended<'a> {
    /// The solver.
    pub solver: &'a str,
    /// Where it is slowest beside another one.
    pub worst: Worst<'a>,
}

/// A problem on which another solver is faster by most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst<'a> {
    /// The problem.
    pub problem: &'a TimedProblem,
    /// The fastest solver.
    pub rival: &'a str,
    /// The factor of its time.
    pub factor: f64,
}

impl TimedProblem {
    /// Whether A is stored as dense.
    pub fn is_dense(&self) -> bool {
        self.stored == self.rows * self.rows
    }

    /// The time of a solver (s), if its answer was accepted.
    pub fn seconds(&self, solver: &str) -> Option<f64> {
        self.solvers.iter().find(|own| own.solver == solver)?.seconds
    }

    /// The fastest solver and its time (s). Differences up to [`NOISE`] are not measurable, so
    /// `preferred` is the fastest if its time is within it.
    pub fn fastest_or(&self, preferred: &str) -> Option<(&str, f64)> {
        let (solver, seconds) = self.fastest()?;
        let own = self.solvers.iter().find(|own| own.solver == preferred);
        let own = own.and_then(|own| Some((&*own.solver, own.seconds?)));
        Some(own.filter(|own| own.1 <= (1.0 + NOISE) * seconds).unwrap_or((solver, seconds)))
    }

    /// The fastest solver and its time (s).
    fn fastest(&self) -> Option<(&str, f64)> {
        let solved = self.solvers.iter().filter_map(|own| Some((&*own.solver, own.seconds?)));
        solved.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Record {
    /// The shipped record.
    ///
    /// ```
    /// let record = lcplab::report::study::solver_times::Record::shipped()?;
    /// let recommended = record.recommended().expect("a solver that solves all problems");
    /// assert_eq!(recommended.solver, "block-pivoting");
    /// assert!(record.that_solve_all().all(|solver| solver != "pgs")); // it needs too many sweeps
    /// assert!(recommended.worst.factor < 5.0); // of the fastest solver's time, on any problem
    /// # Ok::<(), lcplab::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the file was damaged.
    pub fn shipped() -> Result<Record> {
        let wrong = |cause: serde_json::Error| {
            Error::invalid("solver_times.json", "record", cause.to_string())
        };
        serde_json::from_str(SHIPPED).map_err(wrong)
    }

    /// The solvers that solve every problem.
    pub fn that_solve_all(&self) -> impl Iterator<Item = &str> {
        let solvers = self.problems.first().map_or(&[][..], |own| &own.solvers);
        let names = solvers.iter().map(|own| own.solver.as_str());
        names.filter(|solver| self.problems.iter().all(|own| own.seconds(solver).is_some()))
    }

    /// The solver that solves every problem, with the least factor of the fastest solver's time on
    /// its worst problem.
    pub fn recommended(&self) -> Option<Recommended<'_>> {
        let worst = |solver: &str| {
            let factors = self.problems.iter().filter_map(|problem| {
                let (rival, seconds) = problem.fastest()?;
                Some(Worst { problem, rival, factor: problem.seconds(solver)? / seconds })
            });
            factors.max_by(|a, b| a.factor.total_cmp(&b.factor))
        };
        let all = self
            .that_solve_all()
            .filter_map(|solver| Some(Recommended { solver, worst: worst(solver)? }));
        all.min_by(|a, b| a.worst.factor.total_cmp(&b.worst.factor))
    }
}

impl Study for Plan {
    const NAME: &'static str = "solver-times";
    type Finding = Record;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec!["record".into()]
    }

    fn run(&self, _task: usize, _: &Registry) -> Result<(Record, ())> {
        Ok((Record::shipped()?, ()))
    }
}
