//! The energy of impacts, where it is not what the coefficient of restitution says.
//!
//! A normal impulse X that takes the approach of a contact from v to v⁺ does the work ½ X (v + v⁺).
//! Newton's law, v⁺ = −e v, makes that ½ (1 − e) X v: 0 at e = 1, and a loss below. Most schemes
//! apply impulses at fixed poses, and each solve is examined by itself (`at_once`): energy that
//! changes at e = 1, or that impacts add at any e, is reported. XPBD, the soft step and the penalty
//! method are measured from the first step of contact to the separation (`spread`): any energy that
//! differs from that of e is reported.

mod at_once;
mod spread;

use super::{Solve, StepEvent};
use crate::body::State;
use crate::scene::{ContactId, Scene, Scheme};
use lcplab_lcp::number::readable;
pub(super) use spread::SpreadImpacts;

/// Significant digits in messages.
const DIGITS: usize = 3;

/// Energy that the impacts of a group of bodies changed against the coefficient of restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactEnergy {
    /// What the impacts of the group added (J), negative where they took it; of
    /// [`ImpactCause::Spread`] the difference to the energy after impacts with e.
    pub energy: f64,
    /// The contact with the largest part in it.
    pub contact: ContactId,
    /// Its bodies, the one that moves, or moves faster, first.
    pub bodies: [usize; 2],
    /// Its gap at the beginning of the step (m), negative for an overlap.
    pub gap: f64,
    /// Why.
    pub cause: ImpactCause,
}

/// Why the energy of impacts is not what the coefficient of restitution says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ImpactCause {
    /// Another impact closed a gap within the same step: the contact did not bounce.
    GapClosed,
    /// The bodies touched, and only another impact in the same step pressed them together: the
    /// contact did not bounce.
    NotBounced,
    /// Friction opposed the slip after the impact, and did work on the slip before it.
    Friction,
    /// The answer of the solver does not fulfil the contact's row.
    Inexact,
    /// No impulses satisfy the rows of the step together: the bounce would close another gap within
    /// the same step.
    Contradicted,
    /// The feedback of errors pushed an overlap apart, at this speed (m/s).
    PushedApart(f64),
    /// XPBD, soft step and penalty method: bodies that pushed each other from the first of these
    /// steps to the last have another energy than e gives, or friction increased it.
    Spread([usize; 2]),
}

impl ImpactEnergy {
    /// The energies to report of a step that applied impulses at fixed poses: from its events, or
    /// of a step without them from its solves.
    pub(super) fn of(
        scene: &Scene,
        states: &[State],
        solves: &[Solve],
        events: Option<&[StepEvent]>,
    ) -> Vec<ImpactEnergy> {
        let of_solve = |solve: &Solve| at_once::of_solve(scene, states, solve);
        let applied = |event: &StepEvent| match event {
            StepEvent::Answer(k) => Some(&solves[*k]),
            _ => None,
        };
        match events {
            Some(events) => events.iter().filter_map(applied).flat_map(of_solve).collect(),
            None => {
                let acts = |solve: &&Solve| solve.impulse_factor != 0.0;
                solves.iter().filter(acts).flat_map(of_solve).collect()
            }
        }
    }

    /// The number of the step in which the impact began, for a report of the step of this number: a
    /// scheme that spreads impacts reports one when the bodies have separated.
    pub(crate) fn first_step(&self, step: usize) -> usize {
        match self.cause {
            ImpactCause::Spread([first, _]) => first,
            _ => step,
        }
    }

    /// The cause in one word, for files.
    pub(crate) fn word(&self) -> &'static str {
        match self.cause {
            ImpactCause::GapClosed => "gap_closed_within_step",
            ImpactCause::NotBounced => "closed_by_another_impact",
            ImpactCause::Friction => "friction",
            ImpactCause::Inexact => "inexact_answer",
            ImpactCause::Contradicted => "contradictory_rows",
            ImpactCause::PushedApart(_) => "overlap_pushed_apart",
            ImpactCause::Spread(_) => "impact_energy_of_scheme",
        }
    }

    /// What happened in the step of this number, why, and what helps.
    #[doc(hidden)] // the warnings of a run have it
    pub fn message(&self, scene: &Scene, step: usize) -> String {
        let [body, other] = self.bodies.map(|body| &scene.bodies[body].name);
        let joules = readable(self.energy.abs(), DIGITS);
        let gap = readable(self.gap.abs(), DIGITS);
        let what = match self.energy < 0.0 {
            true => {
                format!(
                    "impacts lost {joules} J in step {step}, although restitution 1 conserves energy"
                )
            }
            false => format!("impacts added {joules} J in step {step}"),
        };
        let separate = match scene.step.scheme {
            Scheme::Acceleration => "",
            _ => ", or the scheme acceleration, which divides a step at its impacts",
        };
        match self.cause {
            ImpactCause::GapClosed => format!(
                "{what}: {other:?} pushes {body:?}, which is {gap} m away, because another impact closed \
                 this gap within the step. A smaller step.dt separates the impacts in time{separate}."
            ),
            ImpactCause::NotBounced => format!(
                "{what}: {body:?} and {other:?} were pressed together by another impact of the same step \
                 and did not bounce. A small gap between touching bodies, or a smaller step.dt, separates \
                 the impacts in time."
            ),
            ImpactCause::Friction => format!(
                "{what}: friction between {body:?} and {other:?} opposed the slip after the impact, but \
                 the slip before it had the other direction. A smaller contact.restitution or \
                 contact.friction avoids this."
            ),
            ImpactCause::Inexact => format!(
                "{what}: the solver's answer for the contact of {body:?} and {other:?} is not exact. Use a \
                 smaller solver.tolerance or a larger solver.max_iterations."
            ),
            ImpactCause::Contradicted => format!(
                "{what}: no impulses satisfy all rows of the step. The bounce of {body:?} and {other:?} \
                 would close another gap within the same step. Use a smaller step.dt{separate}."
            ),
            ImpactCause::PushedApart(speed) => format!(
                "step.baumgarte added {joules} J in step {step}: it pushed {body:?} and {other:?}, which \
                 overlapped by {gap} m, apart at {} m/s. A smaller step.baumgarte adds less energy, and \
                 the scheme split-impulse adds none.",
                readable(speed, DIGITS)
            ),
            ImpactCause::Spread([first, last]) => {
                let when = match first < last {
                    true => format!("in steps {first} to {last}"),
                    false => format!("in step {first}"),
                };
                let more = if self.energy < 0.0 { "less" } else { "more" };
                let e = readable(scene.restitution(self.bodies.map(Some)), DIGITS);
                format!(
                    "after the impact of {body:?} and {other:?} {when}, the bodies have {joules} J {more} than with \
                     restitution {e}. {}",
                    remedy(scene)
                )
            }
        }
    }
}

/// Why a scheme without impulses at fixed poses has another energy, and what helps.
fn remedy(scene: &Scene) -> &'static str {
    match scene.step.scheme {
        Scheme::Penalty => {
            "The scheme penalty does not read contact.restitution: step.penalty.damping determines how \
             bodies bounce, and a step.dt that is long for the contact spring changes the energy. Change \
             step.penalty.damping or increase step.substeps, or use the scheme velocity."
        }
        Scheme::Xpbd => {
            "The scheme xpbd corrects positions row by row, and restitution is applied to what is left. \
             Increase step.xpbd.sweeps or step.substeps, set step.xpbd.compliance = 0, or use the scheme \
             acceleration."
        }
        _ => {
            "The scheme soft applies restitution at the end of a substep, to the approach at its \
             beginning. A smaller step.dt or more step.substeps separate the impacts in time, and so \
             does the scheme acceleration."
        }
    }
}
