//! One degree of freedom locked: no translation along an axis, or no rotation about it.
//!
//! The axis n is fixed to body 0; if body 0 is the world, n is a world axis.
//!
//! ```text
//! translation  c = n·d − offset     J, J'u as of a contact with n fixed to body 0
//! rotation     c = 2 n·e_v          the component along n of the relative orientation
//! ```
//!
//! A slider consists of two translation locks and an orientation.

use std::sync::Arc;

use nalgebra::{RealField, Vector3};

use super::arms::separation;
use super::coordinate::translation;
use super::{
    Bodies, Constraint, Degenerate, Fault, Field, Joint, Orientation, Placement, Position, Row,
    constant, tangents,
};
use crate::body::{Pose, State};

/// Locks one motion of body 1 relative to body 0: 1 row.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisLock {
    /// The bodies.
    pub bodies: Bodies,
    /// The unit axis, in body 0's frame.
    pub axis: Vector3<f64>,
    /// The locked motion.
    pub motion: Motion,
}

/// A motion along or about an axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// A point of body 1 stays in a plane perpendicular to the axis.
    Translation {
        /// A point of each body, in its frame (m).
        anchors: [Vector3<f64>; 2],
        /// The value of n·d (m) at which c = 0.
        offset: f64,
    },
    /// The rotation vector of body 1 relative to `relative` has no component along the axis.
    Rotation {
        /// The reference orientation.
        relative: Orientation,
    },
}

/// No translation along an axis.
pub(super) const TRANSLATION: Joint = Joint {
    name: "lock_translation",
    title: "no translation along an axis",
    bodies: (1, 2),
    turns: 0,
    needs: &[Field::Axis],
    takes: &[],
    build: |at| {
        let motion = Motion::Translation { anchors: at.anchors(), offset: 0.0 };
        Ok(Arc::new(AxisLock { bodies: at.bodies, axis: at.axis()?, motion }))
    },
};

/// No rotation about an axis.
pub(super) const ROTATION: Joint = Joint {
    name: "lock_rotation",
    title: "no rotation about an axis",
    bodies: (1, 2),
    turns: 2,
    needs: &[Field::Axis],
    takes: &[],
    build: |at| {
        let relative = Orientation { bodies: at.bodies, relative: at.relative() };
        let motion = Motion::Rotation { relative };
        Ok(Arc::new(AxisLock { bodies: at.bodies, axis: at.axis()?, motion }))
    },
};

impl AxisLock {
    /// A point of body 1 stays on the line through the placement's point along its axis.
    ///
    /// # Errors
    /// If the placement has no axis.
    pub(crate) fn on_line(at: &Placement) -> Result<[AxisLock; 2], Fault> {
        let (bodies, anchors) = (at.bodies, at.anchors());
        let motion = Motion::Translation { anchors, offset: 0.0 };
        Ok(tangents(&at.axis()?).map(|axis| AxisLock { bodies, axis, motion: motion.clone() }))
    }
}

impl Constraint for AxisLock {
    fn bodies(&self) -> Bodies {
        self.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let row = match &self.motion {
            Motion::Rotation { relative } => relative.row_along(&self.axis, states),
            Motion::Translation { anchors, offset } => {
                translation(&self.axis, anchors, *offset, states)
            }
        };
        Ok(vec![row])
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        match self.motion {
            Motion::Translation { anchors, .. } => Some(anchors),
            Motion::Rotation { .. } => None,
        }
    }
}

impl Position for AxisLock {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let c = match &self.motion {
            Motion::Rotation { relative } => {
                let (_, e_v) = relative.error(poses);
                let c = self.axis.map(constant::<T>).dot(&e_v);
                c + c
            }
            Motion::Translation { anchors, offset } => {
                let n = poses[0].direction(&self.axis);
                n.dot(&separation(poses, anchors)) - constant(*offset)
            }
        };
        vec![c]
    }
}
