//! Two points coincide: a ball joint; with the world as body 0 a *nail*.
//!
//! ```text
//! c   = d                              (3 rows, along the world's axes)
//! J   = [−I, [r0]×, I, −[r1]×]         since (ω×r) = −[r]× ω
//! J'u = cent = ω1×(ω1×r1) − ω0×(ω0×r0)
//! ```
//!
//! Row k is the row of n · d with n the k-th world axis, which is constant. K&M (13).

use std::sync::Arc;

use nalgebra::{RealField, Vector3};

use super::arms::{Arms, separation};
use super::{Bodies, Constraint, Degenerate, Field, Joint, Kind, Position, Row};
use crate::body::{Pose, State};

/// A point of body 1 stays at a point of body 0: 3 rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Coincidence {
    /// The bodies.
    pub bodies: Bodies,
    /// The point in each body's frame (m).
    pub anchors: [Vector3<f64>; 2],
}

/// A point shared by two bodies.
pub(super) const BALL: Joint = Joint {
    name: "ball",
    title: "ball and socket between two bodies",
    bodies: (2, 2),
    turns: 0,
    needs: &[],
    takes: &[Field::Point],
    build: |at| Ok(Arc::new(Coincidence { bodies: at.bodies, anchors: at.anchors() })),
};

/// A point of a body fixed in the world. K&M (35).
pub(super) const NAIL: Joint = Joint {
    name: "nail",
    title: "ball and socket between a body and the world",
    bodies: (1, 1),
    ..BALL
};

impl Constraint for Coincidence {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let mut rows = Vec::with_capacity(3);
        self.add_rows(states, &mut rows)?;
        Ok(rows)
    }

    fn add_rows(&self, states: [&State; 2], rows: &mut Vec<Row>) -> Result<(), Degenerate> {
        let arms = Arms::new(states, &self.anchors);
        rows.extend((0..3).map(|k| {
            let jacobian = arms.row(&Vector3::ith(k, 1.0));
            Row::equation(Kind::Coincidence, arms.d[k], jacobian, arms.cent[k])
        }));
        Ok(())
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        Some(self.anchors)
    }
}

impl Position for Coincidence {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        separation(poses, &self.anchors).iter().copied().collect()
    }
}
