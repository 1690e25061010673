//! Convergence of the residual: sweep by sweep compared with the theoretical rate ([`sweeps`]), by
//! iteration, multiplication and second for several methods ([`methods`]), and row by row
//! ([`rows`]).

pub mod methods;
pub mod rows;
pub mod sweeps;
mod watch;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::posed::Source;
use crate::error::Result;
use crate::solver::Registry;
use methods::{Methods, Progress};
use rows::{RowResiduals, Rows, Sweep};
use sweeps::{Rates, SweepCase};

/// LCPs whose iterative solution is recorded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// LCPs solved by PGS and SOR.
    #[serde(default)]
    pub scenes: Vec<SweepCase>,
    /// LCPs solved by several methods.
    #[serde(default)]
    pub methods: Option<Methods>,
    /// A column of bodies whose rows are recorded individually.
    #[serde(default)]
    pub rows: Option<Rows>,
}

/// The finding of a task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Finding {
    /// The convergence rates of sweeps.
    Sweeps(Rates),
    /// The progress of several methods.
    Methods(Progress),
    /// The residuals of all rows.
    Rows(RowResiduals),
}

/// A task.
enum Task<'a> {
    Sweeps(&'a SweepCase),
    Methods(&'a Methods, &'a Source),
    Rows(&'a Rows, Sweep),
}

impl Plan {
    fn list(&self) -> Vec<Task<'_>> {
        let sweeps = self.scenes.iter().map(Task::Sweeps);
        let methods = self.methods.iter().flat_map(|methods| {
            methods.problems.iter().map(move |problem| Task::Methods(methods, problem))
        });
        let rows = self
            .rows
            .iter()
            .flat_map(|rows| rows.methods.iter().map(move |&sweep| Task::Rows(rows, sweep)));
        sweeps.chain(methods).chain(rows).collect()
    }
}

impl Study for Plan {
    const NAME: &'static str = "convergence";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        let name = |task: Task<'_>| match task {
            Task::Sweeps(swept) => swept.scene.clone(),
            Task::Methods(_, problem) => problem.name(),
            Task::Rows(_, sweep) => sweep.name().to_string(),
        };
        self.list().into_iter().map(name).collect()
    }

    fn run(&self, task: usize, solvers: &Registry) -> Result<(Finding, ())> {
        let finding = match self.list()[task] {
            Task::Sweeps(swept) => Finding::Sweeps(swept.run()?),
            Task::Methods(methods, problem) => Finding::Methods(methods.run(problem, solvers)?),
            Task::Rows(rows, sweep) => Finding::Rows(rows.run(sweep)?),
        };
        Ok((finding, ()))
    }
}
