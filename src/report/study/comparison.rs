//! One scene, stepped by every solver at both levels or with any scheme; each answer is judged.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Table;

use super::Study;
use super::variation::Variation;
use crate::error::Result;
use crate::scene::Scheme;
use crate::solver::{Entry, Registry};
pub use lcplab_analysis::comparison::*;

/// Scenes stepped by solvers at both levels, or with other schemes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The solvers, by name; by default all.
    #[serde(default = "all_solvers")]
    pub solvers: Vec<String>,
    /// The schemes; by default velocity and acceleration level.
    #[serde(default = "both_levels")]
    pub schemes: Vec<Scheme>,
    /// The scenes.
    pub scenes: Vec<Case>,
}

/// A scene and its number of steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// A shipped scene or a file.
    pub scene: String,
    /// Overridden fields of the scene.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub change: Table,
    /// The number of steps.
    pub steps: usize,
}

/// The names of all registered solvers.
fn all_solvers() -> Vec<String> {
    Registry::standard().entries().map(|entry| entry.name.to_string()).collect()
}

/// Velocity and acceleration level.
fn both_levels() -> Vec<Scheme> {
    Scheme::LEVELS.to_vec()
}

impl Study for Plan {
    const NAME: &'static str = "comparison";
    type Finding = Comparison;
    type Times = Vec<Timing>;

    fn tasks(&self) -> Vec<String> {
        self.scenes.iter().map(|task| task.scene.clone()).collect()
    }

    fn run(&self, task: usize, solvers: &Registry) -> Result<(Comparison, Vec<Timing>)> {
        let task = &self.scenes[task];
        let solvers: Vec<Entry> =
            self.solvers.iter().map(|name| solvers.entry(name).cloned()).collect::<Result<_>>()?;
        let scene = Variation::of(&task.scene, &task.change).scene()?;
        let (mut comparison, timings) =
            compare(&scene, &self.schemes, &solvers, task.steps, &|| ());
        comparison.runs.iter_mut().for_each(|run| run.motion = thinned(&run.motion));
        Ok((comparison, timings))
    }
}
