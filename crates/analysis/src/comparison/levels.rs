//! Each level compared with itself under a divided step, and the levels with each other.
//!
//! The exact motion of a scene is not known, but a shorter step comes nearer to it: what a division
//! of the step changes is a part of its error. It is measured at the end of the run, and within it
//! by what the bodies do:
//!
//! ```text
//! meet   velocities of a step taken in one, two and three parts, of pairs that meet in each of
//!        them; the error of the normal of an impact that the step takes at its beginning, across a
//!        gap; for a scheme with parts of its own also the path; and apart from these, because it
//!        changes when bodies bounce and not how, the error of the instant
//! spin   angular momentum and energy of bodies without contacts, joints and torques
//! rest   gaps and overlaps of contacts that push
//! ```
//!
//! Motions differ by |Δp| + r Δθ and |Δv| + r |Δω|, r half the size of a body.

use std::collections::BTreeSet;

use lcplab_mechanics::body::{Mass, State, angular};
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{Simulation, Step, Touch};
use lcplab_solver::{Method, Stop};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// An error below this part is rounding and the solver's tolerance.
pub const EXACT: f64 = 1e-6;
/// An approach faster than this many times the speed that gravity adds in a step is an impact.
const FAST: f64 = 4.0;
/// The numbers of parts into which a step with an impact is divided.
const PARTS: [usize; 2] = [2, 3];
/// Bodies slower than this part of what counts as rest at acceleration level rest.
const STILL: f64 = 1e-3;
/// An axis that turns by less than this part of a full turn of its axis does not matter.
const TURNING: f64 = 1e-6;
/// Nor does the spin of a body below this part of the largest momentum, in the same unit.
const SPINNING: f64 = 1e-6;

/// What bodies do in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// They meet: an impact. Its error is a part of the approach, in speed or in distance a step;
    /// that of its instant is [`LevelRefinement::mistimed`].
    Meet,
    /// They spin freely, and not about a principal axis. Its error is the change of the angular
    /// momentum or of the energy in a step, as a part of it.
    Spin,
    /// They rest on each other. Its error is the largest gap or overlap, as a part of the thinnest
    /// body.
    Rest,
}

impl Phase {
    /// All of them.
    pub const ALL: [Phase; 3] = [Phase::Meet, Phase::Spin, Phase::Rest];
}

/// A level with one solver, compared with itself under a divided step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LevelRefinement {
    /// The level.
    pub scheme: String,
    /// The solver.
    pub solver: String,
    /// How far the end of the farthest body moves by half the step (m).
    pub halved: f64,
    /// The largest error of each [`Phase`], as a part; none where bodies never do this.
    pub errors: [Option<f64>; 3],
    /// The largest time by which bodies bounce too early or too late, as a part of the step; none
    /// where they never meet.
    pub mistimed: Option<f64>,
}

/// The levels of a scene, compared with each other.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Levels {
    /// A level each.
    pub levels: Vec<LevelRefinement>,
    /// How far apart the first and the last of them end (m).
    pub apart: f64,
}

/// Steps a scene at these levels by these solvers, with its step and with half of it; `None` if it
/// was time to stop or a step could not be taken.
pub(super) fn levels(runs: &[(Scene, Method)], steps: usize, stop: &Stop) -> Option<Levels> {
    let mut ends = Vec::new();
    let mut levels = Vec::new();
    for (scene, method) in runs {
        let Trajectory { end, errors, mistimed } = trajectory(scene, method, steps, stop)?;
        let (halved, _) = last(&divided(scene, &scene.states, 0.0, 2), method, 2 * steps, stop)?;
        levels.push(LevelRefinement {
            scheme: scene.step.scheme.name().into(),
            solver: method.name().into(),
            halved: apart(scene, &end, &halved),
            errors,
            mistimed,
        });
        ends.push(end);
    }
    let apart = match (runs, &ends[..]) {
        ([(scene, _), ..], [first, .., last]) => apart(scene, first, last),
        _ => 0.0,
    };
    Some(Levels { levels, apart })
}

/// The scene with its step divided into this number of parts, from these states on, at this time
/// (s).
fn divided(scene: &Scene, states: &[State], time: f64, parts: usize) -> Scene {
    let mut scene = scene.clone();
    scene.step.dt /= parts as f64;
    scene.time += time;
    scene.states = states.to_vec();
    scene
}

/// The states after this number of steps, and the pairs of bodies that pushed each other.
fn last(
    scene: &Scene,
    method: &Method,
    steps: usize,
    stop: &Stop,
) -> Option<(Vec<State>, BTreeSet<[usize; 2]>)> {
    let mut simulation = Simulation::by(scene, method);
    let mut pairs = BTreeSet::new();
    for _ in 0..steps {
        let step = simulation.step_before(stop).ok()?;
        pairs.extend(step.touches.iter().map(|touch| touch.bodies));
    }
    Some((simulation.states().to_vec(), pairs))
}

/// The states after a number of steps, and the largest errors on the way.
struct Trajectory {
    end: Vec<State>,
    errors: [Option<f64>; 3],
    mistimed: Option<f64>,
}

/// Measures each step.
fn trajectory(scene: &Scene, method: &Method, steps: usize, stop: &Stop) -> Option<Trajectory> {
    let mut simulation = Simulation::by(scene, method);
    let mut errors = [None; 3];
    let mut mistimed: Option<f64> = None;
    for _ in 0..steps {
        let (before, time) = (simulation.states().to_vec(), simulation.time());
        let step = simulation.step_before(stop).ok()?;
        let Some(phase) = phase(scene, &before, &step) else { continue };
        let error = match phase {
            Phase::Meet => {
                let time_error = instant_error(scene, &step);
                mistimed = Some(mistimed.map_or(time_error, |known| known.max(time_error)));
                let mut error = normal_error(scene, &step);
                for parts in PARTS {
                    let fine = divided(scene, &before, time, parts);
                    let (fine, pairs) = last(&fine, method, parts, stop)?;
                    error = error.max(changed(scene, &step, &fine, &pairs));
                }
                error
            }
            Phase::Spin => spun(scene, &before, &step.states),
            Phase::Rest => {
                let gaps = step.touches.iter().map(|touch| touch.largest_gap);
                gaps.fold(0.0, f64::max) / scene.thinnest().unwrap_or(1.0)
            }
        };
        let known: &mut Option<f64> = &mut errors[phase as usize];
        *known = Some(known.map_or(error, |known| known.max(error)));
    }
    Some(Trajectory { end: simulation.states().to_vec(), errors, mistimed })
}

/// What the bodies do in a step, if it is one of these.
fn phase(scene: &Scene, before: &[State], step: &Step) -> Option<Phase> {
    if meeting(scene, step).next().is_some() {
        return Some(Phase::Meet);
    }
    if step.touches.is_empty() {
        return (!spinning(scene, before).is_empty()).then_some(Phase::Spin);
    }
    let least = STILL * scene.resting().speed;
    let mut moving = (0..before.len()).filter(|&k| scene.bodies[k].mass.dof() > 0);
    moving.all(|k| step.states[k].velocity().norm() <= least).then_some(Phase::Rest)
}

/// The pairs that meet in a step.
fn meeting<'s>(scene: &Scene, step: &'s Step) -> impl Iterator<Item = &'s Touch> {
    let fast = FAST * scene.gravity.norm() * scene.step.dt;
    let is_fast = move |own: &&Touch| own.approach > fast && scene.contact.bounces(own.approach);
    step.touches.iter().filter(is_fast)
}

/// The speed of the fastest approach in a step (m/s).
fn approach(scene: &Scene, step: &Step) -> f64 {
    meeting(scene, step).map(|touch| touch.approach).fold(0.0, f64::max)
}

/// The velocity error of impacts that a step without parts takes at its beginning, because the
/// normal turns until the bodies meet, as a part of the approach.
fn normal_error(scene: &Scene, step: &Step) -> f64 {
    if has_parts(scene) {
        return 0.0;
    }
    step.unlocated.iter().map(|own| own.speed).fold(0.0, f64::max) / approach(scene, step)
}

/// The largest time c/v⁻ by which bodies bounce too early or too late in a step without parts, as a
/// part of the step.
fn instant_error(scene: &Scene, step: &Step) -> f64 {
    if has_parts(scene) {
        return 0.0;
    }
    let bounced = meeting(scene, step).filter(|touch| touch.parting > 0.0);
    let times = bounced.map(|touch| touch.largest_gap / touch.approach);
    times.fold(0.0, f64::max) / scene.step.dt
}

/// Whether a scheme divides its steps by itself, wherever impacts are.
fn has_parts(scene: &Scene) -> bool {
    let scheme = scene.step.scheme;
    !scheme.takes_impacts_early() && scheme != Scheme::Acceleration
}

/// How far the bodies that touch in a step are from these states at its end, as a part of the
/// approach: in velocity, if the pair has also met on the way to these states, and in the path of a
/// scheme with parts.
fn changed(scene: &Scene, step: &Step, other: &[State], pairs: &BTreeSet<[usize; 2]>) -> f64 {
    let difference = |(k, has_met): (usize, bool)| {
        let (a, b, size) = (&step.states[k], &other[k], half_size(&scene.bodies[k].mass));
        let velocity = (a.v - b.v).norm() + size * (a.omega - b.omega).norm();
        let path = if has_parts(scene) { distance(size, a, b) / scene.step.dt } else { 0.0 };
        if has_met { velocity.max(path) } else { path }
    };
    let bodies = step.touches.iter().flat_map(|touch| {
        let has_met = pairs.contains(&touch.bodies);
        touch.bodies.map(|body| (body, has_met))
    });
    bodies.map(difference).fold(0.0, f64::max) / approach(scene, step)
}

/// The angular momentum of a body about its center of mass (N m s).
fn spin(scene: &Scene, body: usize, state: &State) -> Vector3<f64> {
    scene.bodies[body].mass.angular_momentum(&State { v: Vector3::zeros(), ..*state })
}

/// The bodies that spin freely and not about a principal axis: without joints, torques and forces
/// that depend on time.
fn spinning(scene: &Scene, states: &[State]) -> Vec<usize> {
    let size = |k: usize| {
        let (mass, state) = (&scene.bodies[k].mass, &states[k]);
        spin(scene, k, state).norm() + half_size(mass) * mass.momentum(state).norm()
    };
    let largest = (0..states.len()).map(size).fold(0.0, f64::max);
    let is_free = |k: usize| {
        let is_joined = scene.constraints.iter().any(|own| own.bodies().contains(&Some(k)));
        let is_driven = scene.driven.iter().any(|driven| driven.body == k);
        let torque = angular(&scene.bodies[k].wrench(&states[k].pose));
        !is_joined && !is_driven && torque == Vector3::zeros()
    };
    let turns = |k: usize| {
        let (omega, momentum) = (&states[k].omega, spin(scene, k, &states[k]));
        momentum.norm() > SPINNING * largest
            && omega.cross(&momentum).norm() > TURNING * omega.norm() * momentum.norm()
    };
    (0..states.len()).filter(|&k| is_free(k) && turns(k)).collect()
}

/// The largest change of the angular momentum or of the energy of a body that spins, as a part of
/// it.
fn spun(scene: &Scene, before: &[State], after: &[State]) -> f64 {
    let change = |k: usize| {
        let [old, new] = [before, after].map(|states| spin(scene, k, &states[k]));
        let mass = &scene.bodies[k].mass;
        let [had, has] = [before, after].map(|states| mass.spin_energy(&states[k]));
        ((new - old).norm() / old.norm()).max((has - had).abs() / had)
    };
    spinning(scene, before).into_iter().map(change).fold(0.0, f64::max)
}

/// Half the size of a body (m): the radius of a ball with its mass and largest moment of inertia.
fn half_size(mass: &Mass) -> f64 {
    match mass {
        Mass::Rigid { mass, moments } => (2.5 * moments.max() / mass).sqrt(),
        Mass::Fixed | Mass::Point { .. } => 0.0,
    }
}

/// How far two poses of a body of this half size (m) are apart (m).
fn distance(half_size: f64, one: &State, other: &State) -> f64 {
    (one.pose.p - other.pose.p).norm() + half_size * one.pose.q.angle_to(&other.pose.q)
}

/// How far two ends of a run are apart (m).
fn apart(scene: &Scene, one: &[State], other: &[State]) -> f64 {
    let bodies = scene.bodies.iter().zip(one.iter().zip(other));
    let distances = bodies.map(|(body, (a, b))| distance(half_size(&body.mass), a, b));
    distances.fold(0.0, f64::max)
}
