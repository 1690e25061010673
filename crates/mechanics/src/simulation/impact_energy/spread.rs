//! The energy of impacts that a scheme spreads over several steps, or takes without impulses at
//! fixed poses: the penalty method, XPBD, the soft step.
//!
//! An impact begins with the first step in which bodies that approach push each other, and ends
//! with the last step in which they do. Bodies that push each other, or have a joint, share their
//! impact. In each step the total impulse X of a contact, whatever substeps gave it, does the work
//!
//! ```text
//! ½ X (J u + J u⁺),      Σ over rows = ½ (u + u⁺)·M Δu − the work of gravity and other forces
//! ```
//!
//! exactly where J stays as it is, and with J u of [`NormalShifts`] where the normal turns. Its
//! part in compression, W_c < 0, and that in separation, W_r > 0, are related by e (Stronge 1990);
//! for two bodies alone this is Newton's law:
//!
//! ```text
//! W_r = −e² W_c
//! ```
//!
//! An error is tolerated up to [`TOLERATED`] of ½ Σ X (|J u| + |J u⁺|), which is at most 2 % of the
//! kinetic energy of a bounce, and up to the work of gravity and other forces over one step.

use std::collections::{BTreeMap, BTreeSet};

use super::{ImpactCause, ImpactEnergy};
use crate::assembly::{Row, Source};
use crate::body::{Body, State};
use crate::scene::{ContactId, Scene};
use crate::simulation::interpenetration::faster_first;
use crate::simulation::slip::Totals;
use crate::simulation::turned::{NormalShifts, groups};

/// The tolerated part of ½ Σ X (|J u| + |J u⁺|).
const TOLERATED: f64 = 5e-3;
/// An approach faster than this many times the speed that forces add in a step is an impact.
const FAST: f64 = 4.0;
/// The number of steps of slower motion after which bodies have come to rest.
const RESTING: usize = 10;

/// The impacts of a run that have not ended.
#[derive(Debug, Clone, Default)]
pub(in crate::simulation) struct SpreadImpacts(Vec<Open>);

/// An impact of a group of bodies that has not ended.
#[derive(Debug, Clone)]
struct Open {
    /// The numbers of the step in which it began and of the last one so far.
    steps: [usize; 2],
    /// For how many steps nothing has moved fast.
    still: usize,
    pairs: Pairs,
}

/// Pairs of bodies, in the order of the scene.
type Pairs = BTreeMap<[usize; 2], Pair>;

/// What two bodies did to each other, in a step or since the impact began.
#[derive(Debug, Clone, Copy)]
struct Pair {
    contact: ContactId,
    gap: f64,
    /// The speeds of approach before a step and of parting after it (m/s), the largest.
    approach: f64,
    parting: f64,
    /// Σ X of the normals (N s).
    impulse: f64,
    /// The work of the normals, W_c and W_r, that of friction, and ½ Σ X (|J u| + |J u⁺|) (J).
    compression: f64,
    restitution: f64,
    friction: f64,
    size: f64,
}

impl SpreadImpacts {
    /// Takes a step into account; returns the energies to report of the impacts that have ended.
    pub fn add(
        &mut self,
        scene: &Scene,
        step: usize,
        totals: &Totals,
        shifts: &NormalShifts,
        after: &[State],
    ) -> Vec<ImpactEnergy> {
        let pairs = pairs(totals, shifts, after);
        let groups = groups(scene, pairs.keys());
        let group = |bodies: &[usize; 2]| {
            let moving = bodies.iter().find(|&&body| scene.bodies[body].mass.dof() > 0);
            groups[*moving.unwrap_or(&bodies[0])]
        };
        let is_touching = |open: &Open| open.pairs.keys().any(|bodies| pairs.contains_key(bodies));
        let (going, mut ended): (Vec<Open>, Vec<Open>) =
            std::mem::take(&mut self.0).into_iter().partition(is_touching);
        for own in pairs.keys().map(group).collect::<BTreeSet<usize>>() {
            let members = pairs.iter().filter(|(bodies, _)| group(bodies) == own);
            let members: Pairs = members.map(|(bodies, pair)| (*bodies, *pair)).collect();
            let is_here = |open: &&Open| open.pairs.keys().any(|pair| members.contains_key(pair));
            let known: Vec<&Open> = going.iter().filter(is_here).collect();
            let Some(open) = Open::after(scene, step, &known, members) else { continue };
            match open.still >= RESTING {
                true => ended.push(open),
                false => self.0.push(open),
            }
        }
        ended.iter().filter_map(|open| open.report(scene, after)).collect()
    }
}

impl Open {
    /// The impact of a group in a step, as it goes on from those that are known; `None` where
    /// nothing was hit.
    fn after(scene: &Scene, step: usize, known: &[&Open], members: Pairs) -> Option<Open> {
        let slow = scene.plastic_speed().max(FAST * acceleration(scene) * scene.step.dt);
        let is_hit = members.values().any(|pair| pair.approach > slow);
        if known.is_empty() && !is_hit {
            return None;
        }
        let is_moving = members.values().any(|pair| pair.approach.max(pair.parting) > slow);
        let before = known.iter().map(|open| open.still).min().unwrap_or(0);
        let mut open = Open {
            steps: [known.iter().map(|open| open.steps[0]).min().unwrap_or(step), step],
            still: if is_moving { 0 } else { before + 1 },
            pairs: known.iter().flat_map(|open| open.pairs.clone()).collect(),
        };
        for (bodies, pair) in members {
            open.pairs.entry(bodies).and_modify(|own| own.add(&pair)).or_insert(pair);
        }
        Some(open)
    }

    fn report(&self, scene: &Scene, states: &[State]) -> Option<ImpactEnergy> {
        let sum = |of: &dyn Fn(&Pair) -> f64| self.pairs.values().map(of).sum::<f64>();
        let forces = acceleration(scene) * scene.step.dt * sum(&|pair| pair.impulse);
        let least = TOLERATED * sum(&|pair| pair.size) + 0.5 * forces;
        let error = |pair: &Pair| pair.error(scene);
        if sum(&error).abs() > least {
            return self.found(scene, states, &error);
        }
        let all = |pair: &Pair| pair.compression + pair.restitution + pair.friction;
        if sum(&all) > least { self.found(scene, states, &all) } else { None }
    }

    /// The report of an energy, with the pair that has the largest part in it.
    fn found(
        &self,
        scene: &Scene,
        states: &[State],
        part: &dyn Fn(&Pair) -> f64,
    ) -> Option<ImpactEnergy> {
        let energy: f64 = self.pairs.values().map(part).sum();
        let of = |pair: &Pair| part(pair) * energy.signum();
        let pair = self.pairs.values().max_by(|a, b| of(a).total_cmp(&of(b)))?;
        let bodies = faster_first(scene, states, pair.contact.bodies);
        let cause = ImpactCause::Spread(self.steps);
        Some(ImpactEnergy { energy, contact: pair.contact, bodies, gap: pair.gap, cause })
    }
}

impl Pair {
    /// Adds another contact of the same step, or what happened in a later one.
    fn add(&mut self, other: &Pair) {
        self.impulse += other.impulse;
        self.compression += other.compression;
        self.restitution += other.restitution;
        self.friction += other.friction;
        self.size += other.size;
    }

    /// Adds another contact of the same step.
    fn join(&mut self, other: &Pair) {
        if other.approach > self.approach {
            (self.contact, self.gap) = (other.contact, other.gap);
        }
        self.approach = self.approach.max(other.approach);
        self.parting = self.parting.max(other.parting);
        self.add(other);
    }

    /// W_r + e² W_c (J).
    fn error(&self, scene: &Scene) -> f64 {
        let e = scene.restitution(self.contact.bodies.map(Some));
        self.restitution + e * e * self.compression
    }
}

/// What pairs of bodies did to each other in a step that led to these states.
fn pairs(totals: &Totals, shifts: &NormalShifts, after: &[State]) -> Pairs {
    let mut pairs = Pairs::new();
    for contact in totals.contacts() {
        let (row, impulse) = contact.normal;
        let Source::Contact(id) = row.id.source else { continue };
        if *impulse <= 0.0 {
            continue;
        }
        let [before, then] = shifts.velocities(contact.bodies, row, after);
        let [compression, restitution] = work(*impulse, [before, then]);
        let friction =
            |own: &&(Row, f64)| 0.5 * own.1 * (own.0.velocity + own.0.velocity_with(after));
        let own = Pair {
            contact: id,
            gap: row.c,
            approach: -before,
            parting: then,
            impulse: *impulse,
            compression,
            restitution,
            friction: contact.tangents.iter().map(friction).sum(),
            size: 0.5 * impulse * (before.abs() + then.abs()),
        };
        pairs.entry(contact.bodies).and_modify(|pair| pair.join(&own)).or_insert(own);
    }
    pairs
}

/// The work (J) of an impulse while the velocity goes from the first value to the second: the part
/// below 0 and the part above.
fn work(impulse: f64, [before, after]: [f64; 2]) -> [f64; 2] {
    let half = 0.5 * impulse;
    if before * after >= 0.0 {
        let work = half * (before + after);
        return [work.min(0.0), work.max(0.0)];
    }
    let [low, high] = [before.min(after), before.max(after)];
    [-half * low * low / (high - low), half * high * high / (high - low)]
}

/// The largest acceleration (m/s²) that gravity and other forces give a body.
fn acceleration(scene: &Scene) -> f64 {
    let moving = scene.bodies.iter().filter(|body| body.mass.mass() > 0.0);
    let of = |body: &Body| (scene.gravity + body.force / body.mass.mass()).norm();
    moving.map(of).fold(0.0, f64::max)
}
