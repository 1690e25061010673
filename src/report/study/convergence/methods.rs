//! Several methods on one problem: the residual by iteration, multiplication and second. Iterations
//! of different methods are not comparable; multiplications nearly are.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use super::watch::Mark;
use super::watch::{self, Posed};
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
    /// Problems of which only the cost is shown, in a table *Which solver for me?*
    #[serde(default)]
    pub choices: Vec<Source>,
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
        self.each(problem, solvers, |entry, posed, options| {
            let (mut method, solution) = watch::run(entry, posed, options);
            let inside = theory::rows_inside(&posed.lcp, &solution.x);
            method.rate = theory::rate(&entry.name, options, &posed.lcp, &inside);
            method
        })
    }

    /// The costs of the methods on a problem: the marks after ten sweeps and at the end.
    ///
    /// # Errors
    /// If the problem or the solver does not exist.
    pub(crate) fn choose(&self, problem: &Source, solvers: &Registry) -> Result<Progress> {
        self.each(problem, solvers, |entry, posed, options| {
            let (mut method, _) = watch::run(entry, posed, options);
            let end = method.marks.last().map_or(0, |mark| mark.iteration);
            method.marks.retain(|mark| mark.iteration == BUDGET || mark.iteration == end);
            method
        })
    }

    fn each(
        &self,
        problem: &Source,
        solvers: &Registry,
        measure: impl Fn(&Entry, &Posed, &Options) -> MethodProgress,
    ) -> Result<Progress> {
        let posed = match problem {
            Source::Stack(stack) => {
                let problem = stack.problem()?;
                Posed { lcp: problem.lcp.clone(), stack: Some(problem) }
            }
            other => Posed { lcp: other.lcp()?, stack: None },
        };
        let settings = Settings::default()
            .with_tolerance(self.tolerance)
            .with_max_iterations(self.max_iterations);
        let options = Options::default().with_settings(settings).with_omega(self.omega);
        let runs = methods::entries(&self.solvers, solvers)?;
        Ok(Progress {
            problem: problem.name(),
            rows: posed.lcp.len(),
            stored: posed.lcp.matrix().stored(),
            omega: self.omega,
            tolerance: self.tolerance,
            methods: runs.iter().map(|entry| measure(entry, &posed, &options)).collect(),
        })
    }
}
