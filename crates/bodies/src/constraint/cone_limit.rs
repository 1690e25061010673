//! A cone limit: an axis of body 1 stays within a cone about an axis of body 0, like a shoulder's
//! swing.
//!
//! ```text
//! c   = θ − φ ≥ 0,   φ = angle of e0 and e1 = atan2(|e0×e1|, e0·e1),   x ≥ 0
//! J   = [0, m, 0, −m],   m = e0×e1/|e0×e1|           turning e1 about m widens φ: φ' = m·(ω1 − ω0)
//! J'u = −m'·(ω1 − ω0),   m' = (h' − m (m·h'))/|h|,   h = e0×e1,   h' = (ω0×e0)×e1 + e0×(ω1×e1)
//! ```
//!
//! At the apex, e1 = e0, m is not defined and all directions are equally far from the cone. There
//! the row uses an arbitrary m perpendicular to e0: it states m·swing ≤ θ, a half plane that
//! contains the whole disk |swing| ≤ θ, so it never acts inside the cone. At e1 = −e0 no such
//! choice exists. A cone limit, a ball and a rotation limit about e0 (whose angle is the twist
//! without the swing) form the cone-twist joint of a ragdoll. Baerlocher & Boulic 2001.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{RealField, Vector3};

use super::arms::turning_row;
use super::{
    Bodies, Constraint, Degenerate, Field, Joint, Kind, Position, Row, constant, tangents,
};
use crate::body::{Pose, State};

/// Keeps the angle between two directions, one on each body, below a maximum: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct ConeLimit {
    /// The bodies.
    pub bodies: Bodies,
    /// The unit axes e0, e1, each in its body's frame.
    pub axes: [Vector3<f64>; 2],
    /// The half angle θ of the cone (rad), between 0 and π.
    pub angle: f64,
}

/// |e0×e1| below which the axes count as parallel.
const PARALLEL: f64 = 1e-9;

/// A cone limit for an axis.
pub(super) const CONE: Joint = Joint {
    name: "limit_cone",
    title: "an axis stays within a cone of this half angle",
    bodies: (1, 2),
    turns: 2,
    needs: &[Field::Axis, Field::Angle],
    takes: &[],
    build: |at| {
        let angle = Field::Angle.given(at.angle)?;
        if !(angle < PI) {
            return Err(Field::Angle.fault(format!("must be below π, is {angle}")));
        }
        Ok(Arc::new(ConeLimit { bodies: at.bodies, axes: at.axis_on_both()?, angle }))
    },
};

impl Constraint for ConeLimit {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let [e0, e1] = [0, 1].map(|k| states[k].pose.direction(&self.axes[k]));
        let [omega0, omega1] = [states[0].omega, states[1].omega];
        let h = e0.cross(&e1);
        let (sine, cosine) = (h.norm(), e0.dot(&e1));
        let c = self.angle - sine.atan2(cosine);
        let row = |m: Vector3<f64>, product| {
            Row::inequality(Kind::Rotation, c, turning_row(&-m), product)
        };
        if sine < PARALLEL && cosine < 0.0 {
            return Err(Degenerate { reason: "the axis points opposite to the axis of its cone" });
        }
        if sine < PARALLEL {
            return Ok(vec![row(tangents(&e0)[0], 0.0)]);
        }
        let m = h / sine;
        let h_rate = omega0.cross(&e0).cross(&e1) + e0.cross(&omega1.cross(&e1));
        let m_rate = (h_rate - m * m.dot(&h_rate)) / sine;
        Ok(vec![row(m, -m_rate.dot(&(omega1 - omega0)))])
    }
}

impl Position for ConeLimit {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let [e0, e1] = [0, 1].map(|k| poses[k].direction(&self.axes[k]));
        vec![constant::<T>(self.angle) - e0.cross(&e1).norm().atan2(e0.dot(&e1))]
    }
}
