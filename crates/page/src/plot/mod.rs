//! Figures: plain data in, an SVG picture and its numbers as CSV out.
//!
//! A figure knows nothing of solvers or scenes. Whatever it shows, one name has one colour, dash
//! and marker everywhere ([`style`]), the picture may leave out points that no eye can tell apart,
//! and the CSV never does. The same figure gives the same bytes.

mod axis;
mod bars;
pub mod canvas;
mod cut;
mod heat;
mod legend;
mod line;
mod marker;
mod points;
pub mod profile;
mod raster;
mod spies;
mod spy;
pub mod style;

pub use axis::{Axis, Scale, Tick, round_step};
pub use bars::{Bar, Bars};
pub use heat::{Heat, Shaded};
pub use line::{Lines, Look, Panel, Series};
pub use raster::Raster;
pub use spies::{Small, Spies};
pub use spy::Spy;

pub use crate::figure::Figure;
