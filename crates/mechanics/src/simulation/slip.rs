//! The friction of two bodies beside Coulomb's law, whatever the scheme and the model.
//!
//! ```text
//! Coulomb   x_t = −μ x_n s/|s|   where the contact slips with s,   |x_t| ≤ μ x_n   where it does not
//! ```
//!
//! Contacts of two bodies may share their load in many ways, so what counts is the sum over the
//! contacts of a pair that slip, and over those that do not. x are the impulses of the step, s is
//! the slip at its end.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::acts::Impulses;
use super::interpenetration::faster_first;
use super::{Act, Solve, Step};
use crate::assembly::{Row, RowId};
use crate::body::State;
use crate::constraint::{Bounds, Kind};
use crate::scene::Scene;

/// Friction below this part of its limit has no direction worth a word.
const STRONG: f64 = 0.5;

/// A speed below this part of the fastest one is not worth a word.
const NOTABLE: f64 = 1e-2;

/// How far the friction of two bodies in a step is from Coulomb's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slip {
    /// Both bodies, the one that moves, or moves faster, first.
    pub bodies: [usize; 2],
    /// The angle (rad) between friction and the line of the slip; 0 where nothing slips.
    pub angle: f64,
    /// How far friction reaches out of the cone, in parts of μ x_n.
    pub excess: f64,
    /// The impulse (N s, world) on the first body by which friction differs from Coulomb's.
    pub error: Vector3<f64>,
}

impl Slip {
    /// Those of a step that led to these states, a pair of bodies each.
    pub(super) fn of(scene: &Scene, totals: &Totals, after: &[State]) -> Vec<Slip> {
        let mut pairs: BTreeMap<[usize; 2], Sums> = BTreeMap::new();
        for contact in totals.contacts() {
            let Some(second) = contact.tangents.first() else { continue };
            let Bounds::Friction { mu, .. } = second.0.bounds else { continue };
            let limit = mu * contact.normal.1.max(0.0);
            let push = sum(&contact.tangents, |(_, impulse)| *impulse);
            let slip = sum(&contact.tangents, |(row, _)| row.velocity_with(after));
            pairs.entry(contact.bodies).or_default().add(limit, push, slip, scene.resting().speed);
        }
        let slips = pairs.into_iter().map(|(bodies, sums)| sums.slip(scene, after, bodies));
        slips.collect()
    }
}

/// The friction of a run beside Coulomb's law.
#[derive(Debug, Clone, Default)]
pub struct Slips {
    /// The pair and step whose friction acted farthest beside the line of the slip.
    pub askew: Option<Slip>,
    /// Those whose friction reached farthest out of the cone.
    pub beyond: Option<Slip>,
    /// What friction did to each body beside Coulomb's law, in all steps together (N s).
    errors: BTreeMap<usize, Vector3<f64>>,
    /// The largest speed of a body (m/s).
    fastest: f64,
}

impl Slips {
    /// Takes a step into account.
    pub fn add(&mut self, step: &Step) {
        let larger = |own: &Slip, known: &Option<Slip>, of: fn(&Slip) -> f64| {
            of(own) > known.as_ref().map_or(0.0, of)
        };
        for own in &step.slips {
            if larger(own, &self.askew, |slip| slip.angle) {
                self.askew = Some(*own);
            }
            if larger(own, &self.beyond, |slip| slip.excess) {
                self.beyond = Some(*own);
            }
            let [first, second] = own.bodies;
            *self.errors.entry(first).or_default() += own.error;
            *self.errors.entry(second).or_default() -= own.error;
        }
        let speeds = step.states.iter().map(|state| state.v.norm());
        self.fastest = speeds.fold(self.fastest, f64::max);
    }

    /// The body whose speed friction beside Coulomb's law changed most, and by how much (m/s) over
    /// the run; an upper bound, for a body that is faster or slower meets other friction
    /// afterwards. `None` where it is less than a resting contact may have, or a part of 1 % of the
    /// fastest body.
    pub fn speed_error(&self, scene: &Scene) -> Option<(usize, f64)> {
        let speed = |(&body, error): (&usize, &Vector3<f64>)| {
            let mass = scene.bodies[body].mass.mass();
            (mass > 0.0).then(|| (body, error.norm() / mass))
        };
        let largest = self.errors.iter().filter_map(speed).max_by(|a, b| a.1.total_cmp(&b.1));
        largest.filter(|(_, error)| *error > scene.resting().speed.max(NOTABLE * self.fastest))
    }
}

/// The friction of the contacts of two bodies, as pushes on the second one.
#[derive(Debug, Default)]
struct Sums {
    /// Σ μ x_n, Σ x_t and Coulomb's Σ x_t of those that slip.
    limit: f64,
    sliding: Vector3<f64>,
    coulomb: Vector3<f64>,
    /// Σ μ x_n and Σ x_t of the others.
    holding_limit: f64,
    holding: Vector3<f64>,
}

impl Sums {
    fn add(&mut self, limit: f64, push: Vector3<f64>, slip: Vector3<f64>, least: f64) {
        if slip.norm() > least {
            self.limit += limit;
            self.sliding += push;
            self.coulomb -= limit * slip.normalize();
        } else {
            self.holding_limit += limit;
            self.holding += push;
        }
    }

    fn slip(&self, scene: &Scene, after: &[State], [first, second]: [usize; 2]) -> Slip {
        let is_strong = self.sliding.norm() > STRONG * self.limit && self.limit > 0.0;
        let angle = if is_strong { self.sliding.angle(&self.coulomb) } else { 0.0 };
        let beyond = |push: &Vector3<f64>, limit: f64| (push.norm() - limit).max(0.0);
        let [slides, holds] =
            [beyond(&self.sliding, self.limit), beyond(&self.holding, self.holding_limit)];
        let part = |beyond: f64, limit: f64| if limit > 0.0 { beyond / limit } else { 0.0 };
        let too_much = self.holding.try_normalize(0.0).map_or(Vector3::zeros(), |d| holds * d);
        let error = self.sliding - self.coulomb + too_much;
        let bodies = faster_first(scene, after, [first, second]);
        Slip {
            bodies,
            angle,
            excess: part(slides, self.limit).max(part(holds, self.holding_limit)),
            error: if bodies[0] == second { error } else { -error },
        }
    }
}

/// A vector with these components along the directions of rows.
fn sum(rows: &[&(Row, f64)], component: impl Fn(&(Row, f64)) -> f64) -> Vector3<f64> {
    let along = |row: &&(Row, f64)| component(row) * row.0.pushes()[1];
    rows.iter().map(along).sum()
}

/// The impulse of each row in a step, of all that acted; a row is as it was first.
#[derive(Debug, Default)]
pub(super) struct Totals(BTreeMap<RowId, (Row, f64)>);

/// A contact with its rows and their impulses.
pub(super) struct Contact<'a> {
    pub bodies: [usize; 2],
    pub normal: &'a (Row, f64),
    pub tangents: Vec<&'a (Row, f64)>,
}

impl Totals {
    /// Those of a step: of its acts, or where nobody wrote them down of its solves and of what it
    /// says that was pushed.
    pub fn of(
        scene: &Scene,
        acts: Option<&[Act]>,
        solves: &[Solve],
        pushed: &[(Row, f64)],
    ) -> Self {
        let mut totals = Totals::default();
        match acts {
            Some(acts) => {
                for impulses in acts.iter().filter_map(|act| Impulses::of(scene, act, solves)) {
                    totals.add(impulses.assembly.rows.iter().zip(impulses.x.iter().copied()));
                }
            }
            None => {
                for Solve { problem, solution, impulse_factor, .. } in solves {
                    let x = problem.efforts(&solution.x).into_iter().map(|x| impulse_factor * x);
                    totals.add(problem.assembly.rows.iter().zip(x));
                }
                totals.add(pushed.iter().map(|(row, impulse)| (row, *impulse)));
            }
        }
        totals
    }

    fn add<'r>(&mut self, rows: impl Iterator<Item = (&'r Row, f64)>) {
        for (row, impulse) in rows {
            self.0.entry(row.id).or_insert_with(|| (row.clone(), 0.0)).1 += impulse;
        }
    }

    /// The rows with their impulses (N s, N m s).
    pub fn rows(&self) -> impl Iterator<Item = &(Row, f64)> {
        self.0.values()
    }

    /// The contacts.
    pub fn contacts(&self) -> impl Iterator<Item = Contact<'_>> {
        let of_contact = |normal| -> Option<Contact<'_>> {
            let (row, _): &(Row, f64) = normal;
            let [Some(first), Some(second)] = row.bodies else { return None };
            let tangents =
                [1, 2].map(|component| self.0.get(&RowId { source: row.id.source, component }));
            let tangents = tangents.into_iter().flatten().collect();
            (row.kind == Kind::Normal).then_some(Contact {
                bodies: [first, second],
                normal,
                tangents,
            })
        };
        self.0.values().filter_map(of_contact)
    }
}
