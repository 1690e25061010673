//! Where J and A have entries: the chapter's Figure 13.

use serde::{Deserialize, Serialize};

use super::problem_of;
use crate::scene::Scene;

/// The patterns of one scene's matrices in a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Patterns {
    /// The scene.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// The number of the step, from 1.
    pub step: usize,
    /// Rows of J and A.
    pub rows: usize,
    /// Columns of J: velocity components of moving bodies.
    pub columns: usize,
    /// The places (row, column) of J's nonzero entries.
    pub jacobian: Vec<(usize, usize)>,
    /// The places (row, column) of A's nonzero entries.
    pub matrix: Vec<(usize, usize)>,
}

/// The patterns in the last LCP of a step.
pub fn run(scene: &Scene, step: usize) -> Option<Patterns> {
    let problem = problem_of(scene, step)?;
    Some(Patterns {
        scene: scene.name.clone(),
        title: scene.title.clone(),
        step,
        rows: problem.lcp.len(),
        columns: problem.assembly.columns(),
        jacobian: problem.assembly.jacobian_pattern(),
        matrix: problem.lcp.matrix().pattern(),
    })
}
