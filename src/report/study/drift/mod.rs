//! Errors of energy and of constraints: over many periods by integrator ([`long`]), by cause
//! ([`ledger`]), and as a function of the step length if the exact motion is known ([`order`]).

pub mod ledger;
pub mod long;
pub mod order;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::error::Result;
use crate::solver::Registry;
use ledger::{Account, Run};
use long::{LongRun, Periodic};
use order::{Orders, Problem};

/// Scenes whose errors are measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Scenes that are run for many periods by several integrators.
    #[serde(default)]
    pub scenes: Vec<Periodic>,
    /// Runs whose changes of energy are accounted for.
    #[serde(default)]
    pub ledgers: Vec<Run>,
    /// Problems with closed forms, with every scheme.
    #[serde(default)]
    pub orders: Option<Orders>,
}

/// The finding of a task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Finding {
    /// A scene over many periods.
    Long(LongRun),
    /// The energy balance of a run.
    Ledger(Account),
    /// The errors of a problem with a closed form.
    Order(order::Finding),
}

/// A task.
enum Task<'a> {
    Long(&'a Periodic),
    Ledger(&'a Run),
    Order(&'a Orders, Problem),
}

impl Plan {
    fn list(&self) -> Vec<Task<'_>> {
        let long = self.scenes.iter().map(Task::Long);
        let ledgers = self.ledgers.iter().map(Task::Ledger);
        let orders = self.orders.iter().flat_map(|orders| {
            orders.problems.iter().map(move |&problem| Task::Order(orders, problem))
        });
        long.chain(ledgers).chain(orders).collect()
    }
}

impl Study for Plan {
    const NAME: &'static str = "drift";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        let name = |task: Task<'_>| match task {
            Task::Long(periodic) => periodic.scene.clone(),
            Task::Ledger(run) => format!("ledger of {}", run.name),
            Task::Order(_, problem) => format!("order, {}", problem.scene()),
        };
        self.list().into_iter().map(name).collect()
    }

    fn run(&self, task: usize, solvers: &Registry) -> Result<(Finding, ())> {
        let finding = match self.list()[task] {
            Task::Long(periodic) => Finding::Long(periodic.run(solvers)?),
            Task::Ledger(run) => Finding::Ledger(run.audit(solvers)?),
            Task::Order(orders, problem) => Finding::Order(orders.run(problem)?),
        };
        Ok((finding, ()))
    }
}
