//! Contacts of a half space, body 0, with the vertices of any solid.

use nalgebra::Vector3;

use super::solid::Solid;
use super::{Feature, Touch, rim};
use crate::body::Pose;
use crate::constraint::Normal;

/// Adds every vertex of a solid over the plane through the origin of a body with this pose;
/// `normal` is in the body's axes.
pub(super) fn touches(normal: &Vector3<f64>, pose: &Pose, solid: &Solid, out: &mut Vec<Touch>) {
    let n = pose.direction(normal);
    if rim::on_plane(normal, pose, solid, out) {
        return;
    }
    let vertices = solid.vertices.iter().enumerate();
    let touch = |(k, vertex): (usize, &Vector3<f64>)| Touch {
        features: [Feature::Face(0), Feature::Vertex(k)],
        anchors: [pose.p, *vertex],
        normal: Normal::Face(*normal),
        separation: n.dot(&(vertex - pose.p)),
        swapped: false,
    };
    out.extend(vertices.map(touch));
}
