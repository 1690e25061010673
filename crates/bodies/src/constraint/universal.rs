//! The universal joint (Cardan, Hooke): two perpendicular axes through a point, the first on body
//! 0, the second on body 1.
//!
//! ```text
//! c = (c of the coincidence, e0·e1),   4 rows; J and J'u likewise
//! ```
//!
//! The joint locks the rotation about the normal of its cross. If the arms of the cross were
//! aligned (folded by 90°, which c = 0 does not allow), the row would be zero. K&M T27.

use std::sync::Arc;

use super::{Coincidence, Field, Joint, Perpendicular};

/// A shared point and two perpendicular axes: 4 rows.
pub type Universal = (Coincidence, Perpendicular);

/// Largest deviation from a right angle (rad) of the axes in a file; they are made perpendicular.
const SQUARE: f64 = 1e-3;

/// A universal joint.
pub(super) const UNIVERSAL: Joint = Joint {
    name: "universal",
    title: "a universal joint: turns about two perpendicular axes, one on each body",
    bodies: (1, 2),
    turns: 2,
    needs: &[Field::Axes],
    takes: &[Field::Point],
    build: |at| {
        let [e0, e1] = Field::Axes.given(at.axes)?;
        let cosine = e0.dot(&e1);
        if cosine.abs() > SQUARE {
            let degrees = cosine.acos().to_degrees();
            return Err(
                Field::Axes.fault(format!("must be perpendicular, are {degrees:.1}° apart"))
            );
        }
        let e1 = (e1 - e0 * cosine).normalize();
        let directions = [at.poses[0].q.inverse() * e0, at.poses[1].q.inverse() * e1];
        let point = Coincidence { bodies: at.bodies, anchors: at.anchors() };
        Ok(Arc::new((point, Perpendicular { bodies: at.bodies, directions })))
    },
};
