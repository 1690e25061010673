//! A direction of body 0 and a direction of body 1 stay perpendicular.
//!
//! ```text
//! c   = e0·e1,   e0 = R0 e0_body,   e1 = R1 e1_body          (1 row: the cosine of their angle)
//! c'  = (ω0×e0)·e1 + e0·(ω1×e1) = m·(ω1 − ω0),   m = e1×e0
//! J   = [0, −m, 0, m]
//! J'u = m'·(ω1 − ω0),   m' = (ω1×e1)×e0 + e1×(ω0×e0)
//! ```
//!
//! by the identity a·(b×c) = b·(c×a). One such row is the cross of a universal joint; two, with
//! directions perpendicular to an axis, make the axes of a hinge parallel. Near c = 0 the cosine is
//! the deviation of the angle from 90°. K&M §Constraints, combined; Cline & Pai 2003.

use nalgebra::{RealField, Vector3};

use super::arms::turning_row;
use super::{Bodies, Constraint, Degenerate, Fault, Kind, Placement, Position, Row, tangents};
use crate::body::{Pose, State};

/// Two directions, one on each body, stay perpendicular: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Perpendicular {
    /// The bodies.
    pub bodies: Bodies,
    /// The unit directions, each in its body's frame.
    pub directions: [Vector3<f64>; 2],
}

impl Perpendicular {
    /// Keeps the axis of a placement parallel on both bodies.
    ///
    /// # Errors
    /// If the placement has no axis.
    pub(crate) fn parallel(at: &Placement) -> Result<[Perpendicular; 2], Fault> {
        let [axis, on_body_1] = at.axis_on_both()?;
        let directions = tangents(&axis).map(|across| [across, on_body_1]);
        Ok(directions.map(|directions| Perpendicular { bodies: at.bodies, directions }))
    }
}

impl Constraint for Perpendicular {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let [e0, e1] = [0, 1].map(|k| states[k].pose.direction(&self.directions[k]));
        let [omega0, omega1] = [states[0].omega, states[1].omega];
        let m = e1.cross(&e0);
        let m_rate = omega1.cross(&e1).cross(&e0) + e1.cross(&omega0.cross(&e0));
        let product = m_rate.dot(&(omega1 - omega0));
        Ok(vec![Row::equation(Kind::Rotation, e0.dot(&e1), turning_row(&m), product)])
    }
}

impl Position for Perpendicular {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let [e0, e1] = [0, 1].map(|k| poses[k].direction(&self.directions[k]));
        vec![e0.dot(&e1)]
    }
}
