//! Where J and A have entries: the chapter's Figure 13.

use crate::simulation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::settings::{AtStep, Given};
use crate::error::Result;
use crate::scene::Scene;

/// Matrices to be drawn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The LCPs.
    pub scenes: Vec<AtStep>,
}

impl Study for Plan {
    const NAME: &'static str = "sparsity";
    type Finding = Patterns;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.scenes.iter().map(|task| task.scene.clone()).collect()
    }

    fn run(&self, task: usize) -> Result<(Self::Finding, ())> {
        let task = &self.scenes[task];
        if let Some(problem) = task.problem() {
            return Ok((of_problem(problem?), ()));
        }
        Ok((run(&Scene::load(&task.scene)?, task.step)?, ()))
    }
}

/// The patterns of one scene's matrices in a step, or of a problem's A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Patterns {
    /// The scene or the file.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// The number of the step, from 1; 0 of a problem.
    pub step: usize,
    /// Rows of J and A.
    pub rows: usize,
    /// Columns of J: velocity components of moving bodies; 0 of a problem, which has no J.
    pub columns: usize,
    /// The places (row, column) of J's nonzero entries.
    pub jacobian: Vec<(usize, usize)>,
    /// The places (row, column) of A's nonzero entries.
    pub matrix: Vec<(usize, usize)>,
}

/// The pattern of a problem.
fn of_problem(Given { name, title, lcp }: Given) -> Patterns {
    let (rows, matrix) = (lcp.len(), lcp.matrix().pattern());
    Patterns { scene: name, title, step: 0, rows, columns: 0, jacobian: Vec::new(), matrix }
}

/// The patterns in the last LCP of a step.
///
/// # Errors
/// If the simulation fails before.
pub fn run(scene: &Scene, step: usize) -> Result<Patterns> {
    let problem = simulation::problem_of(scene, step)?;
    Ok(Patterns {
        scene: scene.name.clone(),
        title: scene.title.clone(),
        step,
        rows: problem.lcp.len(),
        columns: problem.assembly.columns(),
        jacobian: problem.assembly.jacobian_pattern(),
        matrix: problem.lcp.matrix().pattern(),
    })
}
