//! One scene, stepped by every solver, at both levels or by any scheme, each answer judged.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::settings::Stepped;
use crate::error::Result;
use crate::scene::Scene;
use crate::solver::{ALL, Entry, entry};
pub use lcplab_study::comparison::*;

/// Scenes stepped by solvers at both levels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The solvers, by name; all without it.
    #[serde(default = "all_solvers")]
    pub solvers: Vec<String>,
    /// The scenes.
    pub scenes: Vec<Stepped>,
}

/// The names of all registered solvers.
fn all_solvers() -> Vec<String> {
    ALL.iter().map(|entry| entry.name.to_string()).collect()
}

impl Study for Plan {
    const NAME: &'static str = "comparison";
    type Finding = Comparison;
    type Times = Vec<Timing>;

    fn tasks(&self) -> Vec<String> {
        self.scenes.iter().map(|task| task.scene.clone()).collect()
    }

    fn run(&self, task: usize) -> Result<(Comparison, Vec<Timing>)> {
        let task = &self.scenes[task];
        let solvers: Vec<Entry> =
            self.solvers.iter().map(|name| entry(name).copied()).collect::<Result<_>>()?;
        let scene = Scene::load(&task.scene)?;
        let (mut comparison, timings) = compare(&scene, &solvers, task.steps, &|| ());
        comparison.runs.iter_mut().for_each(|run| run.motion = thinned(&run.motion));
        Ok((comparison, timings))
    }
}
