//! One plot of a stack: a vertical axis and its curves.

use super::axis::Axis;
use super::series::Series;

/// One plot of a stack.
#[derive(Debug, Clone)]
pub struct Panel {
    /// The vertical axis.
    pub y: Axis,
    /// The curves; a name looks the same in every panel.
    pub series: Vec<Series>,
}
