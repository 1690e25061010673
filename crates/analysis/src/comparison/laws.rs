//! Which laws a run kept, measured from its motion alone, so that it holds for every scheme.
//!
//! Energy is conserved where nothing dissipates and nothing drives, and never increases where
//! nothing drives. Momentum is conserved where nothing outside acts. An impact separates bodies at
//! e times their approach, and friction opposes the slip within the cone. A law is judged by its
//! largest error in the run.

use lcplab_mechanics::body::State;
use lcplab_mechanics::constraint::{Bounds, Constraint, Row};
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{
    Impact, ImpactEnergy, Impacts, InterpenetrationKind, Ledger, LostBounces, Motion, Slips, Step,
    Touch, momentum_sizes,
};
use nalgebra::{Vector3, Vector6};
use serde::{Deserialize, Serialize};

/// A law is kept if its error is at most this part of its reference.
pub const LAW_TOLERANCE: f64 = 0.01;
/// Friction that is farther (degrees) from the direction opposite to sliding violates its law.
pub const FRICTION_ANGLE: f64 = 5.0;

/// What energy may do in a scene.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Energy {
    /// It is conserved: there is no friction, damping or e < 1, and nothing drives.
    #[default]
    Stays,
    /// It may decrease.
    Falls,
    /// A motor, a force or a support that moves may add to it.
    Changes,
}

/// What a run measured of the laws.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RunLaws {
    /// What energy may do.
    pub energy: Energy,
    /// The largest kinetic energy of the run (J).
    pub kinetic: f64,
    /// The largest gain or loss (negative) of energy within the run that is not allowed (J); for
    /// the penalty scheme, whose contacts store energy, the one at the end.
    pub energy_error: f64,
    /// The size up to which such a gain or loss is tolerated (J).
    pub energy_tolerance: f64,
    /// Whether the scheme has an energy ledger.
    pub has_ledger: bool,
    /// The account of the ledger that explains the error, and its energy (J); none where no single
    /// account explains it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub account: Option<(String, f64)>,
    /// What happened in the first impact that changed the energy in the same direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impact: Option<String>,
    /// How often a body passed through another one within a step.
    pub passages: usize,
    /// The largest change of the momentum, relative to the largest Σ m |v|; none where something
    /// outside acts.
    pub momentum: Option<f64>,
    /// The same of the angular momentum, relative to Σ |p| m |v| + |I ω|; only without gravity.
    pub angular_momentum: Option<f64>,
    /// The largest |v⁺ + e v⁻| of an impact at one point, relative to its approach; none without
    /// such an impact.
    pub restitution: Option<f64>,
    /// The impacts that lost their bounce because they were too slow for it, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lost_bounces: Option<String>,
    /// The largest angle (degrees) between friction and the direction opposite to sliding; none
    /// where nothing slides.
    pub friction_angle: Option<f64>,
    /// How far friction was outside the cone, relative to μ x_n.
    pub cone_excess: f64,
}

impl RunLaws {
    /// Whether energy did what it may do.
    pub fn keeps_energy(&self) -> bool {
        self.energy_error.abs() <= self.energy_tolerance
    }
}

/// The change of energy since the start (J), and the ledger of all steps.
#[derive(Debug, Clone, Copy, Default)]
struct EnergyTotals {
    change: f64,
    ledger: Ledger,
}

/// From one instant to a later one.
type Span = [EnergyTotals; 2];

fn change([from, to]: &Span) -> f64 {
    to.change - from.change
}

/// Measures the laws while a run is under way.
pub(super) struct LawMonitor {
    first: Motion,
    is_driven: bool,
    is_lossy: bool,
    is_isolated: bool,
    /// The largest kinetic energy (J).
    kinetic: f64,
    /// What impacts that are too slow to bounce may have lost (J).
    plastic: f64,
    has_ledger: bool,
    now: EnergyTotals,
    lowest: EnergyTotals,
    highest: EnergyTotals,
    gain: Span,
    loss: Span,
    /// The largest sizes, and changes, of the momentum and the angular momentum.
    sizes: [f64; 2],
    momenta: [f64; 2],
    /// The first impact that added energy, and the first one that took some.
    messages: [Option<String>; 2],
    passages: usize,
    slips: Slips,
    impacts: Impacts,
    lost_bounces: LostBounces,
    restitution: Option<f64>,
}

impl LawMonitor {
    pub fn new(scene: &Scene, first: Motion) -> Self {
        let joints = || scene.constraints.iter();
        let rows = || joints().flat_map(|joint| rows(scene, &**joint));
        let moves = |body: Option<usize>| body.is_some_and(|k| scene.bodies[k].mass.dof() > 0);
        let is_pushed = |k: usize| {
            let body = &scene.bodies[k];
            let is_moved = !moves(Some(k)) && scene.states[k].velocity() != Vector6::zeros();
            body.force != Vector3::zeros() || body.torque != Vector3::zeros() || is_moved
        };
        let is_motor = |row: &Row| matches!(row.bounds, Bounds::Effort(_)) || row.speed != 0.0;
        let damps = |row: &Row| {
            row.bounds == Bounds::Unilateral || row.spring.is_some_and(|own| own.damping > 0.0)
        };
        let is_given = (0..scene.bodies.len()).any(is_pushed) || !scene.driven.is_empty();
        LawMonitor {
            kinetic: first.kinetic,
            first,
            is_driven: is_given || rows().any(|row| is_motor(&row)),
            is_lossy: rows().any(|row| damps(&row)),
            is_isolated: joints().all(|joint| joint.bodies().into_iter().all(moves)),
            plastic: 0.0,
            has_ledger: true,
            now: EnergyTotals::default(),
            lowest: EnergyTotals::default(),
            highest: EnergyTotals::default(),
            gain: Span::default(),
            loss: Span::default(),
            sizes: momentum_sizes(scene, &scene.states),
            momenta: [0.0; 2],
            messages: [None, None],
            passages: 0,
            slips: Slips::default(),
            impacts: Impacts::default(),
            lost_bounces: LostBounces::default(),
            restitution: None,
        }
    }

    pub fn add(&mut self, scene: &Scene, step: &Step) {
        self.kinetic = self.kinetic.max(step.motion.kinetic);
        self.add_energy(step);
        self.add_momenta(scene, step);
        for touch in &step.touches {
            let is_smooth = scene.friction(touch.bodies) == 0.0;
            self.is_lossy |= !is_smooth || scene.restitution(touch.bodies.map(Some)) < 1.0;
            self.is_isolated &= touch.bodies.iter().all(|&k| scene.bodies[k].mass.dof() > 0);
            self.plastic += plastic_loss(scene, touch);
        }
        let passed = step.interpenetrations.iter();
        let is_passage = |kind| matches!(kind, InterpenetrationKind::PassedThrough { .. });
        self.passages += passed.filter(|own| is_passage(own.kind)).count();
        for own in &step.impact_energy {
            self.messages[usize::from(own.energy < 0.0)]
                .get_or_insert_with(|| ImpactEnergy::message(own, scene, step.number));
        }
        self.slips.add(step);
        let ended = self.impacts.add(scene, step);
        self.lost_bounces.add(scene, step);
        self.restitution = worst(self.restitution, ended.into_iter());
    }

    fn add_energy(&mut self, step: &Step) {
        self.has_ledger &= step.ledger.is_some();
        let now = EnergyTotals {
            change: step.motion.energy() - self.first.energy(),
            ledger: self.now.ledger + step.ledger.unwrap_or_default(),
        };
        let [gain, loss] = [[self.lowest, now], [self.highest, now]];
        if change(&gain) > change(&self.gain) {
            self.gain = gain;
        }
        if change(&loss) < change(&self.loss) {
            self.loss = loss;
        }
        if now.change < self.lowest.change {
            self.lowest = now;
        }
        if now.change > self.highest.change {
            self.highest = now;
        }
        self.now = now;
    }

    fn add_momenta(&mut self, scene: &Scene, step: &Step) {
        let mass: f64 = scene.bodies.iter().map(|body| body.mass.mass()).sum();
        let given = (step.motion.time - self.first.time) * mass * scene.gravity;
        let made = step.motion.linear_momentum - self.first.linear_momentum - given;
        let turned = step.motion.angular_momentum - self.first.angular_momentum;
        let larger = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].max(b[1])];
        self.momenta = larger(self.momenta, [made.norm(), turned.norm()]);
        self.sizes = larger(self.sizes, momentum_sizes(scene, &step.states));
    }

    pub fn laws(mut self, scene: &Scene) -> RunLaws {
        let energy = match (self.is_driven, self.is_lossy) {
            (true, _) => Energy::Changes,
            (false, true) => Energy::Falls,
            (false, false) => Energy::Stays,
        };
        if scene.step.scheme == Scheme::Penalty {
            (self.gain, self.loss) =
                ([EnergyTotals::default(), self.now], [EnergyTotals::default(), self.now]);
        }
        let mass: f64 = scene.bodies.iter().map(|body| body.mass.mass()).sum();
        let weight = mass * scene.gravity.norm();
        let tolerance = LAW_TOLERANCE * self.kinetic + weight * scene.resting().gap;
        let gain = (change(&self.gain).max(0.0), tolerance, self.gain);
        let loss = (change(&self.loss).min(0.0), tolerance + self.plastic, self.loss);
        let (energy_error, energy_tolerance, span) = match energy {
            Energy::Stays if -loss.0 - loss.1 > gain.0 - gain.1 => loss,
            Energy::Stays | Energy::Falls => gain,
            Energy::Changes => (0.0, tolerance, Span::default()),
        };
        let is_explained = self.has_ledger && energy_error.abs() > energy_tolerance;
        let [added, taken] = self.messages;
        let is_isolated = self.is_isolated && !self.is_driven;
        let part = |k: usize| match self.sizes[k] > 0.0 {
            true => self.momenta[k] / self.sizes[k],
            false => 0.0,
        };
        RunLaws {
            energy,
            kinetic: self.kinetic,
            energy_error,
            energy_tolerance,
            has_ledger: self.has_ledger,
            account: is_explained.then(|| largest_account(&span)).flatten(),
            impact: if energy_error < 0.0 { taken } else { added },
            passages: self.passages,
            momentum: is_isolated.then(|| part(0)),
            angular_momentum: (is_isolated && scene.gravity == Vector3::zeros()).then(|| part(1)),
            restitution: worst(self.restitution, self.impacts.unfinished()),
            lost_bounces: self.lost_bounces.in_words(scene),
            friction_angle: self
                .slips
                .friction_angle
                .and_then(|slip| slip.angle)
                .map(f64::to_degrees),
            cone_excess: self.slips.cone_excess.map_or(0.0, |slip| slip.excess),
        }
    }
}

/// The rows of a joint at the start; none where it has no direction.
fn rows(scene: &Scene, joint: &dyn Constraint) -> Vec<Row> {
    let state = |body: Option<usize>| body.map_or(&State::WORLD, |k| &scene.states[k]);
    joint.rows(joint.bodies().map(state)).unwrap_or_default()
}

/// The kinetic energy (J) that two bodies may lose because they meet too slowly to bounce: that of
/// their approach as point masses, which is no less than that of turning bodies.
fn plastic_loss(scene: &Scene, touch: &Touch) -> f64 {
    let [a, b] = touch.bodies.map(|body| scene.bodies[body].mass.mass());
    let reduced = if a * b > 0.0 { a * b / (a + b) } else { a + b };
    let is_slow = touch.approach > 0.0 && touch.approach < scene.plastic_speed();
    if is_slow { 0.5 * reduced * touch.approach.powi(2) } else { 0.0 }
}

/// The largest error of restitution, with those of more impacts.
fn worst(known: Option<f64>, impacts: impl Iterator<Item = Impact>) -> Option<f64> {
    known.into_iter().chain(impacts.map(|impact| impact.error().abs())).reduce(f64::max)
}

/// The account with the largest part in a change of energy, if it is off by half of that at most.
/// What an impact takes first and what its bounce gives back are one account.
fn largest_account(span: &Span) -> Option<(String, f64)> {
    let [from, to] = span.map(|books| books.ledger.accounts());
    let energy = |name: &str| -> f64 {
        let own = from.iter().zip(&to).filter(|(from, _)| from.0 == name);
        own.map(|(from, to)| to.1 - from.1).sum()
    };
    let bounces = ("contact and restitution", energy("contact") + energy("restitution"));
    let others = to.iter().filter(|own| !matches!(own.0, "contact" | "restitution"));
    let accounts = others.map(|&(name, _)| (name, energy(name))).chain([bounces]);
    let change = change(span);
    let (name, energy) =
        accounts.max_by(|a, b| (a.1 * change.signum()).total_cmp(&(b.1 * change.signum())))?;
    ((energy - change).abs() <= 0.5 * change.abs()).then(|| (name.to_string(), energy))
}
