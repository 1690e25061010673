//! Attributes of a figure's markup from which a script on a page can label points.
//!
//! ```text
//! <g class="panel" data-frame="left right top bottom"              px
//!    data-x="log 0 3" data-y="linear -1 1"                         scale, positions at the edges
//!    data-x-name="sweep" data-x-unit="" data-y-name="drift" data-y-unit="m">
//!   <g class="series" data-series="pgs" data-points="1 0.25 2 0.125">      x y x y …
//! ```
//!
//! A position is a value, or its decimal logarithm, or, with the scale `symmetric:E`, the logarithm
//! of 1 + |value|/10^E with the value's sign. The picture is complete without these
//! attributes.

use super::axis::{Axis, Scale};
use super::canvas::{Frame, escape};
use crate::csv;

/// The largest number of points of a curve that are all listed.
const ALL: usize = 400;
const APART: f64 = 2.0;
/// Significant digits of x and y.
const DIGITS: (usize, usize) = (6, 4);

/// Opens the group of one plot; an axis without a name (that of bars) has no attributes.
pub(super) fn panel(frame: &Frame, x: &Axis, y: Option<&Axis>) -> String {
    let scale = |axis: &Axis, (lo, hi): (f64, f64)| {
        let word = match axis.scale {
            Scale::Linear => "linear".into(),
            Scale::Log => "log".into(),
            Scale::Symmetric(power) => format!("symmetric:{power}"),
        };
        format!("{word} {} {}", csv::number(lo), csv::number(hi))
    };
    let words = |name: char, axis: &Axis| {
        let (label, unit) = (escape(&axis.label), escape(&axis.unit));
        format!(" data-{name}-name=\"{label}\" data-{name}-unit=\"{unit}\"")
    };
    let Frame { left, right, top, bottom, .. } = frame;
    format!(
        "<g class=\"panel\" data-frame=\"{left:.1} {right:.1} {top:.1} {bottom:.1}\" \
         data-x=\"{}\" data-y=\"{}\"{}{}>\n",
        scale(x, frame.x),
        y.map_or("linear 0 1".into(), |y| scale(y, frame.y)),
        words('x', x),
        y.map_or(String::new(), |y| words('y', y))
    )
}

/// A point of a curve, and its position in px if it can be shown.
pub(super) type Placed = ((f64, f64), Option<(f64, f64)>);

/// The points of a curve: all points of a short curve; for a long one the first point in each of
/// several intervals across, and the lowest and the highest point of all.
pub(super) fn listed(points: &[Placed]) -> String {
    let placed: Vec<_> =
        points.iter().filter_map(|(point, at)| at.map(|at| (*point, at))).collect();
    let by_height = |a: &&usize, b: &&usize| placed[**a].1.1.total_cmp(&placed[**b].1.1);
    let indices: Vec<usize> = (0..placed.len()).collect();
    let mut kept: Vec<usize> = match placed.len() {
        0..=ALL => indices.clone(),
        _ => {
            let stretch = |i: &usize| (placed[*i].1.0 / APART).floor();
            indices.chunk_by(|a, b| stretch(a) == stretch(b)).map(|group| group[0]).collect()
        }
    };
    kept.extend(
        indices.iter().min_by(by_height).into_iter().chain(indices.iter().max_by(by_height)),
    );
    kept.sort_unstable();
    kept.dedup();
    let pair = |i: usize| {
        let (x, y) = placed[i].0;
        format!("{} {}", rounded(x, DIGITS.0), rounded(y, DIGITS.1))
    };
    kept.into_iter().map(pair).collect::<Vec<_>>().join(" ")
}

/// The value with this number of significant digits, as short as possible.
fn rounded(value: f64, digits: usize) -> String {
    let near = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    csv::number(if f64::is_finite(near) { near } else { value })
}
