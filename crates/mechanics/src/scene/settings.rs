//! How a scene is stepped, solved and when its contacts count. Plain data, read from the file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::scheme::{Feedback, Integrator, Penalty, Scheme, Soft, Xpbd};
use super::{range, surface};
use crate::body::Gyroscopic;
use lcplab_problem::error::Defects;
use lcplab_problem::friction::Model;

/// A step has at most so many substeps, and so many sweeps.
const MOST_PARTS: usize = 1_000_000;

/// How a step is taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Step {
    /// The length of a step (s).
    pub dt: f64,
    /// How many steps a simulation takes unless told otherwise.
    pub count: usize,
    /// The scheme that takes it.
    pub scheme: Scheme,
    /// What becomes of the torque −ω × I ω.
    pub gyroscopic: Gyroscopic,
    /// Velocity level and sequential impulses: the part β of the position error that is corrected
    /// in a step, 0 to 1.
    pub baumgarte: f64,
    /// What β multiplies.
    pub feedback: Feedback,
    /// Acceleration level: the rate α (1/s) at which position errors decay.
    pub alpha: f64,
    /// Acceleration level: how accelerations become motion.
    pub integrator: Integrator,
    /// Acceleration level: whether a step is divided where a body arrives at another one, so that
    /// it hits there and does not enter.
    pub events: bool,
    /// XPBD, soft step and penalty method: into how many substeps a step is divided.
    pub substeps: usize,
    /// Sequential impulses: sweeps over the rows in a solve. NGS: sweeps that correct positions.
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

/// How many points of a pair of bodies become contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Manifold {
    /// All that touch.
    #[default]
    Full,
    /// At most four: the deepest, the one farthest from it, and two that span the largest area.
    Four,
}

/// What of a step's impulses is known in the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Persistence {
    /// Points where the same features touch are the same contact: a solve starts from its last
    /// impulses.
    #[default]
    Features,
    /// Nothing: the impulses of contacts and joints start from 0 in every step.
    None,
}

/// The friction force of a contact that slides, at acceleration level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Sliding {
    /// An unknown in a box, |x_t| ≤ μ x_n along two tangents: A stays symmetric.
    #[default]
    Box,
    /// x_t = −μ x_n v_t/|v_t| exactly, put in for the unknown: A is not symmetric, and there may be
    /// no solution (Painlevé).
    Substituted,
}

/// When contacts count, and what they do.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Contacts {
    /// Velocity level: contacts with a gap up to this (m) enter the LCP. Without it, what the two
    /// bodies can approach each other in a step, and at least 0.05 m.
    pub margin: Option<f64>,
    /// The coefficient of friction of bodies that do not state their own.
    pub friction: f64,
    /// The coefficient of static friction of bodies that state no friction of their own, no less
    /// than `friction`; without it the same. A contact that it can hold still to the end of a step
    /// sticks, any other one slides and has `friction`.
    pub static_friction: Option<f64>,
    /// The coefficient of restitution e, 0 to 1.
    pub restitution: f64,
    /// Approach at less than this speed (m/s) does not bounce.
    pub bounce_speed: f64,
    /// Velocity level: penetration up to this (m) is not corrected.
    pub slop: f64,
    /// Acceleration level: a contact with a gap up to this (m) touches. Without it, the way that a
    /// body falls in a step from rest, at most a thousandth of the smallest body.
    pub resting_gap: Option<f64>,
    /// Acceleration level: a touching contact that parts at up to this speed (m/s) rests. Without
    /// it, twice the speed that a body gains in a step.
    pub resting_speed: Option<f64>,
    /// How many points of a pair of bodies become contacts.
    pub manifold: Manifold,
    /// What of a step's impulses, those of joints too, is known in the next.
    pub persistence: Persistence,
    /// The model of friction by its name, of polygons with the number of corners: `polygon-8`.
    /// Schemes that solve no LCP know the coupled box only.
    #[schemars(with = "String")]
    pub model: Model,
    /// Acceleration level: what friction does to a contact that slides.
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

/// In which order a sweep takes the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Order {
    /// As they are numbered.
    #[default]
    Natural,
    /// The last one first.
    Reverse,
    /// A random permutation, the same in every sweep.
    Shuffled,
}

/// The solver that can take a fixed number of sweeps.
const SWEEPING: &str = "pgs";

/// Which solver to use, by name; whether it exists is known where solvers are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    /// The solver's name in the registry.
    pub name: String,
    /// The relaxation factor ω of methods that have one.
    pub omega: f64,
    /// The order in which sweeps take the rows, for methods that leave it open.
    pub order: Order,
    /// The seed of the order "shuffled".
    pub seed: u64,
    /// The damping factor θ of Jacobi's method, above 0 and below 2; safe damping without one.
    pub damping: Option<f64>,
    /// The scaled residual at which a solver stops.
    pub tolerance: f64,
    /// The most sweeps or pivots a step may take.
    pub max_iterations: usize,
    /// Whether `pgs` takes `max_iterations` sweeps in every step, no fewer, whatever the residual.
    /// No answer is judged then, and no matrix is formed, which is many times faster.
    pub fixed_sweeps: bool,
    /// The force (N) below which a row is at rest: a residual beside smaller terms than those of
    /// this force is rounding. The weight of the lightest body without it; see `docs/scenes.md`.
    pub scale: Option<f64>,
}

impl Default for Solver {
    fn default() -> Self {
        Solver {
            name: "dantzig".into(),
            omega: 1.3,
            order: Order::default(),
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
    /// What becomes of the gyroscopic torque: an acceleration is that of one instant, without a
    /// step to be implicit in, so there it is part of F unless it is omitted.
    pub fn gyroscopic(&self) -> Gyroscopic {
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
        if self.fixed_sweeps && (self.name.as_str(), self.order) != (SWEEPING, Order::Natural) {
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
