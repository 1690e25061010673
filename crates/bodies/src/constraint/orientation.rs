//! Body 1 keeps its orientation relative to body 0.
//!
//! ```text
//! e   = conj(q0) q1 conj(q_rel), with the sign that makes e_w ≥ 0
//! c   = 2 e_v                                 (3 rows, in body 0's frame; |c| = 2 sin(angle/2))
//! a   = R0ᵀ (ω1 − ω0),   G = e_w I − [e_v]×,  so e_v' = ½ G a and c' = G a
//! J   = [0, −G R0ᵀ, 0, G R0ᵀ]
//! J'u = −½ |a|² e_v − G R0ᵀ (ω0×ω1)
//! ```
//!
//! The first term of J'u is G' a: e_w' = −½ e_v·a and e_v' = ½ G a give −½ |a|² e_v; the second is
//! G times the velocity part of a'. At c = 0, G = I.

use std::sync::Arc;

use nalgebra::{Matrix3, RealField, UnitQuaternion, Vector3};

use super::arms::turning_row;
use super::{Bodies, Constraint, Degenerate, Joint, Kind, Position, Row, constant};
use crate::body::{Pose, State};

/// Body 1 does not rotate relative to body 0: 3 rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Orientation {
    /// The bodies.
    pub bodies: Bodies,
    /// The orientation of body 1 seen from body 0, conj(q0) q1, at which c = 0.
    pub relative: UnitQuaternion<f64>,
}

impl Orientation {
    /// The row of the component of c along `axis`, a unit vector in body 0's frame.
    pub(super) fn row_along(&self, axis: &Vector3<f64>, states: [&State; 2]) -> Row {
        let [s0, s1] = states;
        let (e_w, e_v) = self.error([&s0.pose, &s1.pose]);
        let to_body_0 = s0.pose.q.inverse();
        let a = to_body_0 * (s1.omega - s0.omega);
        let g = Matrix3::from_diagonal_element(e_w) - e_v.cross_matrix();
        // axisᵀ G R0ᵀ as a column.
        let along = s0.pose.q * (g.transpose() * axis);
        let turning = g * (to_body_0 * s0.omega.cross(&s1.omega));
        Row::equation(
            Kind::Rotation,
            2.0 * axis.dot(&e_v),
            turning_row(&along),
            axis.dot(&(-0.5 * a.norm_squared() * e_v - turning)),
        )
    }

    /// e as (e_w, e_v), e_w ≥ 0.
    pub(super) fn error<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> (T, Vector3<T>) {
        let relative = self.relative.coords.map(constant::<T>);
        let relative = UnitQuaternion::new_unchecked(nalgebra::Quaternion::from_vector(relative));
        let e = (poses[0].q.inverse() * poses[1].q * relative.inverse()).into_inner();
        if e.w < T::zero() { (-e.w, -e.imag()) } else { (e.w, e.imag()) }
    }
}

/// No relative rotation.
pub(super) const ORIENTATION: Joint = Joint {
    name: "orientation",
    title: "no relative rotation",
    bodies: (1, 2),
    turns: 2,
    needs: &[],
    takes: &[],
    build: |at| Ok(Arc::new(Orientation { bodies: at.bodies, relative: at.relative() })),
};

impl Constraint for Orientation {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        Ok((0..3).map(|k| self.row_along(&Vector3::ith(k, 1.0), states)).collect())
    }
}

impl Position for Orientation {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let (_, e_v) = self.error(poses);
        e_v.iter().map(|&e| e + e).collect()
    }
}
