//! The hinge (revolute joint): body 1 rotates about an axis n through a point of body 0.
//!
//! ```text
//! c = (c of the coincidence, t1·a, t2·a),   5 rows; J and J'u likewise
//! ```
//!
//! a is the axis on body 1, t1 and t2 are two directions on body 0 perpendicular to the axis: if
//! both are perpendicular to a, then a = ±n, and the motion preserves the sign. K&M T27.

use std::sync::Arc;

use super::{Coincidence, Field, Joint, Perpendicular};

/// A shared point and parallel axes: 5 rows.
pub type Hinge = (Coincidence, [Perpendicular; 2]);

/// A hinge.
pub(super) const HINGE: Joint = Joint {
    name: "hinge",
    title: "a hinge: turns about an axis through a point",
    bodies: (1, 2),
    turns: 2,
    needs: &[Field::Axis],
    takes: &[Field::Point, Field::StartSpeed],
    build: |at| {
        let point = Coincidence { bodies: at.bodies, anchors: at.anchors() };
        Ok(Arc::new((point, Perpendicular::parallel(at)?)))
    },
};
