//! A massless, inextensible rope: two points are at most a length apart.
//!
//! ```text
//! c = l − |d| ≥ 0,   x ≥ 0        the rod's row, negated:   J = −J_rod,   J'u = −J'u_rod
//! ```
//!
//! x is the tension: it pulls the ends together and is 0 while the rope is slack.

use std::sync::Arc;

use nalgebra::{RealField, Vector3};

use super::{Bodies, Bounds, Constraint, Degenerate, Distance, Field, Joint, Position, Row};
use crate::body::{Pose, State};

/// The rod that the taut rope is equivalent to: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct Rope(pub Distance);

/// A rope.
pub(super) const ROPE: Joint = Joint {
    name: "rope",
    title: "a rope: two points at most a length apart",
    bodies: (1, 2),
    turns: 0,
    needs: &[],
    takes: &[Field::Points, Field::Length],
    build: |at| Ok(Arc::new(Rope(Distance::of(at)?))),
};

impl Constraint for Rope {
    fn bodies(&self) -> Bodies {
        self.0.bodies()
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let taut = |row: Row| Row { bounds: Bounds::Unilateral, ..row.negated() };
        Ok(self.0.rows(states)?.into_iter().map(taut).collect())
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        self.0.anchors()
    }
}

impl Position for Rope {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        self.0.c(poses).into_iter().map(|c| -c).collect()
    }
}
