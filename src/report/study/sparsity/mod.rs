//! Patterns of the matrices of scenes: J and A in one step ([`pattern`]), and the factor of A with
//! three orderings ([`factor`]).

pub mod factor;
pub mod pattern;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::settings::AtStep;
use crate::error::Result;
use crate::formulation::Problem;
use crate::scene::{Scene, Scheme};
use crate::simulation::{self, Simulation};
use crate::solver::{self, Pgs, Registry};
use factor::Factor;
use pattern::Patterns;

/// The matrices to draw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// LCPs whose J and A are drawn.
    #[serde(default)]
    pub scenes: Vec<AtStep>,
    /// LCPs whose A is factorized with three orderings.
    #[serde(default)]
    pub factors: Vec<AtStep>,
}

/// The finding of a task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Finding {
    /// J and A of one step.
    Patterns(Patterns),
    /// The factor of A.
    Factor(Factor),
}

/// A task.
enum Task<'a> {
    Patterns(&'a AtStep),
    Factor(&'a AtStep),
}

impl Plan {
    fn list(&self) -> Vec<Task<'_>> {
        let patterns = self.scenes.iter().map(Task::Patterns);
        patterns.chain(self.factors.iter().map(Task::Factor)).collect()
    }
}

impl Study for Plan {
    const NAME: &'static str = "sparsity";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        let name = |task: Task<'_>| match task {
            Task::Patterns(at) => at.scene.clone(),
            Task::Factor(at) => format!("factor of {}", at.scene),
        };
        self.list().into_iter().map(name).collect()
    }

    fn run(&self, task: usize, _: &Registry) -> Result<(Finding, ())> {
        let finding = match self.list()[task] {
            Task::Patterns(at) => Finding::Patterns(pattern::run(at)?),
            Task::Factor(at) => Finding::Factor(factor::run(at)?),
        };
        Ok((finding, ()))
    }
}

/// The problem of a scene's step; `None` if the step has none. That of the first step needs no
/// solution, so its solver stops after one sweep.
fn problem(task: &AtStep) -> Result<Option<Problem>> {
    let mut scene = Scene::load(&task.scene)?;
    if !scene.step.scheme.solves_lcps() {
        scene = scene.at_level(Scheme::Velocity);
    }
    if task.step > 1 {
        return simulation::problem_of(&scene, task.step).map(Some);
    }
    let settings = solver::Settings::default().with_max_iterations(1);
    let solver = Box::new(Pgs { settings, ..Pgs::default() });
    let step = Simulation::new(scene, solver).step().ok();
    Ok(step.and_then(|mut step| step.solves.pop()).map(|solve| solve.problem))
}
