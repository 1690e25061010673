//! The weld: body 1 is fixed to body 0; with the world as body 0 it is the chapter's *fixed*.
//!
//! ```text
//! c = (c of the coincidence, c of the orientation),   6 rows; J and J'u likewise
//! ```

use std::sync::Arc;

use super::{Coincidence, Field, Joint, Orientation};

/// A coincidence and an orientation of the same two bodies: 6 rows.
pub type Weld = (Coincidence, Orientation);

/// No relative motion at all.
pub(super) const FIXED: Joint = Joint {
    name: "fixed",
    title: "a weld: no relative motion at all",
    bodies: (1, 2),
    turns: 2,
    needs: &[],
    takes: &[Field::Point],
    build: |at| {
        let point = Coincidence { bodies: at.bodies, anchors: at.anchors() };
        let orientation = Orientation { bodies: at.bodies, relative: at.relative() };
        Ok(Arc::new((point, orientation)))
    },
};
