//! A massless rod by the squared distance of its ends: the chapter's other form of a rod (W4).
//!
//! ```text
//! c   = (|d|² − l²)/(2l)
//! J   = [−n, −(r0×n), n, r1×n]  with n = d/l
//! J'u = n·cent + |rel|²/l                      since c' = d·rel/l and d' = rel
//! ```
//!
//! The chapter's |d|² − l² is 2l times this c, so its multiplier is 1/(2l) of this x; divided by
//! 2l, c is a length and x a force, and at |d| = l both are equal to the rod's. This form needs no
//! square root and no division by |d|. But for |d| ≠ l its c is that of the rod times (1 + c/2l)
//! and its row has the length |d|/l, so corrections differ from the rod's in second order. At d = 0
//! the row is zero: this form has no direction there either.

use std::sync::Arc;

use nalgebra::{RealField, Vector3};

use super::arms::{Arms, separation};
use super::distance::COINCIDENT;
use super::{
    Bodies, Constraint, Degenerate, Distance, Field, Joint, Kind, Position, Row, constant,
};
use crate::body::{Pose, State};

/// Keeps a point of body 1 at a distance from a point of body 0, by the squares: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct SquaredDistance {
    /// The bodies.
    pub bodies: Bodies,
    /// The ends of the rod, each in its body's frame (m).
    pub anchors: [Vector3<f64>; 2],
    /// The length l (m), positive.
    pub length: f64,
}

/// A massless rod by the squared distance.
pub(super) const SQUARED_DISTANCE: Joint = Joint {
    name: "squared_distance",
    title: "a massless rod, with the square of its length in c",
    bodies: (1, 2),
    turns: 0,
    needs: &[],
    takes: &[Field::Points, Field::Length],
    build: |at| {
        let Distance { bodies, anchors, length } = Distance::of(at)?;
        Ok(Arc::new(SquaredDistance { bodies, anchors, length }))
    },
};

impl Constraint for SquaredDistance {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let arms = Arms::new(states, &self.anchors);
        if arms.d == Vector3::zeros() {
            return Err(COINCIDENT);
        }
        let l = self.length;
        let n = arms.d / l;
        let c = 0.5 * (arms.d.norm_squared() / l - l);
        let product = n.dot(&arms.cent) + arms.rel.norm_squared() / l;
        Ok(vec![Row::equation(Kind::Distance, c, arms.row(&n), product)])
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        Some(self.anchors)
    }
}

impl Position for SquaredDistance {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let l = constant::<T>(self.length);
        let excess = separation(poses, &self.anchors).norm_squared() - l * l;
        vec![excess / (l + l)]
    }
}
