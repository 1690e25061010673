//! A massless rod: two points keep their distance.
//!
//! ```text
//! c   = |d| − l,   n = d/|d|
//! J   = [−n, −(r0×n), n, r1×n]
//! J'u = n·cent + (|rel|² − (n·rel)²)/|d|      since n' = (rel − n (n·rel))/|d|
//! ```
//!
//! x ≥ 0 pushes the ends apart: a rod under tension has x < 0. If the ends coincide, n is not
//! defined.

use std::sync::Arc;

use nalgebra::{RealField, Vector3};

use super::arms::{Arms, separation};
use super::{
    Bodies, Constraint, Degenerate, Fault, Field, Joint, Kind, Placement, Position, Row, constant,
};
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

/// A massless rod.
pub(super) const DISTANCE: Joint = Joint {
    name: "distance",
    title: "a massless rod between two points",
    bodies: (1, 2),
    turns: 0,
    needs: &[],
    takes: &[Field::Points, Field::Length],
    build: |at| Ok(Arc::new(Distance::of(at)?)),
};

impl Distance {
    /// The rod between the ends of a placement, with its length or, without one, their distance.
    ///
    /// # Errors
    /// If the placement has no ends, or the length is 0.
    pub(crate) fn of(at: &Placement) -> Result<Self, Fault> {
        let (anchors, apart) = at.ends()?;
        let length = at.length.unwrap_or(apart);
        if length > 0.0 {
            return Ok(Distance { bodies: at.bodies, anchors, length });
        }
        Err(Field::Length.fault(format!("must be positive, is {length}")))
    }
}

impl Constraint for Distance {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let mut rows = Vec::with_capacity(1);
        self.add_rows(states, &mut rows)?;
        Ok(rows)
    }

    fn add_rows(&self, states: [&State; 2], rows: &mut Vec<Row>) -> Result<(), Degenerate> {
        let arms = Arms::new(states, &self.anchors);
        let n = arms.d.try_normalize(0.0).ok_or(COINCIDENT)?;
        let (c, product) = (arms.d.norm() - self.length, arms.product_of_distance(&n));
        rows.push(Row::equation(Kind::Distance, c, arms.row(&n), product));
        Ok(())
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        Some(self.anchors)
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
