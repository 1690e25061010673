//! Two crossing edges: the normal is perpendicular to both and rotates with both bodies.

use nalgebra::Vector3;

use super::separation::EdgeAxis;
use super::solid::Solid;
use super::{Feature, Touch};
use crate::constraint::Normal;

/// The contact of two edges along their common normal, and whether both edges contain the points
/// where their lines are closest.
pub(super) fn touch(a: &Solid, b: &Solid, axis: &EdgeAxis) -> (Touch, bool) {
    let [i, j] = axis.edges;
    let (e0, e1) = (a.directions[i], b.directions[j]);
    let [along0, along1] = nearest(a.ends(i)[0], e0, b.ends(j)[0], e1);
    let within = (0.0..=a.lengths[i]).contains(&along0) && (0.0..=b.lengths[j]).contains(&along1);
    let sign = 1.0f64.copysign(e0.cross(&e1).dot(&axis.n));
    let touch = Touch {
        features: [Feature::Edge(i), Feature::Edge(j)],
        anchors: [a.ends(i)[0] + e0 * along0, b.ends(j)[0] + e1 * along1],
        normal: Normal::Edges([a.local(&e0) * sign, b.local(&e1)]),
        separation: axis.separation,
        swapped: false,
    };
    (touch, within)
}

/// The parameters (m) of the closest points of two lines p + s e, with unit vectors e.
fn nearest(p0: Vector3<f64>, e0: Vector3<f64>, p1: Vector3<f64>, e1: Vector3<f64>) -> [f64; 2] {
    let (m, d) = (e0.cross(&e1), p1 - p0);
    [d.cross(&e1).dot(&m), d.cross(&e0).dot(&m)].map(|s| s / m.norm_squared())
}
