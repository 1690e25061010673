//! Several methods on one problem: the residual by iteration, multiplication and second. Iterations
//! of different methods are not comparable; multiplications nearly are.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::watch;
pub use super::watch::Mark;
use crate::error::Result;
use crate::report::study::attempt::{Outcome, entries};
use crate::report::study::posed::Source;
use crate::solver::{Options, Settings};

/// The problems and solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Methods {
    /// The problems.
    pub problems: Vec<Source>,
    /// The solvers; by default all.
    #[serde(default)]
    pub solvers: Vec<String>,
    /// The required scaled residual.
    #[serde(default = "target")]
    pub tolerance: f64,
    /// ω of SOR.
    #[serde(default = "relaxed")]
    pub omega: f64,
    /// The maximum number of sweeps, steps or pivots.
    #[serde(default = "limit")]
    pub max_iterations: usize,
}

fn target() -> f64 {
    1e-10
}

fn relaxed() -> f64 {
    1.7
}

fn limit() -> usize {
    100_000
}

/// The progress of all methods on a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// The problem.
    pub problem: String,
    /// Its number of rows.
    pub rows: usize,
    /// Stored entries of A.
    pub stored: usize,
    /// ω of SOR.
    pub omega: f64,
    /// The required scaled residual.
    pub tolerance: f64,
    /// The progress of each solver.
    pub methods: Vec<MethodProgress>,
}

/// The progress of one method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MethodProgress {
    /// The solver.
    pub solver: String,
    /// Its outcome.
    pub outcome: Outcome,
    /// Selected iterations, including the last; for pivoting methods only the last.
    pub marks: Vec<Mark>,
}

/// The time at each mark.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// The problem.
    pub problem: String,
    /// For each solver: its name, and (s, scaled residual) at each mark.
    pub methods: Vec<(String, Vec<(f64, f64)>)>,
}

impl Methods {
    /// Runs the methods on a problem.
    ///
    /// # Errors
    /// If the problem or the solver does not exist.
    pub fn run(&self, problem: &Source) -> Result<(Progress, Clock)> {
        let lcp = problem.lcp()?;
        let settings = Settings {
            tolerance: self.tolerance,
            max_iterations: self.max_iterations,
            ..Settings::default()
        };
        let options = Options { settings, omega: self.omega, ..Options::default() };
        let runs = entries(&self.solvers)?;
        let (methods, clock) = runs.iter().map(|entry| watch::run(entry, &lcp, &options)).unzip();
        let progress = Progress {
            problem: problem.name(),
            rows: lcp.len(),
            stored: lcp.matrix().stored(),
            omega: self.omega,
            tolerance: self.tolerance,
            methods,
        };
        Ok((progress, Clock { problem: problem.name(), methods: clock }))
    }
}
