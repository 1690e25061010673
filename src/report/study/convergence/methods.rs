//! Several methods on one problem: how the residual falls by iteration, by multiplication and by
//! second. An iteration of one method is not one of another; a multiplication nearly is.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::watch;
pub use super::watch::Mark;
use crate::error::Result;
use crate::report::study::attempt::{Outcome, entries};
use crate::report::study::posed::Source;
use crate::solver::{Options, Settings};

/// Which problems and which solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Methods {
    /// The problems.
    pub problems: Vec<Source>,
    /// The solvers; all without it.
    #[serde(default)]
    pub solvers: Vec<String>,
    /// The scaled residual asked for.
    #[serde(default = "target")]
    pub tolerance: f64,
    /// ω of SOR.
    #[serde(default = "relaxed")]
    pub omega: f64,
    /// More sweeps, steps or pivots are not made.
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
    /// Its rows.
    pub rows: usize,
    /// Stored entries of A.
    pub stored: usize,
    /// ω of SOR.
    pub omega: f64,
    /// The scaled residual asked for.
    pub tolerance: f64,
    /// By solver.
    pub methods: Vec<Watched>,
}

/// The progress of one method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Watched {
    /// The solver.
    pub solver: String,
    /// What came of it.
    pub outcome: Outcome,
    /// Now and then, the end included; of pivoting methods the end alone.
    pub marks: Vec<Mark>,
}

/// The time at each mark.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// The problem.
    pub problem: String,
    /// By solver: its name, and (s, scaled residual) at each mark.
    pub methods: Vec<(String, Vec<(f64, f64)>)>,
}

impl Methods {
    /// Runs the methods on a problem.
    ///
    /// # Errors
    /// If there is no such problem or no such solver.
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
