//! The slider (prismatic joint): body 1 moves along an axis n of body 0 and does not rotate.
//!
//! ```text
//! c = (t1·d, t2·d, c of the orientation),   5 rows; J and J'u likewise
//! ```
//!
//! t1 and t2 are two directions on body 0 perpendicular to the axis. K&M T27.

use std::sync::Arc;

use super::{AxisLock, Field, Joint, Orientation};

/// No translation perpendicular to the axis and no rotation: 5 rows.
pub type Slider = ([AxisLock; 2], Orientation);

/// A slider.
pub(super) const SLIDER: Joint = Joint {
    name: "slider",
    title: "a slider: moves along an axis, does not turn",
    bodies: (1, 2),
    turns: 2,
    needs: &[Field::Axis],
    takes: &[Field::Point, Field::StartSpeed],
    build: |at| {
        let orientation = Orientation { bodies: at.bodies, relative: at.relative() };
        Ok(Arc::new((AxisLock::on_line(at)?, orientation)))
    },
};
