//! How far normal velocities are off because the normal turns within a step.
//!
//! XPBD, the soft step and the penalty method push along the normal at the impact, but a step
//! reports what pushed with the rows at its beginning. If the bodies pass each other on one side,
//! the normal has turned until they meet, and J u and J u⁺ are off by about the same speed η. The
//! energy of the bodies shows it:
//!
//! ```text
//! Σ X η = ½ (u + u⁺)·M Δu − the work of gravity and other forces − ½ Σ X (J u + J u⁺)
//! ```
//!
//! with the sum over the rows of bodies that push each other. Bodies with joints or springs, and
//! those on a support that moves, exchange energy otherwise: for them η is 0.

use std::collections::BTreeMap;

use super::slip::{Contact, Totals};
use crate::assembly::Row;
use crate::body::{State, angular, linear};
use crate::scene::Scene;

/// η of each pair of bodies that push each other (m/s).
#[derive(Debug, Default)]
pub(super) struct NormalShifts(BTreeMap<[usize; 2], f64>);

impl NormalShifts {
    /// Those of a step that led from the first states to the second.
    pub fn of(scene: &Scene, [before, after]: [&[State]; 2], totals: &Totals) -> Self {
        let pushing: Vec<Contact> =
            totals.contacts().filter(|contact| contact.normal.1 > 0.0).collect();
        let pairs: Vec<[usize; 2]> = pushing.iter().map(|contact| contact.bodies).collect();
        let group = groups(scene, pairs.iter());
        let of_pair = |[a, b]: [usize; 2]| group[if moves(scene, a) { a } else { b }];
        let mut shifts = BTreeMap::new();
        for bodies in pairs.iter().copied() {
            let own = of_pair(bodies);
            let members = || pushing.iter().filter(|contact| of_pair(contact.bodies) == own);
            let is_alone = members().flat_map(|contact| contact.bodies).all(|body| {
                !has_joint(scene, body) && (moves(scene, body) || is_still(&after[body]))
            });
            if !is_alone {
                continue;
            }
            let rows = members().flat_map(|own| own.tangents.iter().copied().chain([own.normal]));
            let work = |(row, x): &(Row, f64)| 0.5 * x * (row.velocity + row.velocity_with(after));
            let gained = (0..scene.bodies.len()).filter(|&body| group[body] == own);
            let gained: f64 = gained.map(|body| work_on(scene, body, [before, after])).sum();
            let impulse: f64 = members().map(|contact| contact.normal.1).sum();
            shifts.insert(bodies, (gained - rows.map(work).sum::<f64>()) / impulse);
        }
        NormalShifts(shifts)
    }

    /// J u and J u⁺ of a normal row between these bodies.
    pub fn velocities(&self, bodies: [usize; 2], row: &Row, after: &[State]) -> [f64; 2] {
        let shift = self.0.get(&bodies).copied().unwrap_or(0.0);
        [row.velocity + shift, row.velocity_with(after) + shift]
    }
}

/// The work on a body in a step that is not that of gravity and of given forces (J).
fn work_on(scene: &Scene, body: usize, [before, after]: [&[State]; 2]) -> f64 {
    let own = &scene.bodies[body];
    let [u, then] = [before, after].map(|states| states[body].velocity());
    let given = own.wrench(&before[body].pose);
    let force = linear(&given) + own.mass.mass() * scene.gravity;
    let mean = 0.5 * (u + then);
    let work = force.dot(&linear(&mean)) + angular(&given).dot(&angular(&mean));
    own.mass.kinetic_energy(&after[body])
        - own.mass.kinetic_energy(&before[body])
        - scene.step.dt * work
}

fn moves(scene: &Scene, body: usize) -> bool {
    scene.bodies[body].mass.dof() > 0
}

fn is_still(state: &State) -> bool {
    state.velocity().norm() == 0.0
}

fn has_joint(scene: &Scene, body: usize) -> bool {
    scene.constraints.iter().any(|own| own.bodies().contains(&Some(body)))
}

/// The group of each body: those that push each other or have a joint.
pub(super) fn groups<'p>(scene: &Scene, pairs: impl Iterator<Item = &'p [usize; 2]>) -> Vec<usize> {
    let joints = scene.constraints.iter().filter_map(|own| match own.bodies() {
        [Some(a), Some(b)] => Some([a, b]),
        _ => None,
    });
    let both_move = |bodies: &[usize; 2]| bodies.iter().all(|&body| moves(scene, body));
    let mut groups: Vec<usize> = (0..scene.bodies.len()).collect();
    for bodies in pairs.copied().chain(joints).filter(both_move) {
        let [a, b] = bodies.map(|body| groups[body]);
        let later = groups.iter_mut().filter(|group| **group == a.max(b));
        later.for_each(|group| *group = a.min(b));
    }
    groups
}
