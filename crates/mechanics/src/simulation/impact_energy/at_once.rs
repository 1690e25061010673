//! The energy of impacts that a step resolves with impulses at fixed poses.
//!
//! A step at velocity level applies the law of restitution to the contacts that approach at its
//! beginning. A contact that closes only because of another impact in the same step has v⁺ = −c/dt
//! over a gap c, or v⁺ = 0: the step takes its approach for plastic, whatever e is. And friction
//! that opposes the slip after an impact may do work on the slip before it (Kane 1984).
//!
//! Energy is measured for each group of bodies that push each other, from the rows of the impulses
//! that were applied. v is the relative velocity, so that the work of a fixed body that moves, such
//! as a bat, does not count. Energy that goes into friction, joints, limits, springs or motors is
//! in rows of their own, and that of gravity's integration in none. What is slower than the speed
//! at which contacts bounce is plastic by choice, and its kinetic energy ½ v²/A_ii is not missed.

use std::collections::BTreeMap;

use super::{ImpactCause, ImpactEnergy};
use crate::assembly::{Assembly, Row, Source};
use crate::body::{State, angular, linear};
use crate::constraint::{Bounds, Kind};
use crate::formulation::{Problem, Stage};
use crate::scene::{ContactId, Scene};
use crate::simulation::Solve;
use crate::simulation::interpenetration::{faster_first, thickness};

/// Energies below this part of the kinetic energy and of the work of all impulses are rounding, and
/// so is this part of the speed below which nothing bounces.
const ROUNDING: f64 = 1e-11;
/// The factor on the solver's tolerance up to which its answer may be off.
const INEXACT: f64 = 10.0;
/// Energy from overlaps that are pushed apart counts from this part of the weights' work over the
/// thinner body on, and from this part of the kinetic energy of both bodies.
const NOTABLE: f64 = 1e-2;
/// A gap of up to this part of the thinner body is rounding: the bodies touch.
const TOUCHING: f64 = 1e-9;

/// The energies to report of the impulses that were applied, those of a solve.
pub(super) fn of_solve(scene: &Scene, states: &[State], solve: &Solve) -> Vec<ImpactEnergy> {
    let Solve { problem, solution, .. } = solve;
    if !matches!(problem.stage, Stage::Velocity | Stage::Impact | Stage::Restitution) {
        return Vec::new();
    }
    let impulses = Impulses::of(scene, states, problem, &solution.x);
    let mut found = impulses.of_bounces();
    let is_inexact = |own: &&mut ImpactEnergy| own.cause == ImpactCause::Inexact;
    if found.iter_mut().any(|own| is_inexact(&own)) && !solve.conflict(scene).is_empty() {
        let inexact = found.iter_mut().filter(is_inexact);
        inexact.for_each(|own| own.cause = ImpactCause::Contradicted);
    }
    found.extend(impulses.of_corrections());
    found
}

/// The impulses of a solve that were applied, and their contacts.
struct Impulses<'a> {
    scene: &'a Scene,
    states: &'a [State],
    problem: &'a Problem,
    /// The velocities after them.
    next: Vec<f64>,
    contacts: Vec<Contact>,
    /// The group of each block: bodies that push each other.
    groups: Vec<usize>,
}

/// A contact with an impulse.
struct Contact {
    id: ContactId,
    /// The place of its normal row.
    normal: usize,
    group: usize,
    /// Whether the pair keeps all energy, e = 1.
    is_elastic: bool,
    is_bounced: bool,
    /// Whether it bounced or approached too fast not to.
    is_fast: bool,
    /// The work of the normal impulse without that of feedback, and that of friction (J).
    work: f64,
    friction: f64,
    /// The work of feedback that pushes an overlap apart (J), and its speed (m/s).
    pushed: f64,
    speed: f64,
    /// The part of the work that a row which is not fulfilled has (J).
    inexact: f64,
    /// The size of what the work is a difference of (J).
    size: f64,
    /// The kinetic energy (J) that the contact may lose because what is slow does not bounce.
    slow: f64,
}

impl<'a> Impulses<'a> {
    fn of(scene: &'a Scene, states: &'a [State], problem: &'a Problem, x: &[f64]) -> Self {
        let efforts = problem.efforts(x);
        let next = problem.next_velocity(x, problem.dt);
        let assembly = &problem.assembly;
        let after = relative(assembly, &next);
        let free = relative(assembly, &problem.target);
        let groups = groups(assembly, &efforts);
        let mut contacts: Vec<Contact> = Vec::new();
        for (i, row) in assembly.rows.iter().enumerate() {
            let (Source::Contact(id), impulse) = (row.id.source, efforts[i]) else { continue };
            let work = 0.5 * impulse * (row.velocity + after[i]);
            let size = 0.5 * impulse.abs() * (row.velocity.abs() + after[i].abs());
            if let (Bounds::Friction { normal, .. }, Some(contact)) =
                (row.bounds, contacts.last_mut())
                && contact.normal == normal
            {
                contact.friction += work;
                contact.size += size;
            }
            let Some(part) = row.parts().next().filter(|_| row.kind == Kind::Normal) else {
                continue;
            };
            if impulse == 0.0 {
                continue;
            }
            let e = scene.restitution(row.bodies);
            let feedback = problem.bias[i] - row.drift;
            let is_bounced = problem.stage == Stage::Restitution
                && e > 0.0
                && row.velocity < 0.0
                && problem.bias[i] == e * row.velocity + row.drift;
            let pushes = !is_bounced && row.c < 0.0 && feedback < 0.0;
            let pushed = if pushes { -0.5 * impulse * feedback } else { 0.0 };
            let slow = slow(scene, row, free[i]);
            // What other impulses give it counts too: its speed if it did not push itself.
            let mobility = problem.lcp.matrix().diagonal(i);
            let approach = row.velocity.min(after[i] - mobility * impulse);
            let is_slow = !is_bounced && -approach < (1.0 + ROUNDING) * slow;
            contacts.push(Contact {
                id,
                normal: i,
                group: groups[part.block],
                is_elastic: e == 1.0,
                is_bounced,
                is_fast: !is_slow,
                work: work - pushed,
                friction: 0.0,
                pushed,
                speed: -feedback,
                inexact: 0.5 * impulse * (after[i] + feedback),
                size,
                slow: match is_slow {
                    true => 0.5 * slow * slow / mobility,
                    false => 0.0,
                },
            });
        }
        Impulses { scene, states, problem, next, contacts, groups }
    }

    /// The groups with a bounce, or without one that was due, whose energy changed at e = 1 or
    /// rose.
    fn of_bounces(&self) -> Vec<ImpactEnergy> {
        let groups = (0..self.groups.len()).filter(|&group| {
            let is_hit = |own: &Contact| own.is_bounced || own.is_elastic && own.is_fast;
            self.contacts.iter().any(|contact| contact.group == group && is_hit(contact))
        });
        groups.filter_map(|group| self.of_group(group)).collect()
    }

    fn of_group(&self, group: usize) -> Option<ImpactEnergy> {
        let own = || self.contacts.iter().filter(|contact| contact.group == group);
        let sum = |of: &dyn Fn(&Contact) -> f64| own().map(of).sum::<f64>();
        let size = sum(&|contact| contact.size);
        let inexact = sum(&|contact| contact.inexact.abs());
        let tolerated = inexact.min(INEXACT * self.scene.solver.tolerance * size);
        let rounding = ROUNDING * size.max(self.kinetic(|_| true));
        let least = rounding + tolerated + sum(&|contact| contact.slow);
        let normal = |contact: &Contact| if contact.is_elastic { contact.work } else { 0.0 };
        let all = |contact: &Contact| contact.work + contact.friction;
        let (elastic, total) = (sum(&normal), sum(&all));
        if elastic.abs() > least {
            return self.report(own(), elastic, &normal);
        }
        if total > least { self.report(own(), total, &all) } else { None }
    }

    /// A report of an energy, with the pair that has the largest part in it, and its first contact.
    fn report<'c>(
        &self,
        contacts: impl Iterator<Item = &'c Contact>,
        energy: f64,
        part: &dyn Fn(&Contact) -> f64,
    ) -> Option<ImpactEnergy> {
        let mut pairs: BTreeMap<[usize; 2], Vec<&Contact>> = BTreeMap::new();
        contacts.for_each(|contact| pairs.entry(contact.id.bodies).or_default().push(contact));
        let of_pair =
            |pair: &[&Contact]| pair.iter().map(|c| part(c)).sum::<f64>() * energy.signum();
        let pair = pairs.into_values().max_by(|a, b| of_pair(a).total_cmp(&of_pair(b)))?;
        let of = |contact: &Contact| part(contact) * energy.signum();
        let contact = pair.into_iter().max_by(|a, b| of(a).total_cmp(&of(b)))?;
        let gap = self.problem.assembly.rows[contact.normal].c;
        let cause = match contact {
            _ if contact.friction > contact.work.abs() => ImpactCause::Friction,
            _ if contact.is_bounced || contact.inexact.abs() > 0.5 * of(contact) => {
                ImpactCause::Inexact
            }
            _ if gap > TOUCHING * thickness(self.scene, contact.id.bodies) => {
                ImpactCause::GapClosed
            }
            _ => ImpactCause::NotBounced,
        };
        Some(self.found(contact, energy, cause))
    }

    /// The pairs to which feedback that pushes overlaps apart added much.
    fn of_corrections(&self) -> Vec<ImpactEnergy> {
        let mut pairs: BTreeMap<[usize; 2], (f64, &Contact)> = BTreeMap::new();
        let is_deep = |contact: &&Contact| {
            let gap = self.problem.assembly.rows[contact.normal].c;
            contact.pushed > 0.0 && -gap > TOUCHING * thickness(self.scene, contact.id.bodies)
        };
        for contact in self.contacts.iter().filter(is_deep) {
            let (sum, fastest) = pairs.entry(contact.id.bodies).or_insert((0.0, contact));
            *sum += contact.pushed;
            if contact.speed > fastest.speed {
                *fastest = contact;
            }
        }
        let is_much = |bodies: [usize; 2], energy: f64| {
            let mass: f64 = bodies.map(|body| self.scene.bodies[body].mass.mass()).iter().sum();
            let weight = mass * self.scene.gravity.norm() * thickness(self.scene, bodies);
            energy > NOTABLE * weight
                && energy > NOTABLE * self.kinetic(|body| bodies.contains(&body))
        };
        let pairs = pairs.into_iter().filter(|(bodies, (energy, _))| is_much(*bodies, *energy));
        let report = |(_, (energy, contact)): (_, (f64, &Contact))| {
            self.found(contact, energy, ImpactCause::PushedApart(contact.speed))
        };
        pairs.map(report).collect()
    }

    fn found(&self, contact: &Contact, energy: f64, cause: ImpactCause) -> ImpactEnergy {
        let bodies = faster_first(self.scene, self.states, contact.id.bodies);
        let gap = self.problem.assembly.rows[contact.normal].c;
        ImpactEnergy { energy, contact: contact.id, bodies, gap, cause }
    }

    /// The kinetic energy (J) of some bodies after the impulses.
    fn kinetic(&self, is_counted: impl Fn(usize) -> bool) -> f64 {
        let blocks = self.problem.assembly.blocks.iter();
        let of = |block: &crate::assembly::Block| {
            let u = block.gather(&self.next);
            let omega = angular(&u);
            0.5 * (block.mass * linear(&u).norm_squared() + omega.dot(&(block.inertia * omega)))
        };
        blocks.filter(|block| is_counted(block.body)).map(of).sum()
    }
}

/// J u of each row (m/s), fixed bodies that move included.
fn relative(assembly: &Assembly, u: &[f64]) -> Vec<f64> {
    let own = assembly.push_forward(u).into_iter().zip(&assembly.rows);
    own.map(|(speed, row)| speed + row.drift).collect()
}

/// The approach (m/s) up to which a contact does not bounce, or that forces alone give it within
/// the step; `free` is its velocity after them.
fn slow(scene: &Scene, row: &Row, free: f64) -> f64 {
    scene.plastic_speed() + (row.velocity - free).max(0.0)
}

/// The group of each block: those that impulses connect.
fn groups(assembly: &Assembly, efforts: &[f64]) -> Vec<usize> {
    let mut groups: Vec<usize> = (0..assembly.blocks.len()).collect();
    for (row, _) in assembly.rows.iter().zip(efforts).filter(|(_, effort)| **effort != 0.0) {
        let of: Vec<usize> = row.parts().map(|part| groups[part.block]).collect();
        if let [a, b] = of[..] {
            groups
                .iter_mut()
                .filter(|group| **group == a.max(b))
                .for_each(|group| *group = a.min(b));
        }
    }
    groups
}
