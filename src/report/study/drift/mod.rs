//! Errors of energy and of constraints: over time for decreasing step lengths ([`steps`]), by cause
//! ([`ledger`]), and as a function of the step length if the exact motion is known ([`order`]).

pub mod ledger;
pub mod order;
pub mod steps;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::settings::Timed;
use crate::error::Result;
use crate::scene::Scene;
use ledger::{Account, Run};
use order::{Orders, Problem};
use steps::Levels;

/// Scenes whose errors are measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Scenes run at both levels with decreasing step lengths.
    #[serde(default)]
    pub scenes: Vec<Timed>,
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
    /// A scene at both levels.
    Levels(Levels),
    /// The energy balance of a run.
    Ledger(Account),
    /// The errors of a problem with a closed form.
    Order(order::Finding),
}

/// A task.
enum Task<'a> {
    Levels(&'a Timed),
    Ledger(&'a Run),
    Order(&'a Orders, Problem),
}

impl Plan {
    fn list(&self) -> Vec<Task<'_>> {
        let levels = self.scenes.iter().map(Task::Levels);
        let ledgers = self.ledgers.iter().map(Task::Ledger);
        let orders = self.orders.iter().flat_map(|orders| {
            orders.problems.iter().map(move |&problem| Task::Order(orders, problem))
        });
        levels.chain(ledgers).chain(orders).collect()
    }
}

impl Study for Plan {
    const NAME: &'static str = "drift";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        let name = |task: Task<'_>| match task {
            Task::Levels(timed) => timed.scene.clone(),
            Task::Ledger(run) => format!("ledger of {}", run.name),
            Task::Order(_, problem) => format!("order, {}", problem.scene()),
        };
        self.list().into_iter().map(name).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, ())> {
        let finding = match self.list()[task] {
            Task::Levels(Timed { scene, duration }) => {
                Finding::Levels(steps::run(&Scene::load(scene)?, *duration))
            }
            Task::Ledger(run) => Finding::Ledger(run.audit()?),
            Task::Order(orders, problem) => Finding::Order(orders.run(problem)?),
        };
        Ok((finding, ()))
    }
}
