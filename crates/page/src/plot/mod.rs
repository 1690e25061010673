//! Figures: plain data in, an SVG picture and its numbers as CSV out.
//!
//! Figures do not depend on solvers or scenes. A name has the same color, dash and marker in every
//! figure ([`style`]). The picture may omit points that cannot be distinguished by eye; the CSV
//! contains all of them. The same figure gives bitwise the same output.

mod axis;
mod bars;
pub mod canvas;
mod cut;
mod ends;
pub mod grades;
mod heat;
mod key;
mod legend;
mod line;
mod marker;
mod panel;
mod place;
mod points;
pub mod profile;
mod raster;
pub mod scene_matrix;
mod series;
mod simplify;
mod small;
mod spy;
pub mod style;

pub use axis::{Axis, Scale, Tick, round_step};
pub use bars::{Bar, Bars};
pub use heat::{Heat, Shaded};
pub use line::Lines;
pub use panel::Panel;
pub use raster::Raster;
pub use series::{Look, Series};
pub use small::Small;
pub use spy::Spy;

pub use crate::figure::Figure;
