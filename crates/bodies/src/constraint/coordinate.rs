//! The displacement of body 1 along an axis of body 0, or its rotation about it. Limits, motors,
//! springs and gears act on such coordinates.
//!
//! ```text
//! translation   c = n·d (m)            J, J'u as of a contact with n fixed to body 0
//! rotation      φ = 2 atan2(s, e_w) (rad),   s = n·e_v,   −π ≤ φ ≤ π
//! ```
//!
//! with e = (e_w, e_v), a and G of the relative orientation. φ is the twist of e about n: the part
//! of the rotation that remains after removing the shortest rotation that moves n to its place (the
//! swing). With z = e_w + i s, φ = 2 arg z, and z' from e_w' = −½ e_v·a, e_v' = ½ G a:
//!
//! ```text
//! φ'  = 2 Im(z'/z) = t·a,   t = (e_w Gᵀn + s e_v)/|z|²
//! J   = [0, −R0 t, 0, R0 t]
//! J'u = −R0 t·(ω0×ω1) − 2 φ' |z|'/|z|
//! ```
//!
//! by φ'' = 2 Im(z''/z − (z'/z)²), z'' = −¼ |a|² z + (linear in a'), and Re(z'/z) = |z|'/|z|. If
//! the axes coincide, as on a hinge, t = n and φ is the angle. If body 1 is upside down (|z| = 0),
//! the twist is not defined. The state determines φ only up to whole turns. Diebel 2006,
//! *Representing Attitude*.

use nalgebra::{RealField, Vector3};

use super::arms::{Arms, separation, turning_row};
use super::{
    Bodies, Constraint, Degenerate, Fault, Kind, Motion, Orientation, Placement, Position, Row,
    constant,
};
use crate::body::{Pose, State};

/// One coordinate of body 1 relative to body 0; as a constraint it keeps it at 0: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinate {
    /// The bodies.
    pub bodies: Bodies,
    /// The unit axis n, in body 0's frame.
    pub axis: Vector3<f64>,
    /// The motion along or about the axis and its zero; positive about n by the right-hand rule.
    pub motion: Motion,
}

impl Coordinate {
    /// The displacement (m) along the axis of a placement, 0 at the placement's poses.
    ///
    /// # Errors
    /// If the placement has no axis.
    pub(crate) fn along(at: &Placement) -> Result<Self, Fault> {
        let motion = Motion::Translation { anchors: at.anchors(), offset: 0.0 };
        Ok(Coordinate { bodies: at.bodies, axis: at.axis()?, motion })
    }

    /// The angle (rad) about the axis of a placement, 0 at the placement's poses.
    ///
    /// # Errors
    /// If the placement has no axis.
    pub(crate) fn about(at: &Placement) -> Result<Self, Fault> {
        let relative = Orientation { bodies: at.bodies, relative: at.relative() };
        Ok(Coordinate {
            bodies: at.bodies,
            axis: at.axis()?,
            motion: Motion::Rotation { relative },
        })
    }

    /// Whether the coordinate is an angle.
    pub(crate) fn is_angle(&self) -> bool {
        matches!(self.motion, Motion::Rotation { .. })
    }

    /// The coordinate (m or rad).
    ///
    /// ```
    /// use lcplab_bodies::body::Pose;
    /// use lcplab_bodies::constraint::{Coordinate, Motion, Orientation};
    /// use nalgebra::{UnitQuaternion, Vector3};
    ///
    /// // A door that is open by 0.5 rad.
    /// let bodies = [None, Some(0)];
    /// let relative = Orientation { bodies, relative: UnitQuaternion::identity() };
    /// let door = Coordinate { bodies, axis: Vector3::z(), motion: Motion::Rotation { relative } };
    /// let q = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5);
    /// let angle: f64 = door.value([&Pose::default(), &Pose { q, ..Pose::default() }]);
    /// assert!((angle - 0.5).abs() < 1e-15);
    /// ```
    pub fn value<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> T {
        match &self.motion {
            Motion::Translation { anchors, offset } => {
                let n = poses[0].direction(&self.axis);
                n.dot(&separation(poses, anchors)) - constant(*offset)
            }
            Motion::Rotation { relative } => {
                let (e_w, e_v) = relative.error(poses);
                let half = self.axis.map(constant::<T>).dot(&e_v).atan2(e_w);
                half + half
            }
        }
    }

    /// Its row: the coordinate as c, its J and J'u.
    pub(super) fn row(&self, states: [&State; 2]) -> Result<Row, Degenerate> {
        match &self.motion {
            Motion::Translation { anchors, offset } => {
                Ok(translation(&self.axis, anchors, *offset, states))
            }
            Motion::Rotation { relative } => twist(&self.axis, relative, states),
        }
    }
}

/// The row of c = n·d − offset with n fixed to body 0.
pub(super) fn translation(
    axis: &Vector3<f64>,
    anchors: &[Vector3<f64>; 2],
    offset: f64,
    states: [&State; 2],
) -> Row {
    let arms = Arms::new(states, anchors);
    let n = states[0].pose.direction(axis);
    Row::equation(
        Kind::Translation,
        n.dot(&arms.d) - offset,
        arms.row_with_normal_on_body_0(&n),
        arms.product_with_normal_on_body_0(&n, &states[0].omega),
    )
}

/// The row of φ.
fn twist(n: &Vector3<f64>, relative: &Orientation, states: [&State; 2]) -> Result<Row, Degenerate> {
    let [s0, s1] = states;
    let (e_w, e_v) = relative.error([&s0.pose, &s1.pose]);
    let s = n.dot(&e_v);
    let square = e_w * e_w + s * s;
    if square < TURNED_OVER {
        return Err(Degenerate {
            reason: "the axis has turned by 180°, so the angle about it is not defined",
        });
    }
    let a = s0.pose.q.inverse() * (s1.omega - s0.omega);
    // Gᵀ n
    let across = e_w * n - n.cross(&e_v);
    let t = (e_w * across + s * e_v) / square;
    // |z|'/|z|
    let stretch = 0.5 * (s * across.dot(&a) - e_w * e_v.dot(&a)) / square;
    let t_world = s0.pose.q * t;
    let product = -t_world.dot(&s0.omega.cross(&s1.omega)) - 2.0 * t.dot(&a) * stretch;
    Ok(Row::equation(Kind::Rotation, 2.0 * s.atan2(e_w), turning_row(&t_world), product))
}

/// |z|² below which rounding decides the twist.
const TURNED_OVER: f64 = 1e-18;

impl Constraint for Coordinate {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        Ok(vec![self.row(states)?])
    }
}

impl Position for Coordinate {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        vec![self.value(poses)]
    }
}
