//! Impacts within a step that the step takes at its beginning.
//!
//! At velocity level bodies that meet within a step get the impulse of their bounce at its
//! beginning, along the normal that they have there. Where that turns until they meet, the bounce
//! goes another way:
//!
//! ```text
//! off by  |Δu − Δu'|,   Δu = −(1 + e) M⁻¹Jᵀ (J M⁻¹Jᵀ)⁻¹ J u⁻,   Δu' with J at t, c(t) = 0
//! ```

use std::collections::BTreeMap;

use nalgebra::{Vector3, Vector6};

use super::interpenetration::faster_first;
use super::slip::{Contact, Totals};
use crate::assembly::{Assembly, ConstraintFilter, Row};
use crate::body::{State, linear};
use crate::constraint::Kind;
use crate::scene::{Scene, step_contacts};
use lcplab_lcp::number::readable;

/// Smaller errors, relative to the speed of approach, are not reported.
const NOTABLE: f64 = 5e-3;
/// Newton's steps towards the instant of an impact, at most; each squares what is left.
const NEWTON_STEPS: usize = 8;
/// Bodies have met where so little of their gap is left.
const MET: f64 = 1e-9;
/// Significant digits in messages.
const DIGITS: usize = 2;

/// An impact that was not located.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unlocated {
    /// Both bodies, the one that moves, or moves faster, first.
    pub bodies: [usize; 2],
    /// The gap at the beginning of the step (m).
    pub gap: f64,
    /// By how much the velocity of a body is off (m/s).
    pub speed: f64,
}

impl Unlocated {
    /// Those of a step from these states; none of a scheme that divides the step.
    pub(super) fn of(scene: &Scene, before: &[State], totals: &Totals) -> Vec<Unlocated> {
        if !scene.step.scheme.takes_impacts_early() {
            return Vec::new();
        }
        let mut pairs: BTreeMap<[usize; 2], Unlocated> = BTreeMap::new();
        for contact in totals.contacts().filter(|contact| bounces(scene, contact)) {
            let Some(speed) = off_by(scene, before, &contact.normal.0) else { continue };
            let bodies = faster_first(scene, before, contact.bodies);
            let own = Unlocated { bodies, gap: contact.normal.0.c, speed };
            let known = pairs.entry(contact.bodies).or_insert(own);
            if speed > known.speed {
                *known = own;
            }
        }
        pairs.into_values().collect()
    }

    /// What happened in the step of this number, and what helps.
    pub(crate) fn message(&self, scene: &Scene, step: usize) -> String {
        let [body, other] = self.bodies.map(|body| &scene.bodies[body].name);
        format!(
            "{body:?} and {other:?} met during step {step}, after closing a gap of {} m. The scheme \
             applied the impact at the start of the step, with the contact normal there, so the \
             velocity after it is off by about {} m/s. Reduce step.dt, or use the scheme acceleration \
             with step.events = true.",
            readable(self.gap, DIGITS),
            readable(self.speed, DIGITS)
        )
    }
}

/// Whether a contact bounced across a gap.
fn bounces(scene: &Scene, contact: &Contact) -> bool {
    let (row, impulse) = contact.normal;
    let is_fast = scene.contact.bounces(-row.velocity);
    *impulse > 0.0 && row.c > 0.0 && is_fast && scene.restitution(row.bodies) > 0.0
}

/// By how much the bounce of a contact would differ where the bodies meet (m/s), if that is worth
/// reporting. Both are solved alone, so that the cost does not grow with the scene.
fn off_by(scene: &Scene, before: &[State], row: &Row) -> Option<f64> {
    let here = kick(scene, before, row);
    let pair = alone(scene, before, row)?;
    let there = match meeting(&pair, row)? {
        Some((moved, row)) => kick(&pair, &moved, &row),
        None => [Vector3::zeros(); 2],
    };
    let change = here.iter().zip(there).map(|(here, there)| (here - there).norm());
    let speed = change.fold(0.0, f64::max);
    (speed > NOTABLE * -row.velocity).then_some(speed)
}

/// The two bodies of a contact as a scene of their own.
fn alone(scene: &Scene, states: &[State], row: &Row) -> Option<Scene> {
    let [Some(first), Some(second)] = row.bodies else { return None };
    let bodies = [first, second];
    let surface = scene.pairs.get(&bodies).map(|surface| ([0, 1], *surface));
    Some(Scene {
        name: String::new(),
        title: String::new(),
        teaches: String::new(),
        gravity: scene.gravity,
        time: scene.time,
        driven: Vec::new(),
        step: scene.step.clone(),
        contact: scene.contact.clone(),
        solver: scene.solver.clone(),
        bodies: bodies.map(|body| scene.bodies[body].clone()).into(),
        states: bodies.map(|body| states[body]).into(),
        pairs: surface.into_iter().collect(),
        constraints: Vec::new(),
        memory: scene.memory,
        solvers: scene.solvers.clone(),
    })
}

/// The states in which the two bodies of a contact meet, with its row there; nothing where they
/// pass each other, and `None` where no row is left to tell. The normal turns on the way, so that
/// the gap does not close at a steady rate: t = c/|J u⁻| is Newton's first step, and a few more
/// follow.
fn meeting(pair: &Scene, row: &Row) -> Option<Option<(Vec<State>, Row)>> {
    let mut time = row.c / -row.velocity;
    for sweep in 1.. {
        let moved = pair.states.iter().map(|state| state.displaced(&(time * state.velocity())));
        let moved: Vec<State> = moved.collect();
        let found = step_contacts(pair, &moved);
        let there = Assembly::new(pair, &moved, &found, ConstraintFilter::Near).ok()?;
        let normals = there.rows.into_iter().filter(|own| own.kind == Kind::Normal);
        let own = normals.min_by(|a, b| a.c.total_cmp(&b.c))?;
        if own.velocity >= 0.0 {
            return Some(None);
        }
        if sweep == NEWTON_STEPS || own.c.abs() <= MET * row.c {
            return Some(Some((moved, own)));
        }
        time += own.c / -own.velocity;
    }
    None
}

/// What the bounce of a contact alone adds to the velocities of its two bodies (m/s).
fn kick(scene: &Scene, states: &[State], row: &Row) -> [Vector3<f64>; 2] {
    let response = |(body, jacobian): (usize, Vector6<f64>)| {
        scene.bodies[body].mass.accelerate(&states[body].pose, &jacobian)
    };
    let mobility: f64 = row.movers().map(|mover| mover.1.dot(&response(mover))).sum();
    let impulse = -(1.0 + scene.restitution(row.bodies)) * row.velocity_with(states) / mobility;
    row.bodies.map(|own| {
        let mover = row.movers().find(|(body, _)| Some(*body) == own);
        mover.map_or_else(Vector3::zeros, |mover| impulse * linear(&response(mover)))
    })
}
