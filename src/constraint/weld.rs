//! Body 1 is fixed to body 0: the weld, and with the world as body 0 the chapter's *fixed*.
//!
//! ```text
//! c = (c of the coincidence, c of the orientation),   6 rows; J and J'u likewise
//! ```

use std::sync::Arc;

use nalgebra::{RealField, Vector3};

use super::{
    Bodies, Coincidence, Constraint, Degenerate, Field, Joint, Orientation, Position, Row,
};
use crate::body::{Pose, State};

/// A coincidence and an orientation of the same two bodies: 6 rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Weld {
    /// Keeps a point.
    pub point: Coincidence,
    /// Keeps the orientation.
    pub orientation: Orientation,
}

/// No relative motion at all.
pub(super) const FIXED: Joint = Joint {
    name: "fixed",
    title: "a weld: no relative motion at all",
    bodies: (1, 2),
    turns: true,
    fields: &[Field::Point],
    build: |at| {
        let point = Coincidence { bodies: at.bodies, anchors: at.anchors() };
        let orientation = Orientation { bodies: at.bodies, relative: at.relative() };
        Ok(Arc::new(Weld { point, orientation }))
    },
};

impl Constraint for Weld {
    fn bodies(&self) -> Bodies {
        self.point.bodies
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let mut rows = self.point.rows(states)?;
        rows.extend(self.orientation.rows(states)?);
        Ok(rows)
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        self.point.anchors()
    }
}

impl Position for Weld {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let mut c = self.point.c(poses);
        c.extend(self.orientation.c(poses));
        c
    }
}
