//! The cylindrical joint: body 1 moves along an axis n of body 0 and rotates about it.
//!
//! ```text
//! c = (t1·d, t2·d, t1·a, t2·a),   4 rows; J and J'u likewise
//! ```
//!
//! It consists of the slider's translation locks and the hinge's parallel axes. K&M T27.

use std::sync::Arc;

use super::{AxisLock, Field, Joint, Perpendicular};

/// A point on a line and parallel axes: 4 rows.
pub type Cylindrical = ([AxisLock; 2], [Perpendicular; 2]);

/// A shaft in a sleeve.
pub(super) const CYLINDRICAL: Joint = Joint {
    name: "cylindrical",
    title: "a shaft in a sleeve: moves along an axis and turns about it",
    bodies: (1, 2),
    turns: 2,
    needs: &[Field::Axis],
    takes: &[Field::Point],
    build: |at| Ok(Arc::new((AxisLock::on_line(at)?, Perpendicular::parallel(at)?))),
};
