//! The levels beside each other and beside half the step: who is exact where.
//!
//! Nobody knows the exact motion of any scene, but half the step comes nearer to it: what halving
//! changes is the error of the whole step. It is measured at the end of the run, and within it by
//! what the bodies do: where they meet, by the velocities of a step taken in one and in two halves;
//! where they spin freely, by angular momentum and energy; where they rest, by how far they are
//! from touching.

use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::Scene;
use lcplab_mechanics::simulation::{Simulation, Step};
use lcplab_solver::{Method, Stop};
use serde::{Deserialize, Serialize};

/// An error below this part is rounding and the solver's tolerance.
pub const EXACT: f64 = 1e-6;
/// An approach of so many times what gravity adds in a step is a meeting.
const FAST: f64 = 4.0;
/// Bodies slower than this part of what counts as rest at acceleration level rest.
const STILL: f64 = 1e-3;
/// An axis that turns by less than this part of a full turn of its axis does not matter.
const TURNING: f64 = 1e-6;

/// What bodies do in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// They meet: a blow.
    Meet,
    /// They spin freely, and not about a principal axis.
    Spin,
    /// They rest on each other.
    Rest,
}

impl Phase {
    /// All of them.
    pub const ALL: [Phase; 3] = [Phase::Meet, Phase::Spin, Phase::Rest];

    /// The verb.
    pub fn verb(self) -> &'static str {
        match self {
            Phase::Meet => "meet",
            Phase::Spin => "spin",
            Phase::Rest => "rest",
        }
    }

    /// Of what its error is a part.
    pub fn of(self) -> &'static str {
        match self {
            Phase::Meet => "of the speed in a step",
            Phase::Spin => "of the angular momentum or energy in a step",
            Phase::Rest => "of the thinnest body between them",
        }
    }
}

/// A level with one solver, beside itself with half the step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// The level.
    pub scheme: String,
    /// The solver.
    pub solver: String,
    /// How far the end of the farthest body moves by half the step (m).
    pub halved: f64,
    /// The largest error where bodies do this, as a part; none where they never do.
    pub errors: [Option<f64>; 3],
}

/// The levels of a scene beside each other.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Levels {
    /// A level each.
    pub levels: Vec<Level>,
    /// How far apart the first and the last of them end (m).
    pub apart: f64,
}

/// Steps a scene at these levels by these solvers, with its step and with half of it; `None` if it
/// was time to stop or a step could not be taken.
pub(super) fn levels(runs: &[(Scene, Method)], steps: usize, stop: &Stop) -> Option<Levels> {
    let mut ends = Vec::new();
    let mut levels = Vec::new();
    for (scene, method) in runs {
        let (end, errors) = course(scene, method, steps, stop)?;
        let halved = last(&halved(scene, &scene.states, 0.0), method, 2 * steps, stop)?;
        levels.push(Level {
            scheme: scene.step.scheme.name().into(),
            solver: method.name().into(),
            halved: apart(&end, &halved),
            errors,
        });
        ends.push(end);
    }
    let apart = match &ends[..] {
        [first, .., last] => apart(first, last),
        _ => 0.0,
    };
    Some(Levels { levels, apart })
}

/// The scene with half its step from these states on, at this time (s).
fn halved(scene: &Scene, states: &[State], time: f64) -> Scene {
    let mut scene = scene.clone();
    scene.step.dt *= 0.5;
    scene.time += time;
    scene.states = states.to_vec();
    scene
}

/// Where the bodies are after so many steps.
fn last(scene: &Scene, method: &Method, steps: usize, stop: &Stop) -> Option<Vec<State>> {
    let mut simulation = Simulation::by(scene, method);
    for _ in 0..steps {
        simulation.step_before(stop).ok()?;
    }
    Some(simulation.states().to_vec())
}

/// Where the bodies are after so many steps, and the largest error of each phase.
fn course(
    scene: &Scene,
    method: &Method,
    steps: usize,
    stop: &Stop,
) -> Option<(Vec<State>, [Option<f64>; 3])> {
    let mut simulation = Simulation::by(scene, method);
    let mut errors = [None; 3];
    for _ in 0..steps {
        let (before, time) = (simulation.states().to_vec(), simulation.time());
        let step = simulation.step_before(stop).ok()?;
        let Some(phase) = phase(scene, &before, &step) else { continue };
        let error = match phase {
            Phase::Meet => {
                let halves = last(&halved(scene, &before, time), method, 2, stop)?;
                speeds_apart(&step.states, &halves)
            }
            Phase::Spin => spun(scene, &before, &step.states),
            Phase::Rest => {
                let off = step.touches.iter().map(|touch| touch.off).fold(0.0, f64::max);
                off / scene.thinnest().unwrap_or(1.0)
            }
        };
        let known: &mut Option<f64> = &mut errors[phase as usize];
        *known = Some(known.map_or(error, |known| known.max(error)));
    }
    Some((simulation.states().to_vec(), errors))
}

/// What the bodies do in a step, if it is one of these.
fn phase(scene: &Scene, before: &[State], step: &Step) -> Option<Phase> {
    let fast = (FAST * scene.gravity.norm() * scene.step.dt).max(scene.contact.bounce_speed);
    if step.touches.iter().any(|touch| touch.approach > fast) {
        return Some(Phase::Meet);
    }
    let moving = || (0..before.len()).filter(|&k| scene.bodies[k].mass.dof() > 0);
    if step.touches.is_empty() {
        let turns = |k: usize| {
            let momentum = spin(scene, k, &before[k]);
            let turn = before[k].omega.cross(&momentum).norm();
            turn > TURNING * before[k].omega.norm() * momentum.norm()
        };
        let spins = scene.constraints.is_empty() && moving().any(turns);
        return spins.then_some(Phase::Spin);
    }
    let least = STILL * scene.resting().speed;
    let is_still = |k: usize| step.states[k].velocity().norm() <= least;
    moving().all(is_still).then_some(Phase::Rest)
}

/// The angular momentum of a body about its centre of mass (N m s).
fn spin(scene: &Scene, body: usize, state: &State) -> nalgebra::Vector3<f64> {
    let mass = &scene.bodies[body].mass;
    mass.angular_momentum(state) - state.pose.p.cross(&mass.momentum(state))
}

/// The largest change of the angular momentum or of the energy of spin of a body, as a part of it.
fn spun(scene: &Scene, before: &[State], after: &[State]) -> f64 {
    let change = |k: usize| {
        let [old, new] = [before, after].map(|states| spin(scene, k, &states[k]));
        let mass = &scene.bodies[k].mass;
        let [had, has] = [before, after].map(|states| mass.spin_energy(&states[k]));
        let turned = if old.norm() > 0.0 { (new - old).norm() / old.norm() } else { 0.0 };
        let gained = if had > 0.0 { (has - had).abs() / had } else { 0.0 };
        turned.max(gained)
    };
    (0..before.len()).map(change).fold(0.0, f64::max)
}

/// How far the velocities of two ends of a step differ, as a part of the largest speed.
fn speeds_apart(one: &[State], other: &[State]) -> f64 {
    let largest = one.iter().chain(other).map(|state| state.v.norm()).fold(0.0, f64::max);
    let difference = one.iter().zip(other).map(|(a, b)| (a.v - b.v).norm()).fold(0.0, f64::max);
    if largest > 0.0 { difference / largest } else { 0.0 }
}

/// How far two ends of a run are apart (m).
fn apart(one: &[State], other: &[State]) -> f64 {
    let distance = |(a, b): (&State, &State)| (a.pose.p - b.pose.p).norm();
    one.iter().zip(other).map(distance).fold(0.0, f64::max)
}
