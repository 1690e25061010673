//! The way of a force through a column and along a chain: what sweeps have handed on when they end,
//! beside the weight that each contact and each joint must carry.
//!
//! ```text
//! column of n balls      contact k carries the weight of balls k … n
//! two balls, ratio r     k sweeps from 0 leave the part (r/(1 + r))^k of both impulses out
//! chain with a ball      joint k pulls with the weight of the ball and the links k … n
//! ```
//!
//! Every solve is the first step's, from 0: nothing is known of an earlier one.

use crate::simulation::Simulation;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::assembly::Source;
use crate::constraint::Kind;
use crate::error::{Error, Result};
use crate::formulation::Stage;
use crate::scene::description::{Body, Description, Shape};
use crate::scene::{Scene, Scheme};
use crate::simulation::{Solve, Step};

/// Columns and a chain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Balls in a column.
    pub bodies: usize,
    /// The mass of its top ball, in masses of the others; a column and a pair of balls each.
    pub ratios: Vec<f64>,
    /// Numbers of sweeps of PGS.
    pub sweeps: Vec<usize>,
    /// A scene with joints in a line, from the world to what they carry; none is left out.
    #[serde(default)]
    pub chain: Option<Chain>,
}

/// A hanging chain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Chain {
    /// A shipped scene or a file.
    pub scene: String,
    /// Numbers of sweeps of PGS.
    pub sweeps: Vec<usize>,
}

/// A line of contacts or joints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// What it is.
    pub line: Line,
    /// The force (N) that each contact, from the ground up, or joint, from the top down, must carry.
    pub expected: Vec<f64>,
    /// What it carries, by solver.
    pub paths: Vec<Path>,
}

/// What carries what.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Line {
    /// Balls on each other, the top one so many times as heavy as the others.
    Column {
        /// How many.
        bodies: usize,
        /// The mass of the top one.
        ratio: f64,
    },
    /// A scene's joints.
    Chain {
        /// Its title.
        title: String,
    },
}

/// The forces that a solver found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// The solver, with its sweeps.
    pub name: String,
    /// Sweeps of PGS; `None` for the direct solver.
    pub sweeps: Option<usize>,
    /// The forces (N).
    pub forces: Vec<f64>,
}

impl Finding {
    /// The largest part of its load that a contact or joint does not carry, or carries too much.
    pub fn left_out(&self, path: &Path) -> f64 {
        let pairs = path.forces.iter().zip(&self.expected);
        pairs.map(|(force, load)| (force - load).abs() / load).fold(0.0, f64::max)
    }

    /// What theory says of that, if this is a pair of balls.
    pub fn predicted(&self, path: &Path) -> Option<f64> {
        match (&self.line, path.sweeps) {
            (Line::Column { bodies: 2, ratio }, Some(k)) => {
                Some((ratio / (1.0 + ratio)).powi(k as i32))
            }
            _ => None,
        }
    }
}

/// The force (N) with which fixed bodies carry the others.
pub(super) fn ground_force(scene: &Scene, step: &Step) -> f64 {
    let fixed = |body: Option<usize>| body.is_none_or(|k| scene.bodies[k].mass.mass() == 0.0);
    normal_forces(scene, step, |bodies| bodies.into_iter().any(fixed))
}

/// The sum of the normal forces (N) between some pairs of bodies in a step.
fn normal_forces(scene: &Scene, step: &Step, between: impl Fn([Option<usize>; 2]) -> bool) -> f64 {
    let Some(solve) = deciding(step) else { return 0.0 };
    let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
    let chosen = rows.filter(|(row, _)| row.kind == Kind::Normal && between(row.bodies));
    chosen.map(|(_, x)| x).sum::<f64>() * per_unit(scene, solve)
}

/// The last solve of a step that decides forces.
fn deciding(step: &Step) -> Option<&Solve> {
    step.solves.iter().rev().find(|solve| solve.problem.stage != Stage::Position)
}

/// What an x of 1 is as a force (N).
fn per_unit(scene: &Scene, solve: &Solve) -> f64 {
    if solve.problem.stage == Stage::Acceleration { 1.0 } else { 1.0 / scene.step.dt }
}

/// Balls of 1 kg on each other, the top one r kg, without friction.
fn column(bodies: usize, ratio: f64) -> Result<Scene> {
    let mut column = Description::default();
    column.bodies.push(Body {
        name: "ground".into(),
        shape: Shape::Plane([0.0, 0.0, 1.0]),
        fixed: true,
        ..Body::default()
    });
    column.bodies.extend((1..=bodies).map(|k| Body {
        name: format!("ball {k}"),
        shape: Shape::Sphere(0.5),
        mass: Some(if k == bodies { ratio } else { 1.0 }),
        position: [0.0, 0.0, k as f64 - 0.5],
        ..Body::default()
    }));
    column.step.scheme = Scheme::Velocity;
    Scene::new("column", &column)
}

/// The first step by this solver.
fn first_step(scene: &Scene, solver: &str, sweeps: Option<usize>) -> Result<Step> {
    let mut scene = scene.clone();
    scene.solver.name = solver.into();
    scene.solver.max_iterations = sweeps.unwrap_or(scene.solver.max_iterations);
    let step = Simulation::of(&scene)?.step();
    step.map_err(|failure| Error::invalid(&scene.name, "first step", failure.to_string()))
}

/// The direct solver and PGS with these sweeps; `forces` reads a step.
fn paths(
    scene: &Scene,
    sweeps: &[usize],
    forces: impl Fn(&Step) -> Vec<f64> + Sync,
) -> Result<Vec<Path>> {
    let direct = [("dantzig", None)].into_iter();
    let all: Vec<_> = direct.chain(sweeps.iter().map(|&k| ("pgs", Some(k)))).collect();
    let path = |&(solver, sweeps): &(&str, Option<usize>)| {
        let name = match sweeps {
            Some(1) => format!("{solver}, 1 sweep"),
            Some(k) => format!("{solver}, {k} sweeps"),
            None => solver.to_string(),
        };
        Ok(Path { name, sweeps, forces: forces(&first_step(scene, solver, sweeps)?) })
    };
    all.par_iter().map(path).collect()
}

fn column_path(bodies: usize, ratio: f64, sweeps: &[usize]) -> Result<Finding> {
    let scene = column(bodies, ratio)?;
    let g = scene.gravity.norm();
    let weight = |k: usize| g * scene.bodies[k].mass.mass();
    let expected = (1..=bodies).map(|k| (k..=bodies).map(weight).sum()).collect();
    let under = |step: &Step, k: usize| {
        normal_forces(&scene, step, |bodies| bodies.into_iter().flatten().max() == Some(k))
    };
    let forces = |step: &Step| (1..=bodies).map(|k| under(step, k)).collect();
    let paths = paths(&scene, sweeps, forces)?;
    Ok(Finding { line: Line::Column { bodies, ratio }, expected, paths })
}

fn chain_path(chain: &Chain) -> Result<Finding> {
    let mut scene = Scene::load(&chain.scene)?;
    scene.step.scheme = Scheme::Velocity;
    let (g, joints) = (scene.gravity.norm(), in_line(&scene));
    // A joint carries the body that it ends in, and all after it.
    let carried = |k: usize| {
        let ends = joints[k..].iter().filter_map(|&j| scene.constraints[j].bodies()[1]);
        g * ends.map(|body| scene.bodies[body].mass.mass()).sum::<f64>()
    };
    let expected = (0..joints.len()).map(carried).collect();
    let forces = |step: &Step| joints.iter().map(|&k| joint_force(&scene, step, k)).collect();
    let paths = paths(&scene, &chain.sweeps, forces)?;
    Ok(Finding { line: Line::Chain { title: scene.title.clone() }, expected, paths })
}

/// The joints from the world on, each from the body in which the one before it ends.
fn in_line(scene: &Scene) -> Vec<usize> {
    let from = |body: Option<usize>| {
        let joints = scene.constraints.iter().enumerate();
        joints.map(|(k, joint)| (k, joint.bodies())).find(|(_, bodies)| bodies[0] == body)
    };
    let mut line = Vec::new();
    let mut next = from(None);
    while let Some((joint, bodies)) = next.filter(|(joint, _)| !line.contains(joint)) {
        line.push(joint);
        next = bodies[1].and_then(|body| from(Some(body)));
    }
    line
}

/// The force (N) of a constraint.
fn joint_force(scene: &Scene, step: &Step, constraint: usize) -> f64 {
    let Some(solve) = deciding(step) else { return f64::NAN };
    let rows = solve.problem.assembly.rows.iter().zip(&solve.solution.x);
    let own = rows.filter(|(row, _)| row.id.source == Source::Constraint(constraint));
    own.map(|(_, x)| x * x).sum::<f64>().sqrt() * per_unit(scene, solve)
}

impl Study for Plan {
    const NAME: &'static str = "force-path";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        let columns = self.ratios.iter().map(|r| format!("column, ratio {r}"));
        let pairs = self.ratios.iter().map(|r| format!("pair, ratio {r}"));
        let chain = self.chain.iter().map(|chain| format!("chain {}", chain.scene));
        columns.chain(pairs).chain(chain).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, ())> {
        let (ratios, count) = (&self.ratios, self.ratios.len());
        let finding = match (&self.chain, task) {
            (_, k) if k < count => column_path(self.bodies, ratios[k], &self.sweeps)?,
            (_, k) if k < 2 * count => column_path(2, ratios[k - count], &self.sweeps)?,
            (Some(chain), _) => chain_path(chain)?,
            (None, _) => return Err(Error::invalid("force-path", "task", "there is none")),
        };
        Ok((finding, ()))
    }
}
