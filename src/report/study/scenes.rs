//! Scenes as stored in their files, each as an animation with what it teaches.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Table;

use super::Study;
use super::animation::AnimationData;
use super::tally::Tally;
use super::variation::Variation;
use crate::animation::Recording;
use crate::error::Result;
use crate::scene::Scene;
use crate::simulation::Simulation;
use crate::solver::{Registry, Stop};

/// The scenes to show.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Shipped scenes or files.
    pub scenes: Vec<String>,
}

/// A scene with its motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Its title.
    pub title: String,
    /// What it teaches.
    pub teaches: String,
    /// Its motion.
    pub animation: AnimationData,
    /// The judge's verdicts on the answers of every step.
    pub tally: Tally,
}

/// The number of instants of an animation, and for a scene with more bodies than [`MANY`].
const INSTANTS: [usize; 2] = [31, 11];
const MANY: usize = 50;

impl Study for Plan {
    const NAME: &'static str = "scenes";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.scenes.clone()
    }

    fn run(&self, task: usize, _: &Registry) -> Result<(Finding, ())> {
        let name = &self.scenes[task];
        let scene = Scene::load(name)?;
        let instants = INSTANTS[usize::from(scene.bodies.len() > MANY)];
        let (mut simulation, mut tally) = (Simulation::of(&scene)?, Tally::default());
        let counts = [scene.step.count, instants];
        let recording =
            Recording::until(&Stop::default(), "as shipped", &mut simulation, counts, |step| {
                tally.add_step(step, scene.solver.tolerance, |_, _| ());
            });
        let animation =
            AnimationData::of(&scene.name, Variation::of(name, &Table::new()), &[recording]);
        Ok((Finding { title: scene.title, teaches: scene.teaches, animation, tally }, ()))
    }
}
