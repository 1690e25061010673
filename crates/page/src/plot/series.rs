//! A curve: its points, its kind and its label.

use crate::number::{count, readable};

/// A named curve.
#[derive(Debug, Clone)]
pub struct Series {
    /// The name in the legend; it determines the color ([`style`](super::style::style)).
    pub name: String,
    /// The points in drawing order. A point that an axis cannot show (not finite, or not positive
    /// on a logarithmic axis) breaks the line.
    pub points: Vec<(f64, f64)>,
    /// The kind of the curve.
    pub look: Look,
    /// The label at the end of the curve; without one, the legend has its name.
    pub end: Option<String>,
}

/// The kind of a curve, which determines how it is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// Measured or computed data: colored, with markers. They determine the ranges of the axes.
    Measured,
    /// Measured points that do not form a line: one marker each. They determine the ranges, too.
    Points,
    /// The prediction of a formula: a pale band behind the data, clipped at the frame.
    Theory,
    /// A known value or limit: a thin dark line, clipped at the frame.
    Reference,
}

impl Series {
    /// A measured curve.
    pub fn measured(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Series { name: name.into(), points, look: Look::Measured, end: None }
    }

    /// Measured points that are not joined.
    pub fn points(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Series { name: name.into(), points, look: Look::Points, end: None }
    }

    /// A predicted curve. One with the name `theory, NAME`, or `theory, NAME: …`, belongs to the
    /// curve NAME: a page shows and hides them together.
    pub fn theory(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Series { name: name.into(), points, look: Look::Theory, end: None }
    }

    /// A known value or limit.
    pub fn reference(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Series { name: name.into(), points, look: Look::Reference, end: None }
    }

    /// A place on a curve, such as its minimum: a ring in its color, with an entry in the legend.
    pub fn spot(curve: &str, what: &str, point: (f64, f64)) -> Self {
        Series::reference(format!("theory, {curve}: {what}"), vec![point])
    }

    /// Whether it is one known point.
    pub(super) fn is_spot(&self) -> bool {
        self.look == Look::Reference && self.points.len() == 1
    }

    /// The largest magnitude of the curve; 0 without points.
    pub fn size(&self) -> f64 {
        let sizes = self.points.iter().map(|(_, y)| y.abs()).filter(|size| size.is_finite());
        sizes.fold(0.0, f64::max)
    }

    /// The same, with a label at its end in place of an entry in the legend.
    pub fn labeled(self, end: impl Into<String>) -> Self {
        Series { end: Some(end.into()), ..self }
    }
    /// Its kind and its ends, in words.
    pub(super) fn description(&self) -> String {
        let finite = |point: &&(f64, f64)| point.0.is_finite() && point.1.is_finite();
        let (first, last) =
            (self.points.iter().find(finite), self.points.iter().rev().find(finite));
        let name = format!("{} ({}", self.name, self.look.word());
        let points = self.points.len();
        match (first, last) {
            (Some(first), Some(last)) if points > 1 && first.0 == last.0 => {
                format!("{name}) is a vertical line at {}", readable(first.0, 2))
            }
            (Some(first), Some(_)) if points == 1 => {
                format!("{name}, 1 point) is {}", readable(first.1, 2))
            }
            (Some(first), Some(last)) => format!(
                "{name}, {} points) goes from {} to {}",
                count(points),
                readable(first.1, 2),
                readable(last.1, 2)
            ),
            _ => format!("{} has no points", self.name),
        }
    }
}

impl Look {
    /// Whether it is measured data.
    pub(super) fn is_measured(self) -> bool {
        matches!(self, Look::Measured | Look::Points)
    }

    /// The kind in a word.
    pub(super) fn word(self) -> &'static str {
        match self {
            Look::Measured | Look::Points => "measured",
            Look::Theory => "theory",
            Look::Reference => "reference",
        }
    }
}
