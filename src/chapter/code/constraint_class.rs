//! The class `Constraint_c`, from which all constraints of the listings derive, and its method
//! `IsEquality`.
//!
//! A constraint states its number of rows, its block of J for a body, and its penalty, the position
//! error that is fed back. In print the bounds of x depend only on a method that returns "no
//! equation" unless it is overridden, and Code 7 never calls it (E31). In the corrected form each
//! row states its bounds, and there is no default. Where the listing returns an empty matrix for a
//! body that is not involved (E59), this code returns `None`; where it stops the program in a
//! method that was not overridden, Rust requires the method.

use nalgebra::{DMatrix, DVector, Vector3};

use super::Listing;
use super::code05_rigid_body::{RigidBody, Vectors};

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "class",
    title: "the class of constraints, and IsEquality",
    printed: "Dimension, Jacobian for a body, penalty; IsEquality answers false unless overridden.",
    corrected: "Each row states its bounds; there is no default.",
    errata: &["E31", "E33", "E59"],
};

/// A constraint between bodies of a world.
pub trait Constraint: std::fmt::Debug {
    /// The number of its rows.
    fn dimension(&self) -> usize;

    /// Its block of J for this body, `dimension` × 6; `None` if the body is not involved.
    fn jacobian(&self, bodies: &[RigidBody], body: usize) -> Option<DMatrix<f64>>;

    /// The position error of each row (m).
    fn penalty(&self, bodies: &[RigidBody]) -> DVector<f64>;

    /// As printed: whether its rows are equations; false by default.
    fn is_equality(&self) -> bool {
        false
    }

    /// As corrected: the bounds on x in each row.
    fn bounds(&self) -> Vec<(f64, f64)>;
}

/// Two points, one on each body or in the world, with a relation along axes of the world: a ball
/// joint or nail has three axes, a contact one.
///
/// ```text
/// c = n · d,   d = (p1 + r1) − (p0 + r0),   ∂c/∂s = [−n, −r0×n, n, r1×n]
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// The indices of the bodies; `None` is the world.
    pub bodies: [Option<usize>; 2],
    /// The point in each body's frame, in the world's for `None` (m).
    pub anchors: [Vector3<f64>; 2],
    /// The directions n, one per row.
    pub axes: Vec<Vector3<f64>>,
    /// J as a multiple of ∂c/∂s: 1 as in (39) and (42), −1 as in (34) and (44).
    pub jacobian: f64,
    /// The penalty as a multiple of c: 1 as in (25).
    pub penalty: f64,
    /// The bounds on x in each of its rows.
    pub bounds: (f64, f64),
}

impl Joint {
    /// A row along the world's z between the centers of two bodies that keeps them `length` (m)
    /// apart; J = ∂c/∂s.
    pub fn rod(bodies: [Option<usize>; 2], length: f64) -> Self {
        Joint {
            bodies,
            anchors: [Vector3::z() * length, Vector3::zeros()],
            axes: vec![Vector3::z()],
            jacobian: 1.0,
            penalty: 1.0,
            bounds: (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// The same as an inequality: a contact with x ≥ 0 that only keeps them from coming nearer.
    pub fn contact(bodies: [Option<usize>; 2], length: f64) -> Self {
        Joint { bounds: (0.0, f64::INFINITY), ..Joint::rod(bodies, length) }
    }

    /// Two points held together, both in their bodies' frames (m); J = ∂c/∂s.
    pub fn ball(bodies: [Option<usize>; 2], anchors: [Vector3<f64>; 2]) -> Self {
        let axes = vec![Vector3::x(), Vector3::y(), Vector3::z()];
        Joint { anchors, axes, ..Joint::rod(bodies, 0.0) }
    }

    /// The point on one side: its position and its arm from the center of mass (m, world).
    fn point(&self, bodies: &[RigidBody], side: usize) -> (Vector3<f64>, Vector3<f64>) {
        match self.bodies[side] {
            None => (self.anchors[side], Vector3::zeros()),
            Some(body) => {
                let body = &bodies[body];
                let arm = body.orientation_matrix(Vectors::Columns) * self.anchors[side];
                (body.position + arm, arm)
            }
        }
    }
}

impl Constraint for Joint {
    fn dimension(&self) -> usize {
        self.axes.len()
    }

    fn jacobian(&self, bodies: &[RigidBody], body: usize) -> Option<DMatrix<f64>> {
        let side = self.bodies.iter().position(|&own| own == Some(body))?;
        let (_, arm) = self.point(bodies, side);
        let sign = if side == 0 { -self.jacobian } else { self.jacobian };
        let entries = self.axes.iter().flat_map(|n| {
            let turn = arm.cross(n);
            [n.x, n.y, n.z, turn.x, turn.y, turn.z].map(|entry| sign * entry)
        });
        Some(DMatrix::from_row_iterator(self.axes.len(), 6, entries))
    }

    fn penalty(&self, bodies: &[RigidBody]) -> DVector<f64> {
        let d = self.point(bodies, 1).0 - self.point(bodies, 0).0;
        DVector::from_iterator(self.axes.len(), self.axes.iter().map(|n| self.penalty * n.dot(&d)))
    }

    fn bounds(&self) -> Vec<(f64, f64)> {
        vec![self.bounds; self.axes.len()]
    }
}
