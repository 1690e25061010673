//! Figures: plain data in, an SVG picture and its numbers as CSV out.
//!
//! A figure knows nothing of solvers or scenes. Whatever it shows, one name has one colour, dash and
//! marker everywhere ([`style`]), the picture may leave out points that no eye can tell apart, and
//! the CSV never does. The same figure gives the same bytes.

mod axis;
mod bars;
pub mod canvas;
pub mod csv;
mod cut;
mod heat;
mod legend;
mod line;
mod marker;
pub mod number;
pub mod plane;
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

/// A picture with a name, words and numbers.
pub trait Figure {
    /// A short name without spaces: the file's stem and the anchor on a page.
    fn id(&self) -> &str;

    /// One line, drawn above the picture.
    fn title(&self) -> &str;

    /// What the reader should see in the picture, in a sentence or two; it stands beside the picture,
    /// not in it, and may carry the markup of a page.
    fn caption(&self) -> &str;

    /// The picture, a complete SVG document without fonts, scripts or references to other files.
    fn svg(&self) -> String;

    /// Every number behind the picture (RFC 4180), names and units in the first line.
    fn csv(&self) -> String;
}
