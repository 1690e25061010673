//! What bodies must not do to each other, one constraint a file.
//!
//! A constraint gives for each of its rows the position c(s), the row of J with dc/dt = J u, and
//! the velocity product J'u with d²c/dt² = J u' + J'u. It acts between body 0 and body 1, the sign
//! is body 1 minus body 0, and the world may take the place of either. Larger joints are combined
//! of these, never special-cased.
//!
//! [`Constraint`] is what assembly sees. [`Position`] is c(s) again, over any real scalar, so that
//! [`verify()`] can hold every J and J'u against exact derivatives, yours too.
//!
//! | primitive | c | made of it |
//! | --- | --- | --- |
//! | [`Coincidence`] | two points together | ball, nail |
//! | [`Orientation`] | no relative rotation | [`Weld`] |
//! | [`AxisLock`] | one translation or rotation | [`Slider`] |
//! | [`Perpendicular`] | two directions at a right angle | [`Hinge`], [`Universal`], [`Cylindrical`] |
//! | [`Distance`], [`SquaredDistance`] | two points at a distance | [`Rope`], spring |
//! | [`Coordinate`] | displacement along an axis, angle about it | [`Limit`], [`Motor`], torsion spring, [`Gear`] |
//! | [`ConeLimit`] | an axis within a cone | with a ball and a limit: cone-twist |
//! | [`Contact`] | two surfaces apart | friction |
//!
//! A pair or an array of constraints is a constraint, and [`Elastic`] makes any of them yield.
//! Limits and motors are constraints beside the joint that they serve, not parts of it.

mod arms;
mod axis_lock;
mod coincidence;
mod combined;
mod cone_limit;
mod contact;
mod coordinate;
mod cylindrical;
mod distance;
mod friction;
mod gear;
mod hinge;
mod joint;
mod limit;
mod motor;
mod orientation;
mod perpendicular;
mod pulley;
mod rack;
mod rope;
mod slider;
mod spring;
mod squared_distance;
mod universal;
mod verify;
mod weld;

pub use axis_lock::{AxisLock, Motion};
pub use coincidence::Coincidence;
pub use cone_limit::ConeLimit;
pub use contact::{Contact, Normal, Rim};
pub use coordinate::Coordinate;
pub use cylindrical::Cylindrical;
pub use distance::Distance;
pub use friction::tangents;
pub use gear::Gear;
pub use hinge::Hinge;
pub use joint::{ALL, Fault, Field, Joint, Placement};
pub use limit::Limit;
pub use motor::Motor;
pub use orientation::Orientation;
pub use perpendicular::Perpendicular;
pub use pulley::Pulley;
pub use rack::Rack;
pub use rope::Rope;
pub use slider::Slider;
pub use spring::Elastic;
pub use squared_distance::SquaredDistance;
pub use universal::Universal;
pub use verify::{Mistake, Quantity, Verifiable, derivatives, verify};
pub use weld::Weld;

use std::fmt;

use nalgebra::{RealField, Vector3, Vector6};

use crate::body::{Pose, State, linear};

/// The bodies that a constraint joins, by index; `None` is the world.
pub type Bodies = [Option<usize>; 2];

/// A constraint between two bodies, or between a body and the world.
pub trait Constraint: fmt::Debug + Send + Sync {
    /// The bodies whose states [`rows`](Constraint::rows) wants, in this order.
    fn bodies(&self) -> Bodies;

    /// The rows at these states; always as many, in the same order.
    ///
    /// # Errors
    /// [`Degenerate`] where c has no derivative.
    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate>;

    /// Adds the same rows to a list that is kept. Those whose steps are to ask for no memory add
    /// them one by one.
    ///
    /// # Errors
    /// As [`rows`](Constraint::rows); the list is then of no use.
    fn add_rows(&self, states: [&State; 2], rows: &mut Vec<Row>) -> Result<(), Degenerate> {
        rows.extend(self.rows(states)?);
        Ok(())
    }

    /// Where its force acts on each body, in the body's frame (m), so that it can be drawn; none
    /// for one that has only torques.
    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        None
    }
}

/// c(s) of a constraint over any real scalar; one entry a row, as in [`Constraint::rows`]. Friction
/// rows, which have no position, are left out; a motor, whose c is 0, gives what it drives.
pub trait Position {
    /// c(s) in metres or radians.
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T>;
}

/// One row of a constraint at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// What the row keeps.
    pub kind: Kind,
    /// The position c (m or rad); 0 for a friction row.
    pub c: f64,
    /// The blocks of J for [v; ω] of body 0 and of body 1.
    pub jacobian: [Vector6<f64>; 2],
    /// The velocity product J'u (m/s² or rad/s²).
    pub velocity_product: f64,
    /// What the row's force may be.
    pub bounds: Bounds,
    /// What J u is to be (m/s or rad/s): 0 but for motors.
    pub speed: f64,
    /// Its spring and damper; a row without is rigid.
    pub spring: Option<Spring>,
}

/// A compliant row: x = −(k c + d ċ), taken at the end of the step so that no stiffness is too
/// large for it.
///
/// ```text
/// over a step h:   w = J u⁺ + β/h c + γ x,   γ = 1/(h (d + h k)),   β = h k/(d + h k)
/// ```
///
/// Catto, *Soft Constraints*, GDC 2011.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// k (N/m or N m/rad), at least 0.
    pub stiffness: f64,
    /// d (N s/m or N m s/rad), at least 0; not both are 0.
    pub damping: f64,
}

impl Spring {
    /// γ (m/s per N s, or rad/s per N m s) over a step of h (s): what the row adds to A's diagonal.
    pub fn compliance(&self, h: f64) -> f64 {
        1.0 / (h * (self.damping + h * self.stiffness))
    }

    /// β/h (1/s) over a step of h (s).
    pub fn feedback(&self, h: f64) -> f64 {
        self.stiffness / (self.damping + h * self.stiffness)
    }
}

impl Row {
    /// Whether it keeps bodies from turning and does nothing else, as two rows of a hinge do.
    pub fn holds_axis(&self) -> bool {
        let only_turns = |j: &Vector6<f64>| linear(j) == Vector3::zeros();
        let is_rigid = self.bounds == Bounds::Bilateral && self.spring.is_none();
        is_rigid && self.jacobian.iter().all(only_turns)
    }

    /// A row of an equation c = 0: any x, no drive, no spring.
    pub fn equation(
        kind: Kind,
        c: f64,
        jacobian: [Vector6<f64>; 2],
        velocity_product: f64,
    ) -> Self {
        let bounds = Bounds::Bilateral;
        Row { kind, c, jacobian, velocity_product, bounds, speed: 0.0, spring: None }
    }

    /// A row of an inequality c ≥ 0: x ≥ 0.
    pub fn inequality(
        kind: Kind,
        c: f64,
        jacobian: [Vector6<f64>; 2],
        velocity_product: f64,
    ) -> Self {
        Row { bounds: Bounds::Unilateral, ..Row::equation(kind, c, jacobian, velocity_product) }
    }

    /// The row of −c: what an upper limit is to a lower one.
    pub fn negated(self) -> Self {
        Row {
            c: -self.c,
            jacobian: self.jacobian.map(|j| -j),
            velocity_product: -self.velocity_product,
            ..self
        }
    }
}

/// What a row keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Two points together, along a world axis.
    Coincidence,
    /// Two points at a distance: exactly, at most, or by a spring.
    Distance,
    /// The motion of a point along an axis of body 0.
    Translation,
    /// The turning of one body against the other.
    Rotation,
    /// Two bodies apart: the normal row of a contact.
    Normal,
    /// A tangential row of a contact.
    Friction,
}

/// What a row's force (or impulse) x may be; x ≥ 0 pushes body 1 away from body 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bounds {
    /// Any x: an equation.
    Bilateral,
    /// x ≥ 0: pushes only.
    Unilateral,
    /// |x| ≤ this force (N) or torque (N m): a motor.
    Effort(f64),
    /// |x| ≤ μ x_n with x_n of another row of the same constraint.
    Friction {
        /// The index of the normal row among the rows of this constraint.
        normal: usize,
        /// The coefficient of friction μ.
        mu: f64,
    },
}

impl Kind {
    /// One word for tables.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Coincidence => "coincidence",
            Kind::Distance => "distance",
            Kind::Translation => "translation",
            Kind::Rotation => "rotation",
            Kind::Normal => "normal",
            Kind::Friction => "friction",
        }
    }

    /// Whether c is an angle, x a torque or an angular impulse.
    pub fn is_angular(self) -> bool {
        self == Kind::Rotation
    }
}

impl Bounds {
    /// The least and the greatest force (N or N m) of an uncoupled row, ∓∞ for a friction row.
    pub fn interval(self) -> (f64, f64) {
        match self {
            Bounds::Unilateral => (0.0, f64::INFINITY),
            Bounds::Effort(effort) => (-effort, effort),
            Bounds::Bilateral | Bounds::Friction { .. } => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }
}

/// A state in which a constraint has no direction to push in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Degenerate {
    /// What went wrong.
    pub reason: &'static str,
}

impl std::error::Error for Degenerate {}

impl fmt::Display for Degenerate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.reason)
    }
}

/// An angle or another cyclic quantity to within half its period on either side of 0.
fn wrapped(value: f64, half: f64) -> f64 {
    value - 2.0 * half * (value / (2.0 * half)).round()
}

/// The value of a scalar without its derivatives.
fn plain<T: RealField + Copy>(value: T) -> f64 {
    nalgebra::try_convert(value).unwrap_or(f64::NAN)
}

/// The f64 constant in another scalar.
fn constant<T: RealField + Copy>(value: f64) -> T {
    nalgebra::convert(value)
}
