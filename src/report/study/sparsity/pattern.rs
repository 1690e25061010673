//! J and A of one step, row by row: the chapter's Figure 13.

use serde::{Deserialize, Serialize};

use crate::assembly::Row;
use crate::constraint::Kind;
use crate::error::Result;
use crate::report::study::settings::{AtStep, Given};
use crate::scene::Scene;
use crate::simulation;

/// The matrix A of one scene's step, or of a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Patterns {
    /// The scene or the file.
    pub scene: String,
    /// Its title.
    pub title: String,
    /// The number of the step, from 1; 0 for a problem.
    pub step: usize,
    /// The number of rows.
    pub rows: usize,
    /// Consecutive rows with the same bodies; none for a problem, which has no bodies.
    pub blocks: Vec<Block>,
    /// Row, column and value of A's nonzero entries.
    pub matrix: Vec<(usize, usize, f64)>,
}

/// Consecutive rows with the same bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// The names of the two bodies.
    pub name: String,
    /// The indices of the moving ones.
    pub bodies: Vec<usize>,
    /// For each row, whether it is a friction row.
    pub friction: Vec<bool>,
}

/// The matrix in the last LCP of a scene's step, or of a problem file.
///
/// # Errors
/// If the file cannot be read, or the simulation fails before.
pub fn run(task: &AtStep) -> Result<Patterns> {
    let (given, step, blocks) = match task.problem() {
        Some(given) => (given?, 0, Vec::new()),
        None => {
            let scene = Scene::load(&task.scene)?;
            let problem = simulation::problem_of(&scene, task.step)?;
            let same = |a: &Row, b: &Row| a.bodies == b.bodies;
            let rows = problem.assembly.rows.chunk_by(same);
            let blocks = rows.map(|rows| block(rows, &scene)).collect();
            let (name, title) = (scene.name, scene.title);
            (Given { name, title, lcp: problem.lcp }, task.step, blocks)
        }
    };
    let Given { name, title, lcp } = given;
    let rows = lcp.len();
    let row = |i: usize| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a));
    let matrix = (0..rows).flat_map(row).filter(|(.., a)| *a != 0.0).collect();
    Ok(Patterns { scene: name, title, step, rows, blocks, matrix })
}

fn block(rows: &[Row], scene: &Scene) -> Block {
    let mut bodies: Vec<usize> = rows[0].movers().map(|(body, _)| body).collect();
    bodies.dedup();
    Block {
        name: rows[0].names(scene).join(" – "),
        bodies,
        friction: rows.iter().map(|row| row.kind == Kind::Friction).collect(),
    }
}
