//! A massless, frictionless pulley: a rope over two rollers fixed in the world keeps its length.
//!
//! ```text
//! c   = |d0| + |d1| − l,   d_k = p_k − w_k from roller k to the center of body k,   n_k = d_k/|d_k|
//! J   = [n0, 0, n1, 0]
//! J'u = Σ (|v_k|² − (n_k·v_k)²)/|d_k|       since n' = (v − n (n·v))/|d|
//! ```
//!
//! Under tension x < 0: the rope pulls each body toward its roller with −x. If a body is at its
//! roller, n is not defined. The row is an equation, because the rope is assumed to be taut: the
//! sum of two distances to points of the world.

use std::sync::Arc;

use nalgebra::{RealField, Vector3};

use super::{
    Bodies, Constraint, Degenerate, Fault, Field, Joint, Kind, Placement, Position, Row, constant,
};
use crate::body::{Pose, State, stack};

/// The distances of two bodies' centers from two rollers have a constant sum: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulley {
    /// The bodies.
    pub bodies: Bodies,
    /// The points where the rope leaves the rollers, in the order of the bodies (m, world).
    pub rollers: [Vector3<f64>; 2],
    /// The total length l (m) of both free parts, positive.
    pub length: f64,
}

/// A pulley.
pub(super) const PULLEY: Joint = Joint {
    name: "pulley",
    title: "a rope from the center of one body over two points of the world to the center of another",
    bodies: (2, 2),
    turns: 0,
    needs: &[Field::Points],
    takes: &[Field::Length],
    build: |at| Ok(Arc::new(Pulley::of(at)?)),
};

impl Pulley {
    fn of(at: &Placement) -> Result<Self, Fault> {
        let rollers = Field::Points.given(at.points)?;
        let free: f64 = at.poses.iter().zip(rollers).map(|(pose, w)| (pose.p - w).norm()).sum();
        let length = at.length.unwrap_or(free);
        if length > 0.0 {
            return Ok(Pulley { bodies: at.bodies, rollers, length });
        }
        Err(Field::Length.fault(format!("must be positive, is {length}")))
    }
}

impl Constraint for Pulley {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let d = [0, 1].map(|k| states[k].pose.p - self.rollers[k]);
        let (Some(n0), Some(n1)) = (d[0].try_normalize(0.0), d[1].try_normalize(0.0)) else {
            return Err(AT_ROLLER);
        };
        let n = [n0, n1];
        let product = |k: usize| {
            let v = states[k].v;
            (v - n[k] * n[k].dot(&v)).norm_squared() / d[k].norm()
        };
        let c = d[0].norm() + d[1].norm() - self.length;
        let jacobian = n.map(|n| stack(n, Vector3::zeros()));
        Ok(vec![Row::equation(Kind::Distance, c, jacobian, product(0) + product(1))])
    }

    fn lines(&self) -> Vec<(Bodies, [Vector3<f64>; 2])> {
        let part = |k: usize| ([None, self.bodies[k]], [self.rollers[k], Vector3::zeros()]);
        vec![part(0), ([None; 2], self.rollers), part(1)]
    }
}

const AT_ROLLER: Degenerate =
    Degenerate { reason: "a body is at its roller, so the rope has no direction" };

impl Position for Pulley {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let part = |k: usize| (poses[k].p - self.rollers[k].map(constant::<T>)).norm();
        vec![part(0) + part(1) - constant(self.length)]
    }
}
