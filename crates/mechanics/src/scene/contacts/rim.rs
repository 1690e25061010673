//! A cylinder with its side on a flat surface: the contacts are the ends of the contact line.
//!
//! Each end is the lowest point of a circle around the axis, so the cylinder rolls smoothly. If it
//! stands on an end or lies beyond the boundary of a face, the approximating prism is used instead.

use nalgebra::Vector3;

use super::solid::Solid;
use super::{Feature, Touch};
use crate::body::{Cylinder, Pose};
use crate::constraint::{Normal, Rim};

/// A cylinder whose axis is this close to the normal (as a sine) stands on an end.
const STANDS: f64 = 0.02;

/// A flat surface: its unit normal in its body's axes and in world axes, and a point on it (m,
/// world).
struct Flat {
    feature: usize,
    local: Vector3<f64>,
    n: Vector3<f64>,
    point: Vector3<f64>,
}

/// Adds the contacts of a cylinder with the plane through the origin of a body with this pose;
/// false if the solid is not a cylinder or stands on an end.
pub(super) fn on_plane(
    normal: &Vector3<f64>,
    pose: &Pose,
    solid: &Solid,
    out: &mut Vec<Touch>,
) -> bool {
    let Some((cylinder, ends)) = solid.cylinder() else { return false };
    let flat = Flat { feature: 0, local: *normal, n: pose.direction(normal), point: pose.p };
    let Some(_) = lowest(&cylinder, &flat.n) else { return false };
    let half = cylinder.half_length;
    for (along, face) in [-half, half].into_iter().zip(ends) {
        out.extend(touch(&flat, solid, &cylinder, along, face));
    }
    true
}

/// The same for a face; also false if no part of the line is over the face.
pub(super) fn on_face(flat: &Solid, face: usize, solid: &Solid, out: &mut Vec<Touch>) -> bool {
    let Some((cylinder, ends)) = solid.cylinder() else { return false };
    let n = flat.normals[face];
    let Some(down) = lowest(&cylinder, &n) else { return false };
    let line = cylinder.center + down;
    let (mut low, mut high) = (-cylinder.half_length, cylinder.half_length);
    for [from, inward] in flat.sides(face) {
        let (inside, rate) = (inward.dot(&(line - from)), inward.dot(&cylinder.axis));
        match rate {
            rate if rate > PARALLEL => low = low.max(-inside / rate),
            rate if rate < -PARALLEL => high = high.min(-inside / rate),
            _ if inside < 0.0 => return false,
            _ => {}
        }
    }
    if low > high {
        return false;
    }
    let point = flat.vertices[flat.corners(face)[0]];
    let flat = Flat { feature: face, local: flat.local_normal(face), n, point };
    for (along, end) in [low, high].into_iter().zip(ends) {
        out.extend(touch(&flat, solid, &cylinder, along, end));
    }
    true
}

/// A line counts as parallel to a side of a face below this sine.
const PARALLEL: f64 = 1e-9;

/// The vector from the axis to the lowest line of the side along n; `None` if the cylinder stands
/// on an end.
fn lowest(cylinder: &Cylinder, n: &Vector3<f64>) -> Option<Vector3<f64>> {
    let across = n - cylinder.axis * cylinder.axis.dot(n);
    (across.norm() > STANDS).then(|| across.normalize() * -cylinder.radius)
}

/// The contact of the circle at this distance (m) along the axis, named after a face of the
/// cylinder.
fn touch(
    flat: &Flat,
    solid: &Solid,
    cylinder: &Cylinder,
    along: f64,
    face: usize,
) -> Option<Touch> {
    let center = cylinder.center + cylinder.axis * along;
    let point = center + lowest(cylinder, &flat.n)?;
    let separation = flat.n.dot(&(point - flat.point));
    let axis = solid.local(&cylinder.axis);
    Some(Touch {
        features: [Feature::Face(flat.feature), Feature::Face(face)],
        anchors: [point - flat.n * separation, center],
        normal: Normal::Rim(Rim { normal: flat.local, axis, radius: cylinder.radius }),
        separation,
        swapped: false,
    })
}
