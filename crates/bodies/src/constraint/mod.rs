//! Constraints between bodies, one file for each.
//!
//! For each of its rows a constraint gives the position c(s), the row of J with dc/dt = J u, and
//! the velocity product J'u with d²c/dt² = J u' + J'u. It acts between body 0 and body 1, either of
//! which may be the world; the sign is body 1 minus body 0. Larger joints are combinations of
//! these, without special cases.
//!
//! [`Constraint`] is the interface for assembly. [`Position`] computes c(s) for any real scalar
//! type, so that [`verify()`] can compare J and J'u of every constraint, including your own, with
//! exact derivatives.
//!
//! | primitive | c | used for |
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
//! A pair or an array of constraints is a constraint, and [`Elastic`] makes any constraint
//! compliant. Limits and motors are separate constraints, not parts of the joint that they act on.

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
pub use contact::{Contact, Nearest, Normal, Rim};
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
///
/// ```
/// use lcplab_bodies::body::{Pose, State};
/// use lcplab_bodies::constraint::{Constraint, Distance, Position};
/// use nalgebra::Vector3;
///
/// // A bob on a rod of 2 m between the world's origin and its center moves at 3 m/s on a circle.
/// let rod = Distance { bodies: [None, Some(0)], anchors: [Vector3::zeros(); 2], length: 2.0 };
/// let mut bob = State::WORLD;
/// (bob.pose.p.x, bob.v.y) = (2.0, 3.0);
/// let states = [&State::WORLD, &bob];
/// assert_eq!((rod.bodies(), rod.anchors()), ([None, Some(0)], Some([Vector3::zeros(); 2])));
/// assert_eq!(rod.lines(), [([None, Some(0)], [Vector3::zeros(); 2])]);
/// let mut rows = rod.rows(states)?;
/// assert_eq!((rows[0].c, rows[0].jacobian[1].x), (0.0, 1.0)); // J is along the rod
/// assert_eq!(rows[0].velocity_product, 4.5); // v²/l
/// rod.add_rows(states, &mut rows)?;
/// assert_eq!(rows[0], rows[1]);
///
/// let far = Pose { p: 5.0 * Vector3::x(), ..Pose::default() };
/// assert_eq!(rod.c([&Pose::default(), &far]), [3.0]); // 5 m − 2 m
/// # Ok::<(), lcplab_bodies::constraint::Degenerate>(())
/// ```
pub trait Constraint: fmt::Debug + Send + Sync {
    /// The bodies whose states [`rows`](Constraint::rows) takes, in this order.
    fn bodies(&self) -> Bodies;

    /// The rows at these states; their number and order never change.
    ///
    /// # Errors
    /// [`Degenerate`] if c has no derivative.
    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate>;

    /// Appends the rows to an existing list. Override it to avoid allocations in every step.
    ///
    /// # Errors
    /// As [`rows`](Constraint::rows); the list is then invalid.
    fn add_rows(&self, states: [&State; 2], rows: &mut Vec<Row>) -> Result<(), Degenerate> {
        rows.extend(self.rows(states)?);
        Ok(())
    }

    /// The points where its force acts on each body, in the body's frame (m), for drawing; `None`
    /// if it has only torques.
    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        None
    }

    /// The straight lines to draw it with: between its anchors, or the parts of its rope, from a
    /// point of one body to a point of another (m, in their frames).
    fn lines(&self) -> Vec<(Bodies, [Vector3<f64>; 2])> {
        self.anchors().map(|anchors| (self.bodies(), anchors)).into_iter().collect()
    }
}

/// c(s) of a constraint for any real scalar type, with one entry per row, as in
/// [`Constraint::rows`]. Friction rows, which have no position, are omitted; a motor, whose c is 0,
/// returns the driven coordinate.
pub trait Position {
    /// c(s) in meters or radians.
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T>;
}

/// One row of a constraint at one instant.
///
/// ```
/// use lcplab_bodies::body::stack;
/// use lcplab_bodies::constraint::{Kind, Row};
/// use nalgebra::Vector3;
///
/// // Body 1 must not turn about x relative to body 0.
/// let j = stack(Vector3::zeros(), Vector3::x());
/// let row = Row::equation(Kind::Rotation, 0.0, [-j, j], 0.0);
/// assert!(row.holds_axis() && row.kind.is_angular());
/// assert_eq!(row.kind.name(), "rotation");
/// assert_eq!(row.bounds.interval(), (f64::NEG_INFINITY, f64::INFINITY));
/// // A limit only pushes: the relative rotation may grow.
/// let limit = Row::inequality(Kind::Rotation, 0.0, [-j, j], 0.0);
/// assert_eq!(limit.bounds.interval(), (0.0, f64::INFINITY));
/// assert!(!limit.holds_axis());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The kind of the row.
    pub kind: Kind,
    /// The position c (m or rad); 0 for a friction row.
    pub c: f64,
    /// The blocks of J for [v; ω] of body 0 and of body 1.
    pub jacobian: [Vector6<f64>; 2],
    /// The velocity product J'u (m/s² or rad/s²).
    pub velocity_product: f64,
    /// The bounds of the row's force.
    pub bounds: Bounds,
    /// The target of J u (m/s or rad/s): 0 except for motors.
    pub speed: f64,
    /// Its spring and damper; `None` for a rigid row.
    pub spring: Option<Spring>,
}

/// A compliant row: x = −(k c + d ċ), evaluated at the end of the step, so that any stiffness is
/// stable.
///
/// ```text
/// over a step h:   w = J u⁺ + β/h c + γ x,   γ = 1/(h (d + h k)),   β = h k/(d + h k)
/// ```
///
/// Catto, *Soft Constraints*, GDC 2011.
///
/// ```
/// use lcplab_bodies::constraint::Spring;
///
/// // 8 N/m and 1 N s/m in a step of 1/8 s: h (d + h k) = ¼ N s per m/s.
/// let spring = Spring { stiffness: 8.0, damping: 1.0 };
/// assert_eq!(spring.compliance(0.125), 4.0);
/// assert_eq!(spring.feedback(0.125), 4.0); // k / (d + h k)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// k (N/m or N m/rad), at least 0.
    pub stiffness: f64,
    /// d (N s/m or N m s/rad), at least 0; k and d are not both 0.
    pub damping: f64,
}

impl Spring {
    /// γ (m/s per N s, or rad/s per N m s) over a step of h (s): the row's contribution to the
    /// diagonal of A.
    pub fn compliance(&self, h: f64) -> f64 {
        1.0 / (h * (self.damping + h * self.stiffness))
    }

    /// β/h (1/s) over a step of h (s).
    pub fn feedback(&self, h: f64) -> f64 {
        self.stiffness / (self.damping + h * self.stiffness)
    }
}

impl Row {
    /// Whether it is a rigid equation that only prevents rotation, like two rows of a hinge.
    pub fn holds_axis(&self) -> bool {
        let only_turns = |j: &Vector6<f64>| linear(j) == Vector3::zeros();
        let is_rigid = self.bounds == Bounds::Bilateral && self.spring.is_none();
        is_rigid && self.jacobian.iter().all(only_turns)
    }

    /// A row of an equation c = 0: any x, no target speed, no spring.
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

    /// The row of −c: turns a lower limit into an upper one.
    pub(crate) fn negated(self) -> Self {
        Row {
            c: -self.c,
            jacobian: self.jacobian.map(|j| -j),
            velocity_product: -self.velocity_product,
            ..self
        }
    }
}

/// The kind of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Two points coincide, along a world axis.
    Coincidence,
    /// The distance of two points: fixed, limited, or with a spring.
    Distance,
    /// The motion of a point along an axis of body 0.
    Translation,
    /// The rotation of one body relative to the other.
    Rotation,
    /// Two bodies do not overlap: the normal row of a contact.
    Normal,
    /// A tangential row of a contact.
    Friction,
}

/// The bounds of a row's force (or impulse) x; x ≥ 0 pushes body 1 away from body 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bounds {
    /// Any x: an equation.
    Bilateral,
    /// x ≥ 0: only pushes.
    Unilateral,
    /// |x| ≤ this force (N) or torque (N m): a motor.
    Effort(f64),
    /// |x| ≤ μ x_n; x_n belongs to another row of the same constraint.
    Friction {
        /// The index of the normal row among the rows of this constraint.
        normal: usize,
        /// The coefficient of friction μ.
        mu: f64,
    },
}

impl Kind {
    /// The word used in tables.
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

    /// Whether c is an angle, and x a torque or an angular impulse.
    pub fn is_angular(self) -> bool {
        self == Kind::Rotation
    }
}

impl Bounds {
    /// The smallest and the largest force (N or N m) of an uncoupled row, ∓∞ for a friction row.
    pub fn interval(self) -> (f64, f64) {
        match self {
            Bounds::Unilateral => (0.0, f64::INFINITY),
            Bounds::Effort(effort) => (-effort, effort),
            Bounds::Bilateral | Bounds::Friction { .. } => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }
}

/// A state in which a constraint's direction is not defined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Degenerate {
    /// The reason.
    pub reason: &'static str,
}

impl std::error::Error for Degenerate {}

impl fmt::Display for Degenerate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.reason)
    }
}

/// An angle or another periodic quantity, wrapped to within half a period of 0.
fn wrapped(value: f64, half: f64) -> f64 {
    value - 2.0 * half * (value / (2.0 * half)).round()
}

/// The value of a scalar, without derivatives.
fn plain<T: RealField + Copy>(value: T) -> f64 {
    nalgebra::try_convert(value).unwrap_or(f64::NAN)
}

/// An f64 constant in another scalar type.
fn constant<T: RealField + Copy>(value: f64) -> T {
    nalgebra::convert(value)
}
