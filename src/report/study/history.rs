//! What a scene does when it is stepped, how wrong that is, and what it costs.

use serde::{Deserialize, Serialize};

use super::comparison::Sample;
use crate::assembly::{Assembly, Entering};
use crate::error::Result;
use crate::film::{Take, instants};
use crate::scene::{Scene, Scheme};
use crate::simulation::{Simulation, Step};
use crate::solver::Status;

/// A scene, stepped in one way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct History {
    /// The length of a step (s).
    pub dt: f64,
    /// Steps wanted.
    pub wanted: usize,
    /// Steps taken.
    pub steps: usize,
    /// Why it ended early, if it did.
    pub ending: Option<String>,
    /// Energy and errors at some instants, the start and the end among them.
    pub samples: Vec<Sample>,
    /// The largest gain of energy over the start (J), at least 0.
    pub gain: f64,
    /// The largest loss (J), at least 0.
    pub loss: f64,
    /// The largest |c| of an equality row that is a length (m).
    pub drift: f64,
    /// The deepest overlap (m).
    pub penetration: f64,
    /// The most rows of a step.
    pub rows: usize,
    /// LCPs solved.
    pub solves: usize,
    /// LCPs whose solver gave up.
    pub unsolved: usize,
    /// Pivots, or passes over all rows, in all.
    pub passes: usize,
}

/// Instants that are kept of a history.
const KEPT: usize = 121;

impl History {
    /// Energy over that of the start (J), by time (s).
    pub fn energy_changes(&self) -> Vec<(f64, f64)> {
        let first = self.samples.first().map_or(0.0, |sample| sample.energy);
        self.samples.iter().map(|sample| (sample.time, sample.energy - first)).collect()
    }

    /// A measure by time (s).
    pub fn curve(&self, measure: impl Fn(&Sample) -> f64) -> Vec<(f64, f64)> {
        self.samples.iter().map(|sample| (sample.time, measure(sample))).collect()
    }
}

/// Steps the scene as it states, showing each step to `watch`.
///
/// # Errors
/// If the scene names no solver that there is.
pub fn run(scene: &Scene, duration: f64, watch: impl FnMut(&Step)) -> Result<History> {
    let simulation = Simulation::of(scene)?;
    Ok(stepped(simulation, duration, (KEPT, None), watch).0)
}

/// The same, and a film of so many instants.
///
/// # Errors
/// As [`run`].
pub fn filmed(
    scene: &Scene,
    duration: f64,
    (name, shots): (&str, usize),
    watch: impl FnMut(&Step),
) -> Result<(History, Take)> {
    let simulation = Simulation::of(scene)?;
    let take = Take::start(name, &simulation);
    let (history, take) = stepped(simulation, duration, (shots, Some(take)), watch);
    Ok((history, take.expect("a take was begun")))
}

fn stepped(
    mut simulation: Simulation,
    duration: f64,
    (shots, mut take): (usize, Option<Take>),
    mut watch: impl FnMut(&Step),
) -> (History, Option<Take>) {
    let scene = simulation.scene().clone();
    let wanted = (duration / scene.step.dt).round() as usize;
    let (kept, shown) = (instants(wanted, KEPT), instants(wanted, shots));
    let first = Sample::from(&simulation.motion());
    let mut history = History {
        dt: scene.step.dt,
        wanted,
        steps: 0,
        ending: None,
        samples: vec![first],
        gain: 0.0,
        loss: 0.0,
        drift: first.drift,
        penetration: first.penetration,
        rows: 0,
        solves: 0,
        unsolved: 0,
        passes: 0,
    };
    for number in 1..=wanted {
        let before = simulation.states().to_vec();
        let step = match simulation.step() {
            Ok(step) => step,
            Err(failure) => {
                history.ending = Some(failure.to_string());
                if let Some(take) = &mut take {
                    take.end(Some(&failure));
                }
                break;
            }
        };
        history.add(&step, &first);
        history.count(&scene, &before, &step);
        if kept.binary_search(&number).is_ok() {
            history.samples.push(Sample::from(&step.motion));
        }
        if let Some(take) = take.as_mut().filter(|_| shown.binary_search(&number).is_ok()) {
            take.add(&scene, &step);
        }
        watch(&step);
    }
    (history, take)
}

impl History {
    fn add(&mut self, step: &Step, first: &Sample) {
        let change = step.motion.energy() - first.energy;
        self.steps += 1;
        self.gain = self.gain.max(change);
        self.loss = self.loss.max(-change);
        self.drift = self.drift.max(step.motion.drift);
        self.penetration = self.penetration.max(step.motion.penetration);
    }

    fn count(&mut self, scene: &Scene, before: &[crate::body::State], step: &Step) {
        for solve in &step.solves {
            self.solves += 1;
            self.unsolved += usize::from(solve.solution.status != Status::Solved);
            self.passes += solve.solution.iterations;
            self.rows = self.rows.max(solve.problem.lcp.len());
        }
        if let Some(passes) = passes(scene) {
            let rows = Assembly::new(scene, before, &step.contacts, Entering::Near);
            self.rows = self.rows.max(rows.map_or(0, |assembly| assembly.rows.len()));
            self.passes += passes;
        }
    }
}

/// How often a step of a family that hands no LCP to a solver passes over its rows.
fn passes(scene: &Scene) -> Option<usize> {
    let step = &scene.step;
    match step.scheme {
        Scheme::Xpbd => Some(step.substeps * 2 * step.xpbd.sweeps), // positions, then speeds
        Scheme::Soft => Some(step.substeps * (1 + step.soft.relax)),
        Scheme::Penalty => Some(step.substeps),
        _ => None,
    }
}
