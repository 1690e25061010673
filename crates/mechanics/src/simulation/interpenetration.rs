//! Bodies that went through each other, or that stay inside each other.
//!
//! No equation of a step forbids either: a contact that was not found in time has no row, and
//! without a correction an overlap stays as it is. So both are measured after every step.

use std::collections::BTreeMap;

use crate::body::State;
use crate::scene::{DetectedContact, Passage, Scene, Scheme, resting};
use lcplab_lcp::number::readable;

/// An overlap of more than this part of the thinner body is deep.
pub(crate) const DEEP: f64 = 0.25;
/// An overlap of more than this part of the thinner body, and more than the slop, counts.
pub const NOTABLE: f64 = 1e-2;
/// The number of steps without shrinking after which an overlap is lasting.
pub const LASTING: usize = 30;

/// An overlap shrinks if it is below this part of what it was.
const SHRUNK: f64 = 0.99;
/// Significant digits of lengths.
const DIGITS: usize = 2;

/// Two bodies of which one went through the other, or stays inside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interpenetration {
    /// What happened.
    pub kind: InterpenetrationKind,
    /// Both bodies, the one that moves, or moves faster, first.
    pub bodies: [usize; 2],
    /// The overlap (m); of bodies that went through each other the deepest on the way.
    pub depth: f64,
}

/// What happened to two bodies that must not overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InterpenetrationKind {
    /// One went through the other within the step.
    PassedThrough {
        /// How far (m) they moved against each other in the step, turning included.
        travel: f64,
    },
    /// They overlap by more than a quarter of the thinner one, and no less than a step before.
    DeepOverlap {
        /// The thickness of the thinner one (m).
        thickness: f64,
    },
    /// They have overlapped for [`LASTING`] steps, and the overlap did not shrink.
    LastingOverlap,
}

impl Interpenetration {
    /// The kind in one word, for files.
    pub(crate) fn word(&self) -> &'static str {
        match self.kind {
            InterpenetrationKind::PassedThrough { .. } => "passed_through",
            InterpenetrationKind::DeepOverlap { .. } => "deep_overlap",
            InterpenetrationKind::LastingOverlap => "lasting_overlap",
        }
    }

    /// What happened in the step of this number, and what helps.
    pub(crate) fn message(&self, scene: &Scene, step: usize) -> String {
        let [body, other] = self.bodies.map(|body| &scene.bodies[body].name);
        let depth = readable(self.depth, DIGITS);
        match self.kind {
            InterpenetrationKind::PassedThrough { travel } => format!(
                "{body:?} passed through {other:?} in step {step}; during the step they overlapped by {depth} m. \
                 {}",
                remedy_for_passing(scene, travel)
            ),
            InterpenetrationKind::DeepOverlap { thickness } => format!(
                "{body:?} is {depth} m inside {other:?} after step {step}; the thinner of the two is {} m thick. \
                 A likely cause is rejected answers of the solver. If the judge accepts all answers, use a smaller step.dt. {}",
                readable(thickness, DIGITS),
                remedy_for_overlap(scene)
            ),
            InterpenetrationKind::LastingOverlap => format!(
                "{body:?} has been inside {other:?} for {LASTING} steps, by {depth} m after step {step}, \
                 and the overlap did not shrink in these steps. {}",
                remedy_for_overlap(scene)
            ),
        }
    }

    pub(super) fn passed(scene: &Scene, states: &[State], passage: &Passage) -> Self {
        let Passage { bodies, depth, travel } = *passage;
        let kind = InterpenetrationKind::PassedThrough { travel };
        Interpenetration { kind, bodies: faster_first(scene, states, bodies), depth }
    }
}

fn remedy_for_passing(scene: &Scene, travel: f64) -> String {
    let moved =
        format!("Their relative displacement in this step was {} m", readable(travel, DIGITS));
    match (scene.step.scheme, scene.contact.margin) {
        (Scheme::Acceleration, _) if !scene.step.events => {
            format!("{moved}: set step.events to true, or use a smaller step.dt.")
        }
        (Scheme::Acceleration, _) => format!("{moved}: use a smaller step.dt."),
        (_, Some(margin)) if margin < travel => format!(
            "{moved}, and contact.margin is {} m: leave it unset, so that it follows the speed, or use a smaller \
             step.dt.",
            readable(margin, DIGITS)
        ),
        _ => format!("{moved}: use a smaller step.dt."),
    }
}

fn remedy_for_overlap(scene: &Scene) -> &'static str {
    let step = &scene.step;
    match step.scheme {
        Scheme::Velocity | Scheme::SequentialImpulses if step.baumgarte == 0.0 => {
            "No error feedback pushes them apart: set step.baumgarte to 0.2, or use the scheme split-impulse."
        }
        Scheme::Velocity | Scheme::SequentialImpulses => {
            "A larger step.baumgarte, up to 1, pushes them apart faster."
        }
        Scheme::Acceleration if step.alpha == 0.0 => {
            "No error feedback pushes them apart: set step.alpha, to 0.2/dt for example."
        }
        Scheme::Acceleration => "A larger step.alpha pushes them apart faster.",
        Scheme::GaussSeidel => "More step.sweeps push them apart.",
        Scheme::Xpbd => "More step.substeps or step.xpbd.sweeps push them apart.",
        Scheme::Soft => {
            "A larger step.soft.contact_hertz with more step.substeps pushes them apart."
        }
        Scheme::Penalty => {
            "A larger step.penalty.stiffness with more step.substeps pushes them apart."
        }
        Scheme::SplitImpulse => "A smaller step.dt leaves less overlap to correct.",
    }
}

/// The overlaps that last from step to step, by their bodies.
#[derive(Debug, Clone, Default)]
pub(super) struct Overlaps(BTreeMap<[usize; 2], Overlap>);

/// An overlap of two bodies since it began.
#[derive(Debug, Clone, Copy)]
struct Overlap {
    /// The depth now (m).
    depth: f64,
    /// The depth (m) below which it counts as shrinking.
    reference: f64,
    /// For how many steps it has not shrunk.
    steps: usize,
    /// Whether it was called deep, and lasting.
    is_reported: [bool; 2],
}

impl Overlaps {
    /// Takes the overlapping contacts after a step into account; returns what is to be reported.
    pub fn update(
        &mut self,
        scene: &Scene,
        states: &[State],
        found: &[DetectedContact],
    ) -> Vec<Interpenetration> {
        let mut depths: BTreeMap<[usize; 2], f64> = BTreeMap::new();
        for found in found.iter().filter(|found| found.gap < 0.0) {
            let depth = depths.entry(found.id.bodies).or_default();
            *depth = depth.max(-found.gap);
        }
        let before = std::mem::take(&mut self.0);
        let mut reports = Vec::new();
        for (bodies, depth) in depths {
            let thickness = thickness(scene, bodies);
            if !(depth > scene.contact.slop + NOTABLE * thickness) {
                continue;
            }
            let mut overlap = match before.get(&bodies) {
                Some(known) if depth >= SHRUNK * known.reference => {
                    Overlap { depth, steps: known.steps + 1, ..*known }
                }
                Some(known) => Overlap { depth, reference: depth, steps: 0, ..*known },
                None => Overlap { depth, reference: depth, steps: 0, is_reported: [false; 2] },
            };
            let before = before.get(&bodies).map_or(0.0, |known| known.depth);
            let is_deep = depth > DEEP * thickness && depth >= before;
            let lasts = overlap.steps >= LASTING;
            let kinds = [
                (is_deep, InterpenetrationKind::DeepOverlap { thickness }),
                (lasts, InterpenetrationKind::LastingOverlap),
            ];
            for ((is_so, kind), is_reported) in kinds.into_iter().zip(&mut overlap.is_reported) {
                if is_so && !*is_reported {
                    *is_reported = true;
                    let bodies = faster_first(scene, states, bodies);
                    reports.push(Interpenetration { kind, bodies, depth });
                }
            }
            self.0.insert(bodies, overlap);
        }
        reports
    }
}

/// The thickness (m) of the thinner of two bodies; where neither has one, that of the scene's
/// thinnest, or 1 m.
pub(super) fn thickness(scene: &Scene, bodies: [usize; 2]) -> f64 {
    let own = bodies.into_iter().filter_map(|body| resting::size(&scene.bodies[body].shape));
    own.reduce(f64::min).or_else(|| scene.thinnest()).unwrap_or(1.0)
}

/// Two bodies, the one that moves, or moves faster, first.
pub(super) fn faster_first(scene: &Scene, states: &[State], [a, b]: [usize; 2]) -> [usize; 2] {
    let rank = |body: usize| (scene.bodies[body].mass.dof() > 0, states[body].v.norm());
    if rank(b) > rank(a) { [b, a] } else { [a, b] }
}
