//! The settings of steps, contacts and the solver, as read from the scene file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::scheme::{Feedback, Integrator, Penalty, Scheme, Soft, Xpbd};
use super::{range, surface};
use crate::body::Gyroscopic;
use lcplab_lcp::error::Defects;
use lcplab_lcp::friction::Model;
use lcplab_solver::Order;

/// Maximum number of substeps and of sweeps per step.
const MOST_PARTS: usize = 1_000_000;

/// The settings of a time step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Step {
    /// The length of a step (s).
    pub dt: f64,
    /// The default number of steps of a simulation.
    pub count: usize,
    /// The time-stepping scheme.
    pub scheme: Scheme,
    /// The treatment of the torque −ω × I ω.
    pub gyroscopic: Gyroscopic,
    /// Velocity level and sequential impulses: the fraction β of the position error that is
    /// corrected per step, 0 to 1.
    pub baumgarte: f64,
    /// The factor in the feedback of position errors.
    pub feedback: Feedback,
    /// Acceleration level: the rate α (1/s) at which position errors decay.
    pub alpha: f64,
    /// Acceleration level: the integrator.
    pub integrator: Integrator,
    /// Acceleration level: whether a step is divided at the time of an impact, so that bodies do
    /// not overlap.
    pub events: bool,
    /// XPBD, soft step and penalty method: the number of substeps per step.
    pub substeps: usize,
    /// Sequential impulses: sweeps over the rows per solve. NGS: sweeps that correct positions.
    pub sweeps: usize,
    /// Settings of XPBD.
    pub xpbd: Xpbd,
    /// Settings of the soft step.
    pub soft: Soft,
    /// Settings of the penalty method.
    pub penalty: Penalty,
}

impl Default for Step {
    fn default() -> Self {
        Step {
            dt: 0.01,
            count: 200,
            scheme: Scheme::default(),
            gyroscopic: Gyroscopic::default(),
            baumgarte: 0.0,
            feedback: Feedback::default(),
            alpha: 0.0,
            integrator: Integrator::default(),
            events: true,
            substeps: 8,
            sweeps: 20,
            xpbd: Xpbd::default(),
            soft: Soft::default(),
            penalty: Penalty::default(),
        }
    }
}

/// The number of contact points for a pair of bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Manifold {
    /// All touching points.
    #[default]
    Full,
    /// At most four: the deepest, the one farthest from it, and two that span the largest area.
    Four,
}

/// Which impulses of a step are reused in the next (warm starting).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Persistence {
    /// Points where the same features touch are the same contact: a solve starts from its last
    /// impulses.
    #[default]
    Features,
    /// None: the impulses of contacts and joints start from 0 in every step.
    None,
}

/// The friction force of a sliding contact, at acceleration level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Sliding {
    /// An unknown in a box, |x_t| ≤ μ x_n along two tangents: A stays symmetric.
    #[default]
    Box,
    /// x_t = −μ x_n v_t/|v_t| exactly, substituted for the unknown: A is not symmetric, and there
    /// may be no solution (Painlevé).
    Substituted,
}

/// The settings of contacts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Contacts {
    /// Velocity level: contacts with a gap up to this (m) enter the LCP. By default, the distance
    /// that the two bodies can approach each other in a step, at least 0.05 m.
    pub margin: Option<f64>,
    /// The coefficient of friction of bodies without their own.
    pub friction: f64,
    /// The coefficient of static friction of bodies without their own friction, not below
    /// `friction`; by default equal to it. A contact sticks if static friction can hold it until
    /// the end of a step; otherwise it slides with `friction`.
    pub static_friction: Option<f64>,
    /// The coefficient of restitution e, 0 to 1.
    pub restitution: f64,
    /// Contacts that approach slower than this (m/s) do not bounce.
    pub bounce_speed: f64,
    /// Velocity level: penetration up to this (m) is not corrected.
    pub slop: f64,
    /// Acceleration level: a contact with a gap up to this (m) touches. By default, the distance
    /// that a body falls in a step from rest, at most a thousandth of the smallest body.
    pub resting_gap: Option<f64>,
    /// Acceleration level: a touching contact that separates at up to this speed (m/s) rests. By
    /// default, twice the speed that a body gains in a step.
    pub resting_speed: Option<f64>,
    /// The number of contact points for a pair of bodies.
    pub manifold: Manifold,
    /// Which impulses of a step, including those of joints, are reused in the next (warm starting).
    pub persistence: Persistence,
    /// The friction model by name; polygons with the number of corners: `polygon-8`. Schemes that
    /// solve no LCP support only the coupled box.
    #[schemars(with = "String")]
    pub model: Model,
    /// Acceleration level: the friction of sliding contacts.
    pub sliding: Sliding,
    /// Acceleration level: a contact that slips at up to this speed (m/s) sticks.
    pub sticking_speed: f64,
}

impl Default for Contacts {
    fn default() -> Self {
        Contacts {
            margin: None,
            friction: 0.0,
            static_friction: None,
            restitution: 0.0,
            bounce_speed: 0.1,
            slop: 0.0,
            resting_gap: None,
            resting_speed: None,
            manifold: Manifold::default(),
            persistence: Persistence::default(),
            model: Model::default(),
            sliding: Sliding::default(),
            sticking_speed: 1e-9,
        }
    }
}

/// The order of the rows in a sweep, as a scene or a command names it: the solvers' own
/// [`Order`](lcplab_solver::Order) also has a seed, and orders that are solvers by themselves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum RowOrder {
    /// In the order of their numbers.
    #[default]
    Natural,
    /// In reverse order.
    Reverse,
    /// A random permutation, the same in every sweep.
    Shuffled,
}

impl RowOrder {
    /// The order in a sweep, with this seed if it is a random one.
    ///
    /// ```
    /// use lcplab_mechanics::scene::RowOrder;
    /// use lcplab_solver::Order;
    ///
    /// assert_eq!(RowOrder::Shuffled.seeded(7), Order::Shuffled { seed: 7 });
    /// ```
    pub fn seeded(self, seed: u64) -> Order {
        match self {
            RowOrder::Natural => Order::Natural,
            RowOrder::Reverse => Order::Reverse,
            RowOrder::Shuffled => Order::Shuffled { seed },
        }
    }
}

/// The solver that supports a fixed number of sweeps.
const SWEEPING: &str = lcplab_solver::Pgs::NAME;

/// The solver and its settings; the name is checked by the solver registry.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    /// The solver's name in the registry.
    pub name: String,
    /// The relaxation factor ω of methods that have one.
    pub omega: f64,
    /// The order of the rows in a sweep, for methods that let it be chosen.
    pub order: RowOrder,
    /// The seed of the order "shuffled".
    pub seed: u64,
    /// The damping factor θ of Jacobi's method, above 0 and below 2; by default a safe value.
    pub damping: Option<f64>,
    /// The scaled residual at which a solver stops.
    pub tolerance: f64,
    /// The maximum number of sweeps or pivots per step.
    pub max_iterations: usize,
    /// Whether `pgs` takes exactly `max_iterations` sweeps in every step, regardless of the
    /// residual. The answer is then not judged and no matrix is formed, which is many times faster.
    pub fixed_sweeps: bool,
    /// The force (N) below which a row counts as at rest: residuals of rows with smaller terms are
    /// rounding. By default the weight of the lightest body; see `docs/scenes.md`.
    pub scale: Option<f64>,
}

impl Default for Solver {
    fn default() -> Self {
        Solver {
            name: lcplab_solver::Dantzig::NAME.into(),
            omega: 1.3,
            order: RowOrder::default(),
            seed: 1,
            damping: None,
            tolerance: 1e-8,
            max_iterations: 10_000,
            fixed_sweeps: false,
            scale: None,
        }
    }
}

impl Step {
    /// The treatment of the gyroscopic torque: the acceleration level evaluates accelerations at
    /// one instant and so has no implicit form; there the torque is part of F unless it is omitted.
    pub(crate) fn gyroscopic(&self) -> Gyroscopic {
        match (self.scheme, self.gyroscopic) {
            (Scheme::Acceleration, Gyroscopic::Implicit | Gyroscopic::Conserving) => {
                Gyroscopic::Explicit
            }
            (_, chosen) => chosen,
        }
    }

    pub(super) fn check(&self, defects: &mut Defects) {
        range::divisor(defects, "step.dt", ["step", "s"], self.dt);
        within_one(defects, "step.baumgarte", self.baumgarte);
        not_negative(defects, "step.alpha", self.alpha);
        for (place, least, count) in
            [("step.substeps", 1, self.substeps), ("step.sweeps", 0, self.sweeps)]
        {
            if !(least..=MOST_PARTS).contains(&count) {
                let reason = format!("must lie between {least} and {MOST_PARTS}, is {count}");
                defects.add(place, reason);
            }
        }
        self.xpbd.check(defects);
        self.soft.check(defects);
        self.penalty.check(defects);
    }
}

impl Contacts {
    /// Whether a contact with this speed of approach (m/s) bounces: not if it closes more slowly
    /// than `bounce_speed`.
    ///
    /// ```
    /// use lcplab_mechanics::scene::Contacts;
    ///
    /// let mut contact = Contacts::default();
    /// contact.bounce_speed = 0.5;
    /// assert_eq!([0.4, 0.5, 0.6].map(|approach| contact.bounces(approach)), [false, true, true]);
    /// ```
    pub fn bounces(&self, approach: f64) -> bool {
        approach > 0.0 && approach >= self.bounce_speed
    }

    pub(super) fn check(&self, defects: &mut Defects) {
        not_negative(defects, "contact.margin", self.margin.unwrap_or(0.0));
        range::coefficient(defects, "contact.friction", self.friction);
        if let Some(stated) = self.static_friction {
            surface::check_static(defects, "contact", stated, self.friction);
        }
        within_one(defects, "contact.restitution", self.restitution);
        not_negative(defects, "contact.bounce_speed", self.bounce_speed);
        not_negative(defects, "contact.slop", self.slop);
        not_negative(defects, "contact.resting_gap", self.resting_gap.unwrap_or(0.0));
        not_negative(defects, "contact.resting_speed", self.resting_speed.unwrap_or(0.0));
        not_negative(defects, "contact.sticking_speed", self.sticking_speed);
    }
}

impl Solver {
    pub(super) fn check(&self, defects: &mut Defects) {
        let damping = self.damping.unwrap_or(1.0);
        for (place, value) in [("solver.omega", self.omega), ("solver.damping", damping)] {
            if !(value > 0.0 && value < 2.0) {
                defects.add(place, format!("must lie between 0 and 2, is {value}"));
            }
        }
        not_negative(defects, "solver.tolerance", self.tolerance);
        if self.fixed_sweeps && (self.name.as_str(), self.order) != (SWEEPING, RowOrder::Natural) {
            let reason = format!(
                "only the solver {SWEEPING}, in natural order, takes a fixed number of sweeps"
            );
            defects.add("solver.fixed_sweeps", reason);
        }
        not_negative(defects, "solver.scale", self.scale.unwrap_or(0.0));
    }
}

/// A number that must be positive and finite.
pub(super) fn positive(defects: &mut Defects, place: impl Into<String>, value: f64) {
    if !(value > 0.0 && value.is_finite()) {
        defects.add(place, format!("must be positive, is {value}"));
    }
}

/// A number that must be finite and at least 0.
pub(super) fn not_negative(defects: &mut Defects, place: impl Into<String>, value: f64) {
    if !(value >= 0.0 && value.is_finite()) {
        defects.add(place, format!("must be at least 0, is {value}"));
    }
}

/// A number that must be finite, at least 0 and at most 1.
pub(super) fn within_one(defects: &mut Defects, place: &str, value: f64) {
    if !(0.0..=1.0).contains(&value) {
        defects.add(place, format!("must lie between 0 and 1, is {value}"));
    }
}
