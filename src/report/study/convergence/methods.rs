//! Several methods on one problem: the residual by iteration, multiplication and second. Iterations
//! of different methods are not comparable; multiplications nearly are.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::watch;
pub use super::watch::Mark;
use crate::error::Result;
use crate::report::methods;
use crate::report::study::posed::Source;
use crate::report::study::trial::Outcome;
use crate::solver::{Entry, Options, Registry, Settings, theory};

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
    /// The factor per sweep that theory predicts while the active set is the last one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate: Option<f64>,
}

impl MethodProgress {
    /// The mark after ten sweeps, a typical budget of an engine.
    pub fn ten(&self) -> Option<&Mark> {
        self.marks.iter().find(|mark| mark.iteration == BUDGET)
    }
}

/// The number of sweeps that engines typically take.
pub const BUDGET: usize = 10;

impl Methods {
    /// Runs the methods on a problem, with the rates that theory predicts.
    ///
    /// # Errors
    /// If the problem or the solver does not exist.
    pub(crate) fn run(&self, problem: &Source, solvers: &Registry) -> Result<Progress> {
        let posed = problem.posed()?;
        let settings = Settings::default()
            .with_tolerance(self.tolerance)
            .with_max_iterations(self.max_iterations);
        let options = Options::default().with_settings(settings).with_omega(self.omega);
        let measure = |entry: &Entry| {
            let (mut method, solution) = watch::run(entry, &posed, &options);
            let inside = theory::rows_inside(&posed.lcp, &solution.x);
            method.rate = theory::rate(&entry.name, &options, &posed.lcp, &inside);
            method
        };
        let runs = methods::entries(&self.solvers, solvers)?;
        Ok(Progress {
            problem: problem.name(),
            rows: posed.lcp.len(),
            stored: posed.lcp.matrix().stored(),
            omega: self.omega,
            tolerance: self.tolerance,
            methods: runs.iter().map(measure).collect(),
        })
    }
}
