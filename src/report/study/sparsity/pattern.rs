//! The patterns of J and A: the chapter's Figure 13.

use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::report::study::settings::{AtStep, Given};
use crate::scene::Scene;
use crate::simulation;

/// The patterns of one scene's matrices in a step, or of a problem's A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Patterns {
    /// The scene or the file.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// The number of the step, from 1; 0 for a problem.
    pub step: usize,
    /// The number of rows of J and A.
    pub rows: usize,
    /// The number of columns of J: velocity components of moving bodies; 0 for a problem, which has
    /// no J.
    pub columns: usize,
    /// The positions (row, column) of J's nonzero entries.
    pub jacobian: Vec<(usize, usize)>,
    /// The positions (row, column) of A's nonzero entries.
    pub matrix: Vec<(usize, usize)>,
}

/// The pattern of a problem.
fn of_problem(Given { name, title, lcp }: Given) -> Patterns {
    let (rows, matrix) = (lcp.len(), lcp.matrix().pattern());
    Patterns { scene: name, title, step: 0, rows, columns: 0, jacobian: Vec::new(), matrix }
}

/// The patterns in the last LCP of a scene's step, or of a problem file.
///
/// # Errors
/// If the file cannot be read, or the simulation fails before.
pub fn run(task: &AtStep) -> Result<Patterns> {
    if let Some(problem) = task.problem() {
        return Ok(of_problem(problem?));
    }
    let scene = Scene::load(&task.scene)?;
    let problem = simulation::problem_of(&scene, task.step)?;
    Ok(Patterns {
        scene: scene.name,
        title: scene.title,
        step: task.step,
        rows: problem.lcp.len(),
        columns: problem.assembly.columns(),
        jacobian: problem.assembly.jacobian_pattern(),
        matrix: problem.lcp.matrix().pattern(),
    })
}
