//! Pictures of a moving scene: several instants side by side, seen by one camera.
//!
//! ```text
//! bodies ─→ solids, rods ─→ depth order ─→ visibility ─→ ink
//!           in metres        in metres      in px           SVG
//! ```
//!
//! A [`Frame`] is one instant; a [`Strip`] shows several and is a [`Figure`] like any other. All
//! bodies are convex, so a plane separates any two that do not overlap, and the painting order
//! follows from the sides of these planes; hidden parts are omitted. A new shape needs one function
//! in `solid.rs`. An [`Animation`] is the same motion instant by instant, by several solvers, as
//! data for a player that draws the same pictures as a strip.

mod arrow;
mod camera;
mod clip;
mod colors;
mod coverage;
mod depth;
mod extent;
mod frame;
mod ground;
mod ink;
mod joint;
mod layout;
mod player;
mod solid;
mod strip;

#[cfg(doc)]
use crate::plot::Figure;
pub use camera::{Camera, View};
pub use frame::{Force, Frame, Origin, instants};
pub use player::{Animation, Measure, Recording, Sample};
pub use strip::{Arrows, Strip};
