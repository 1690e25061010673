//! Which laws a run kept, measured from its motion alone, so that it holds of every scheme.
//!
//! Energy stays where nothing takes or gives it, and never grows where nothing drives. Momentum
//! stays where nothing outside pushes. A blow parts bodies at e times their approach, and friction
//! acts along the line of the slip, within the cone.

use lcplab_mechanics::body::State;
use lcplab_mechanics::constraint::{Bounds, Row};
use lcplab_mechanics::scene::Scene;
use lcplab_mechanics::simulation::{
    Blow, Blows, ImpactEnergy, InterpenetrationKind, Ledger, Motion, Slips, Step,
};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A law is kept if what is missing is at most this part of what there is.
pub const KEPT: f64 = 0.01;
/// Friction that is so many degrees beside the line of the slip misses it.
pub const ASKEW: f64 = 5.0;

/// What energy may do in a scene.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Energy {
    /// It stays: nothing rubs, no blow has e < 1, nothing damps and nothing drives.
    #[default]
    Stays,
    /// It may become less.
    Falls,
    /// A motor, a force or a support that moves may give it.
    Changes,
}

/// What a run measured of the laws.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Laws {
    /// What energy may do.
    pub energy: Energy,
    /// The largest kinetic energy (J), of which a change of energy is a part.
    pub kinetic: f64,
    /// The account of the ledger that holds most of the change, and its energy (J); none where the
    /// scheme has no ledger.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub account: Option<(String, f64)>,
    /// What happened in the first impact whose energy is not what e says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impact: Option<String>,
    /// How often a body went through another one within a step.
    pub passages: usize,
    /// What is missing of the momentum at the end, as a part of the largest one; none where
    /// something outside pushes.
    pub momentum: Option<f64>,
    /// The same of the angular momentum, without gravity.
    pub angular_momentum: Option<f64>,
    /// The largest |v⁺ + e v⁻| of a blow, as a part of its approach; none without a blow.
    pub restitution: Option<f64>,
    /// The largest angle between friction and the line of the slip (degrees); none where nothing
    /// slips.
    pub askew: Option<f64>,
    /// How far friction reached out of the cone, as a part of μ x_n.
    pub beyond: f64,
}

impl Laws {
    /// Whether the energy at the end, changed by so much (J), is one that it may be.
    pub fn keeps_energy(&self, change: f64) -> bool {
        let allowed = KEPT * self.kinetic;
        match self.energy {
            Energy::Stays => change.abs() <= allowed,
            Energy::Falls => change <= allowed,
            Energy::Changes => true,
        }
    }
}

/// The laws of a run under way.
pub(super) struct Watch {
    first: Motion,
    is_driven: bool,
    is_lossy: bool,
    is_alone: bool,
    kinetic: f64,
    ledger: Option<Ledger>,
    impact: Option<String>,
    passages: usize,
    slips: Slips,
    blows: Blows,
    restitution: Option<f64>,
}

impl Watch {
    pub fn new(scene: &Scene, first: Motion) -> Self {
        let joints = || scene.constraints.iter();
        let rows = || joints().flat_map(|joint| rows(scene, joint.bodies(), &**joint));
        let moves = |body: Option<usize>| body.is_some_and(|k| scene.bodies[k].mass.dof() > 0);
        let pushed = |k: usize| {
            let body = &scene.bodies[k];
            let still = State { pose: scene.states[k].pose, ..State::WORLD };
            let is_moved = body.mass.dof() == 0 && scene.states[k].velocity() != still.velocity();
            body.force != Vector3::zeros() || body.torque != Vector3::zeros() || is_moved
        };
        let is_motor = |row: &Row| matches!(row.bounds, Bounds::Effort(_)) || row.speed != 0.0;
        let damps = |row: &Row| {
            row.bounds == Bounds::Unilateral || row.spring.is_some_and(|own| own.damping > 0.0)
        };
        let is_given = (0..scene.bodies.len()).any(pushed) || !scene.driven.is_empty();
        Watch {
            kinetic: first.kinetic,
            first,
            is_driven: is_given || rows().any(|row| is_motor(&row)),
            is_lossy: rows().any(|row| damps(&row)),
            is_alone: joints().all(|joint| joint.bodies().into_iter().all(moves)),
            ledger: Some(Ledger::default()),
            impact: None,
            passages: 0,
            slips: Slips::default(),
            blows: Blows::default(),
            restitution: None,
        }
    }

    pub fn add(&mut self, scene: &Scene, step: &Step) {
        self.kinetic = self.kinetic.max(step.motion.kinetic);
        self.ledger = self.ledger.zip(step.ledger).map(|(sum, own)| sum + own);
        for touch in &step.touches {
            let is_smooth = scene.friction(touch.bodies) == 0.0;
            self.is_lossy |= !is_smooth || scene.restitution(touch.bodies.map(Some)) < 1.0;
            self.is_alone &= touch.bodies.iter().all(|&k| scene.bodies[k].mass.dof() > 0);
        }
        let passed = step.interpenetrations.iter();
        let is_passage = |kind| matches!(kind, InterpenetrationKind::PassedThrough { .. });
        self.passages += passed.filter(|own| is_passage(own.kind)).count();
        if self.impact.is_none() {
            let first = step.impact_energy.iter().flatten().next();
            self.impact = first.map(|own| ImpactEnergy::message(own, scene, step.number));
        }
        self.slips.add(step);
        for blow in self.blows.add(scene, step) {
            let error = Blow::error(&blow).abs();
            self.restitution = Some(self.restitution.map_or(error, |known| known.max(error)));
        }
    }

    pub fn laws(self, scene: &Scene, last: &Motion) -> Laws {
        let energy = match (self.is_driven, self.is_lossy) {
            (true, _) => Energy::Changes,
            (false, true) => Energy::Falls,
            (false, false) => Energy::Stays,
        };
        let change = last.energy() - self.first.energy();
        let mass: f64 = scene.bodies.iter().map(|body| body.mass.mass()).sum();
        let given = (last.time - self.first.time) * mass * scene.gravity;
        let gained = last.linear_momentum - self.first.linear_momentum - given;
        let turned = last.angular_momentum - self.first.angular_momentum;
        let momentum = (2.0 * mass * self.kinetic).sqrt();
        let turn = self.first.angular_momentum.norm().max(last.angular_momentum.norm());
        let is_alone = self.is_alone && !self.is_driven;
        let part = |missing: f64, whole: f64| if whole > 0.0 { missing / whole } else { 0.0 };
        Laws {
            energy,
            kinetic: self.kinetic,
            account: self.ledger.and_then(|ledger| largest(&ledger, change)),
            impact: self.impact,
            passages: self.passages,
            momentum: is_alone.then(|| part(gained.norm(), momentum)),
            angular_momentum: (is_alone && scene.gravity == Vector3::zeros())
                .then(|| part(turned.norm(), turn)),
            restitution: self.restitution,
            askew: self.slips.askew.and_then(|slip| slip.angle).map(f64::to_degrees),
            beyond: self.slips.beyond.map_or(0.0, |slip| slip.excess),
        }
    }
}

/// The rows of a joint at the start; none where it has no direction.
fn rows(
    scene: &Scene,
    bodies: [Option<usize>; 2],
    joint: &dyn lcplab_mechanics::constraint::Constraint,
) -> Vec<Row> {
    let state = |body: Option<usize>| body.map_or(&State::WORLD, |k| &scene.states[k]);
    joint.rows(bodies.map(state)).unwrap_or_default()
}

/// The account that holds most of a change of energy, if one does. What a blow loses first and
/// what its bounce gives back are one: at e = 1 all of it comes back.
fn largest(ledger: &Ledger, change: f64) -> Option<(String, f64)> {
    let blows = ledger.contact + ledger.restitution;
    let of_blow = |(name, energy)| match name {
        "contact" => (name, blows.min(0.0)),
        "restitution" => (name, blows.max(0.0)),
        _ => (name, energy),
    };
    let own = ledger.accounts().map(of_blow).into_iter();
    let own = own.filter(|(_, energy)| energy * change > 0.0);
    let (name, energy) = own.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    Some((name.to_string(), energy))
}
