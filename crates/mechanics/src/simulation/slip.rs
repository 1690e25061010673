//! Deviation of friction from Coulomb's law, for every scheme and friction model.
//!
//! ```text
//! Coulomb   x_t = −μ x_n s/|s|   where the contact slips with s,   |x_t| ≤ μ x_n   where it does not
//! ```
//!
//! Contacts of two bodies may share their load in many ways, so what counts is the sum over the
//! contacts of a pair that slip, and over those that do not. x are the impulses of the step, s is
//! the slip at its end.
//!
//! If friction carries load that it should not (for instance across a groove), the normal forces
//! would carry it instead, and friction along the groove would grow with them. The error of a step
//! includes this response δ of the normal impulses (δ ≥ −x_n; bodies are treated as point masses):
//!
//! ```text
//! n·Δv = 0,   m Δv = Σ −(x_t − x_t') + δ (n − μ s/|s|)          x_t' = Coulomb's, n: the mean normal
//! ```
//!
//! Under anisotropic friction the tangents of a contact have different lengths, so that its ellipse
//! is a disk in the coordinates of its rows ([`friction`](crate::constraint)). Angles and the cone
//! are taken in these coordinates; errors and paths are those of the world.
//!
//! In a single step, contacts that slip more slowly than a resting contact may count as at rest: s
//! is then mostly the error of the step. Over a run such errors cancel, and the distance of a body
//! that creeps grows. Coulomb's law allows no slip, however slow, against less friction than μ x_n.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use super::events::Impulses;
use super::interpenetration::faster_first;
use super::{Solve, Step, StepEvent};
use crate::assembly::{Row, RowId};
use crate::body::State;
use crate::constraint::{Bounds, Kind};
use crate::scene::Scene;

/// Friction below this fraction of its limit has no reliable direction.
const STRONG: f64 = 0.5;

/// Smaller speeds, relative to the fastest body, are not reported.
const NOTABLE: f64 = 1e-2;

/// Slip below this fraction of the speed of a resting contact is rounding.
const CREEPING: f64 = 1e-3;
/// Shorter distances, relative to the thinnest body, are not reported as creep.
const CREPT: f64 = 1e-2;

/// Normals whose mean is longer than this are of one side.
const ONE_SIDED: f64 = 0.5;

/// Sweeps for what the normals answer, at most; and until they change by less than this part of
/// the largest error.
const ANSWER_SWEEPS: usize = 100;
const ANSWERED: f64 = 1e-6;

/// How far the friction of two bodies in a step is from Coulomb's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slip {
    /// Both bodies, the one that moves, or moves faster, first.
    pub bodies: [usize; 2],
    /// The angle (rad) between friction and the direction opposite to sliding, if the contacts
    /// slide against friction that is strong enough to have a direction.
    pub angle: Option<f64>,
    /// How far the friction of all contacts together is outside the cone, relative to μ x_n; that
    /// of a single contact may be farther outside.
    pub excess: f64,
    /// The largest speed (m/s) at which a contact that carries a load and slides at v separates, at
    /// most μ v: the associated cone demands it, Coulomb's law has 0.
    pub separation: f64,
    /// The impulse (N s, world) on the first body by which the step differs from one under
    /// Coulomb's law: that of friction and of the normals that answer it.
    pub error: Vector3<f64>,
    /// What the contacts that slip too slowly to count as sliding did, if any did.
    pub creep: Option<Creep>,
}

/// The motion of two bodies whose contacts slip too slowly to count as sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Creep {
    /// Both bodies, the one that moves, or moves faster, first.
    pub bodies: [usize; 2],
    /// How far the first body moved along the other (m, world).
    pub path: Vector3<f64>,
    /// The impulse of friction against the slip (N s).
    pub friction: f64,
    /// μ x_n of the same contacts (N s), which Coulomb's law demands of `friction`.
    pub limit: f64,
}

impl Creep {
    /// The friction as a part of that of a contact that slides under Coulomb's law.
    pub fn strength(&self) -> f64 {
        self.friction / self.limit
    }

    fn add(&mut self, other: &Creep) {
        let is_same = self.bodies == other.bodies;
        self.path += if is_same { other.path } else { -other.path };
        self.friction += other.friction;
        self.limit += other.limit;
    }
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
            let sums = pairs.entry(contact.bodies).or_default();
            sums.ellipse = ellipse(&contact.tangents);
            sums.add(limit, push, slip, scene.resting().speed);
            sums.load += contact.normal.1.max(0.0) * contact.normal.0.pushes()[1];
            sums.weight += contact.normal.1.max(0.0);
            if contact.normal.1 > 0.0 {
                let parting = contact.normal.0.velocity_with(after).min(mu * slip.norm());
                sums.separation = sums.separation.max(parting);
            }
        }
        let errors = answered(scene, &pairs);
        let pairs = pairs.into_iter().zip(errors);
        pairs.map(|((bodies, sums), error)| sums.slip(scene, after, bodies, error)).collect()
    }
}

/// The friction of a run beside Coulomb's law.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::{Creep, Simulation, Slips};
/// use lcplab_solver::Dantzig;
/// use nalgebra::Vector3;
///
/// // Nothing slides in a stack of balls.
/// let mut simulation = Simulation::new(Scene::load("fig7")?, Box::new(Dantzig::default()));
/// let mut slips = Slips::default();
/// slips.add(&simulation.step().expect("a step that can be taken"));
/// let scene = simulation.scene();
/// assert!(slips.notable_separation(scene).is_none() && slips.notable_creep(scene).is_none());
/// assert!(slips.speed_error(scene).is_none());
///
/// // A body that crept by 1 cm against 3 of the 4 N s that Coulomb's law demands.
/// let creep = Creep { bodies: [1, 0], path: 0.01 * Vector3::x(), friction: 3.0, limit: 4.0 };
/// assert_eq!(creep.strength(), 0.75);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Slips {
    /// The pair and step with the largest angle between friction and the direction opposite to
    /// sliding; nothing if no contact slides.
    pub friction_angle: Option<Slip>,
    /// The pair and step whose friction was farthest outside the cone, if any was.
    pub cone_excess: Option<Slip>,
    /// The pair and step with the largest separation of a contact that slides, if any separated.
    pub separation: Option<Slip>,
    /// The sum of the impulse errors on each body (N s).
    errors: BTreeMap<usize, Vector3<f64>>,
    /// What each pair of bodies, in the order of the scene, crept.
    creeps: BTreeMap<[usize; 2], Creep>,
    /// The largest speed of a body (m/s).
    fastest: f64,
}

impl Slips {
    /// Takes a step into account.
    pub fn add(&mut self, step: &Step) {
        for own in &step.slips {
            if own.angle > self.friction_angle.and_then(|slip| slip.angle) {
                self.friction_angle = Some(*own);
            }
            if own.excess > self.cone_excess.map_or(0.0, |slip| slip.excess) {
                self.cone_excess = Some(*own);
            }
            if own.separation > self.separation.map_or(0.0, |slip| slip.separation) {
                self.separation = Some(*own);
            }
            let [first, second] = own.bodies;
            if let Some(creep) = own.creep {
                let pair = [first.min(second), first.max(second)];
                self.creeps.entry(pair).and_modify(|sum| sum.add(&creep)).or_insert(creep);
            }
            *self.errors.entry(first).or_default() += own.error;
            *self.errors.entry(second).or_default() -= own.error;
        }
        let speeds = step.states.iter().map(|state| state.v.norm());
        self.fastest = speeds.fold(self.fastest, f64::max);
    }

    /// The pair that friction separates fastest, if that is faster than a resting contact may be,
    /// and than 1 % of the speed of the fastest body.
    pub fn notable_separation(&self, scene: &Scene) -> Option<Slip> {
        let least = scene.resting().speed.max(NOTABLE * self.fastest);
        self.separation.filter(|slip| slip.separation > least)
    }

    /// The pair that crept farthest against friction that is at least 1 % below Coulomb's, if it
    /// crept by more than a hundredth of the thinnest body.
    pub fn notable_creep(&self, scene: &Scene) -> Option<Creep> {
        let least = CREPT * scene.thinnest().unwrap_or(1.0);
        let is_notable =
            |creep: &&Creep| creep.path.norm() > least && creep.strength() < 1.0 - NOTABLE;
        let notable = self.creeps.values().filter(is_notable);
        notable.max_by(|a, b| a.path.norm().total_cmp(&b.path.norm())).copied()
    }

    /// An estimate of how much the wrong friction changed the velocity of a body over the run
    /// (m/s), for the body with the largest change: the sum of the impulse errors divided by its
    /// mass, without joints and rotation. `None` where it is less than a resting contact may have,
    /// or less than 1 % of the speed of the fastest body.
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
    /// Σ μ x_n, Σ −x_t·s/|s| and Σ μ x_n s of those of the others that slip at all.
    creeping_limit: f64,
    creeping: f64,
    creeping_slip: Vector3<f64>,
    /// Σ x_n n and Σ x_n.
    load: Vector3<f64>,
    weight: f64,
    /// That of the contact that separates fastest.
    separation: f64,
    /// From the coordinates of the rows to pushes in the world.
    ellipse: Matrix3<f64>,
}

impl Sums {
    fn add(&mut self, limit: f64, push: Vector3<f64>, slip: Vector3<f64>, least: f64) {
        // A tangent of the length l measures l times the slip.
        let slipped = self.ellipse.try_inverse().map_or(slip, |inverse| inverse * slip);
        if slipped.norm() > least {
            self.limit += limit;
            self.sliding += push;
            self.coulomb -= limit * slip.normalize();
        } else {
            self.holding_limit += limit;
            self.holding += push;
            if slipped.norm() > CREEPING * least {
                self.creeping_limit += limit;
                self.creeping -= push.dot(&slip.normalize());
                self.creeping_slip += limit * slipped;
            }
        }
    }

    /// Of each, how far its friction reaches out of the cone.
    fn cone_excess(&self) -> [f64; 2] {
        let excess = |push: &Vector3<f64>, limit: f64| (push.norm() - limit).max(0.0);
        [excess(&self.sliding, self.limit), excess(&self.holding, self.holding_limit)]
    }

    /// By how much friction differs from Coulomb's.
    fn error(&self) -> Vector3<f64> {
        let [_, holds] = self.cone_excess();
        let too_much = self.holding.try_normalize(0.0).map_or(Vector3::zeros(), |d| holds * d);
        self.ellipse * (self.sliding - self.coulomb + too_much)
    }

    /// The mean normal, and it with the friction of a contact that slips, for a unit of x_n; `None`
    /// where the normals take each other away, as those around a shaft.
    fn normal(&self) -> Option<[Vector3<f64>; 2]> {
        let normal = self.load / self.weight;
        (normal.norm() > ONE_SIDED)
            .then(|| [normal, normal + self.ellipse * self.coulomb / self.weight])
    }

    fn slip(
        &self,
        scene: &Scene,
        after: &[State],
        [first, second]: [usize; 2],
        error: Vector3<f64>,
    ) -> Slip {
        let is_strong = self.sliding.norm() > STRONG * self.limit && self.limit > 0.0;
        let angle = is_strong.then(|| self.sliding.angle(&self.coulomb));
        let [slides, holds] = self.cone_excess();
        let part = |excess: f64, limit: f64| if limit > 0.0 { excess / limit } else { 0.0 };
        let bodies = faster_first(scene, after, [first, second]);
        let is_swapped = bodies[0] == second;
        let creep = (self.creeping_limit > 0.0).then(|| {
            let path = scene.step.dt * self.creeping_slip / self.creeping_limit;
            Creep {
                bodies,
                path: if is_swapped { path } else { -path },
                friction: self.creeping,
                limit: self.creeping_limit,
            }
        });
        Slip {
            bodies,
            angle,
            excess: part(slides, self.limit).max(part(holds, self.holding_limit)),
            separation: self.separation,
            error: if is_swapped { error } else { -error },
            creep,
        }
    }
}

/// The errors of all pairs with what their normals answer, as pushes on the second bodies.
fn answered(scene: &Scene, pairs: &BTreeMap<[usize; 2], Sums>) -> Vec<Vector3<f64>> {
    let mut errors: Vec<Vector3<f64>> = pairs.values().map(Sums::error).collect();
    let largest = errors.iter().map(Vector3::norm).fold(0.0, f64::max);
    let normals: Vec<_> = pairs.values().map(Sums::normal).collect();
    let lightness = |body: usize| {
        let mass = &scene.bodies[body].mass;
        if mass.dof() > 0 && mass.mass() > 0.0 { mass.mass().recip() } else { 0.0 }
    };
    // The change of each velocity without the errors.
    let mut changes: BTreeMap<usize, Vector3<f64>> = BTreeMap::new();
    let push = |changes: &mut BTreeMap<usize, Vector3<f64>>, bodies: &[usize; 2], by| {
        let [first, second] = *bodies;
        *changes.entry(first).or_default() -= lightness(first) * by;
        *changes.entry(second).or_default() += lightness(second) * by;
    };
    for (bodies, error) in pairs.keys().zip(&errors) {
        push(&mut changes, bodies, -error);
    }
    let mut answers = vec![0.0_f64; errors.len()];
    for _ in 0..ANSWER_SWEEPS {
        let mut moved = 0.0_f64;
        for (k, (bodies, sums)) in pairs.iter().enumerate() {
            let Some([normal, with_friction]) = normals[k] else { continue };
            let mobility = normal.norm_squared() * bodies.map(lightness).iter().sum::<f64>();
            if mobility == 0.0 {
                continue;
            }
            let parting = normal.dot(&(changes[&bodies[1]] - changes[&bodies[0]]));
            let answer = (answers[k] - parting / mobility).max(-sums.weight);
            let more = answer - answers[k];
            push(&mut changes, bodies, more * with_friction);
            (errors[k], answers[k]) = (errors[k] - more * with_friction, answer);
            moved = moved.max(more.abs());
        }
        if moved <= ANSWERED * largest {
            break;
        }
    }
    errors
}

/// A vector with these components along the directions of rows.
fn sum(rows: &[&(Row, f64)], component: impl Fn(&(Row, f64)) -> f64) -> Vector3<f64> {
    let along = |row: &&(Row, f64)| component(row) * row.0.pushes()[1].normalize();
    rows.iter().map(along).sum()
}

/// The map that multiplies what lies along each tangent by the length of this tangent.
fn ellipse(tangents: &[&(Row, f64)]) -> Matrix3<f64> {
    let stretch = |row: &&(Row, f64)| {
        let tangent = row.0.pushes()[1];
        let length = tangent.norm();
        tangent * tangent.transpose() * ((length - 1.0) / (length * length))
    };
    Matrix3::identity() + tangents.iter().map(stretch).sum::<Matrix3<f64>>()
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
    /// Those of a step: of its acts, or if they were not recorded of its solves and of what it
    /// says that was pushed.
    pub fn of(
        scene: &Scene,
        events: Option<&[StepEvent]>,
        solves: &[Solve],
        pushed: &[(Row, f64)],
    ) -> Self {
        let mut totals = Totals::default();
        match events {
            Some(events) => {
                for impulses in events.iter().filter_map(|event| Impulses::of(scene, event, solves))
                {
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
