//! One instant of a motion, with the forces that act at that instant.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use crate::assembly::{Row, Source};
use crate::body::{Mass, State};
use crate::constraint::{Constraint, Kind, Normal};
use crate::scene::{Scene, Scheme};
use crate::simulation::{Simulation, Solve, Step};

/// One instant of a motion.
///
/// ```
/// use lcplab::animation::{Frame, View};
/// use lcplab::{scene::Scene, simulation::Simulation, solver::Dantzig};
///
/// // Three balls in a stack: forces of 4, 3 and 1 N in the first step of 1 s.
/// let scene = Scene::load("fig7")?;
/// let mut simulation = Simulation::new(scene.clone(), Box::new(Dantzig::default()));
/// let start = Frame::now(&simulation);
/// assert_eq!((start.time, start.forces.len()), (0.0, 0));
/// let step = simulation.step().expect("a step that can be taken");
/// let after = Frame::after(&scene, &step);
/// assert_eq!((after.time, after.forces.len()), (1.0, 3));
/// assert_eq!(start.clone().with_velocities(&scene).forces.len(), 1); // of the ball that moves
/// assert_eq!(Frame::solved(&scene, &step), std::slice::from_ref(&after)); // one LCP
/// assert_eq!(after.largest().as_deref(), Some("at most 4 N"));
/// // Balls above each other stay in the plane of the front view.
/// let red = after.heated(vec![0.0, 0.0, 1.0, 0.0]); // one ball
/// assert_eq!(View::of(&scene, &[start, red]), View::Front);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frame {
    /// The time (s).
    pub time: f64,
    /// The state of each body of the scene.
    pub states: Vec<State>,
    /// The forces of contacts and constraints; may be empty.
    pub forces: Vec<Force>,
    /// The color of each body from 0, gray, to 1, red; empty if bodies have their own colors.
    pub heat: Vec<f64>,
}

/// A force of a contact or constraint on a moving body: for a contact, on the body that it pushes
/// against gravity, the upper one; otherwise on body 1 if that moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Force {
    /// Where it acts (m, world).
    pub point: Vector3<f64>,
    /// The force (N, world), or what its origin says.
    pub force: Vector3<f64>,
    /// What exerts it.
    pub origin: Origin,
}

/// The origin of a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Origin {
    /// The normal row of a contact.
    Normal,
    /// The tangential rows of a contact.
    Friction,
    /// Any other constraint.
    Constraint,
    /// The impulses of an impact (N s).
    Impulse,
    /// No force: the velocity of a body (m/s).
    Velocity,
}

impl Frame {
    /// The scene at its start.
    pub fn start(scene: &Scene) -> Self {
        Frame { states: scene.states.clone(), ..Frame::default() }
    }

    /// The current state of a simulation, without forces: for example where it could not continue.
    pub fn now(simulation: &Simulation) -> Self {
        let (time, states) = (simulation.time(), simulation.states().to_vec());
        Frame { time, states, ..Frame::default() }
    }

    /// The end of a step, with the forces of the step's last solve; an impulse is shown as the
    /// constant force over the step.
    pub fn after(scene: &Scene, step: &Step) -> Self {
        Frame::solved(scene, step).pop().unwrap_or_default()
    }

    /// The end of a step with the forces of each of its solves; those of impacts are impulses.
    pub fn solved(scene: &Scene, step: &Step) -> Vec<Self> {
        let (time, states) = (step.motion.time, step.states.clone());
        let end = Frame { time, states, ..Frame::default() };
        let posed = step.posed(scene).unwrap_or_default();
        let unit = |solve: &Solve| solve.problem.stage.unit(false);
        let has_arrows =
            |solve: &&Solve| ["N", "N s"].contains(&unit(solve)) && !solve.problem.lcp.is_empty();
        let solves: Vec<&Solve> = posed.iter().filter(has_arrows).collect();
        let is_impact = scene.step.scheme == Scheme::Acceleration;
        let all = solves
            .iter()
            .map(|solve| Frame { forces: forces(scene, step, solve, is_impact), ..end.clone() });
        if solves.is_empty() { vec![end] } else { all.collect() }
    }

    /// The same frame with the velocities of the bodies as arrows.
    pub fn with_velocities(mut self, scene: &Scene) -> Self {
        for (state, body) in self.states.iter().zip(&scene.bodies) {
            let (point, force, origin) = (state.pose.p, state.v, Origin::Velocity);
            if body.mass != Mass::Fixed && force.norm() > 0.0 {
                self.forces.push(Force { point, force, origin });
            }
        }
        self
    }

    /// The same frame with these body colors.
    pub fn heated(self, heat: Vec<f64>) -> Self {
        Frame { heat, ..self }
    }

    /// Whether all positions are finite.
    pub(super) fn is_finite(&self) -> bool {
        self.states.iter().all(State::is_finite)
    }
}

/// The numbers of the steps for this number of evenly spaced instants, including 0, the start, and
/// the last step; fewer if there are fewer steps.
///
/// ```
/// use lcplab::animation::instants;
///
/// assert_eq!(instants(100, 6), [0, 20, 40, 60, 80, 100]);
/// assert_eq!(instants(2, 6), [0, 1, 2]);
/// ```
pub fn instants(steps: usize, frames: usize) -> Vec<usize> {
    let gaps = frames.saturating_sub(1).clamp(1, steps.max(1));
    let at = |k: usize| (k as u128 * steps as u128 + gaps as u128 / 2) / gaps as u128;
    let mut instants: Vec<usize> = (0..=gaps).map(|k| at(k) as usize).collect();
    instants.dedup();
    instants
}

/// The forces of a solve; impulses as the constant force over the step, unless they remain.
fn forces(scene: &Scene, step: &Step, solve: &Solve, impulses: bool) -> Vec<Force> {
    let is_impulse = solve.problem.stage.unit(false) == "N s";
    let scale = if is_impulse && !impulses { 1.0 / scene.step.dt } else { 1.0 };
    let assembly = &solve.problem.assembly;
    let mut sums: BTreeMap<(Source, Origin), (usize, Vector3<f64>)> = BTreeMap::new();
    let mut between_moving: BTreeSet<Source> = BTreeSet::new();
    for (row, x) in assembly.rows.iter().zip(&solve.solution.x) {
        let Some(part) = row.parts().last() else { continue };
        let along =
            end_jacobian(scene, step, row).unwrap_or(part.jacobian.fixed_rows::<3>(0).into());
        let force = along * (x * scale);
        let own = if is_impulse && impulses { Origin::Impulse } else { origin(row) };
        let key = (row.id.source, own);
        let body = assembly.blocks[part.block].body;
        sums.entry(key).or_insert((body, Vector3::zeros())).1 += force;
        if row.parts().nth(1).is_some() {
            between_moving.insert(row.id.source);
        }
    }
    let points_down = |source: Source| {
        let own =
            [Origin::Normal, Origin::Impulse].iter().find_map(|own| sums.get(&(source, *own)));
        let normal = own.map(|(_, force)| force.dot(&scene.gravity));
        between_moving.contains(&source) && normal.is_some_and(|along| along > 0.0)
    };
    let placed = sums.iter().filter_map(|(&(source, origin), &(body, force))| {
        // A contact that begins within the step has no place yet.
        let center = || (origin == Origin::Impulse).then(|| step.states[body].pose.p);
        let point = place(scene, step, source, body).or_else(center)?;
        let force = if points_down(source) { -force } else { force };
        (force.norm() > 0.0).then_some(Force { point, force, origin })
    });
    placed.collect()
}

/// The direction of a constraint's row at the end of the step, where its force is drawn.
fn end_jacobian(scene: &Scene, step: &Step, row: &Row) -> Option<Vector3<f64>> {
    let Source::Constraint(k) = row.id.source else { return None };
    let constraint = &scene.constraints[k];
    let bodies = constraint.bodies();
    let rows =
        constraint.rows(bodies.map(|body| body.map_or(&State::WORLD, |k| &step.states[k]))).ok()?;
    let side = usize::from(bodies[1].is_some_and(|k| scene.bodies[k].mass != Mass::Fixed));
    Some(rows.get(row.id.component)?.jacobian[side].fixed_rows::<3>(0).into())
}

fn origin(row: &Row) -> Origin {
    match (row.id.source, row.kind) {
        (Source::Constraint(_), _) => Origin::Constraint,
        (Source::Contact(_), Kind::Friction) => Origin::Friction,
        (Source::Contact(_), _) => Origin::Normal,
    }
}

/// The point where the force of a constraint acts on one of its bodies at the end of a step.
fn place(scene: &Scene, step: &Step, source: Source, body: usize) -> Option<Vector3<f64>> {
    let end = |constraint: &dyn Constraint| {
        let side = usize::from(constraint.bodies()[1] == Some(body));
        Some((step.states[body].pose.point(&constraint.anchors()?[side]), side))
    };
    match source {
        Source::Constraint(k) => end(scene.constraints[k].as_ref()).map(|(point, _)| point),
        Source::Contact(id) => {
            let found = step.contacts.iter().find(|found| found.id == id)?;
            if matches!(found.contact.normal, Normal::Rim(_)) {
                return Some(found.point);
            }
            let (anchor, side) = end(&found.contact)?;
            let outward = if side == 1 { -found.normal } else { found.normal };
            Some(anchor + outward * found.contact.radii[side])
        }
    }
}
