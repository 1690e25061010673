//! Two points keep their distance: a massless rod.
//!
//! ```text
//! c   = |d| − l,   n = d/|d|
//! J   = [−n, −(r0×n), n, r1×n]
//! J'u = n·cent + (|rel|² − (n·rel)²)/|d|      since n' = (rel − n (n·rel))/|d|
//! ```
//!
//! x ≥ 0 pushes the ends apart: a rod under tension has x < 0. Where the ends coincide n is not
//! defined. `math §2`.

use nalgebra::{RealField, Vector3};

use super::arms::{Arms, separation};
use super::{Bodies, Bounds, Constraint, Degenerate, Kind, Position, Row, constant};
use crate::body::{Pose, State};

/// A point of body 1 stays at a distance from a point of body 0: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Distance {
    /// The bodies.
    pub bodies: Bodies,
    /// The ends of the rod, each in its body's frame (m).
    pub anchors: [Vector3<f64>; 2],
    /// The length l (m), positive.
    pub length: f64,
}

impl Constraint for Distance {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let arms = Arms::new(states, &self.anchors);
        let n = arms.d.try_normalize(0.0).ok_or(COINCIDENT)?;
        Ok(vec![Row {
            kind: Kind::Distance,
            c: arms.d.norm() - self.length,
            jacobian: arms.row(&n),
            velocity_product: arms.product_of_distance(&n),
            bounds: Bounds::Bilateral,
        }])
    }
}

/// The distance of coincident points has no derivative.
pub(super) const COINCIDENT: Degenerate =
    Degenerate { reason: "the two points coincide, so their distance has no direction" };

impl Position for Distance {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        vec![separation(poses, &self.anchors).norm() - constant(self.length)]
    }
}
