//! Selects the touching features of two solids. A cylinder is treated as round if its side lies on
//! a face.

use super::separation::{EdgeAxis, FaceAxis, by_edges, by_faces};
use super::solid::Solid;
use super::{Feature, Touch, crossing, nearest, overlap, rim};
use crate::constraint::Normal;

/// A face is preferred although edges, or a face of the other body, separate the bodies better by
/// up to this fraction of their size: a body that rocks by a rounding error must not lose three of
/// four points.
const PREFERENCE: f64 = 1e-2;
/// Separations that differ by less than this fraction of the bodies' size are equal.
const EQUAL: f64 = 1e-9;

/// Contacts with a gap up to `margin` (m), and possibly some with a larger one, into an empty list.
pub(super) fn touches(a: &Solid, b: &Solid, margin: f64, out: &mut Vec<Touch>) {
    let reach = margin + a.radius + b.radius;
    let faces = [by_faces(a, b), by_faces(b, a)];
    let by_face = faces.iter().flatten().map(|axis| axis.separation).fold(f64::MIN, f64::max);
    if by_face > reach {
        return;
    }
    let edges = by_edges(a, b);
    let best = edges.map_or(by_face, |axis| by_face.max(axis.separation));
    if best > reach {
        return;
    }
    let equal = EQUAL * a.size.max(b.size);
    let least = best - PREFERENCE * a.size.min(b.size) - equal;
    if rolls(a, b, faces, least, out) {
        return;
    }
    over_face(a, b, faces, least, out);
    // No point is deeper than the shortest way out.
    out.retain(|touch| touch.separation >= least);
    if out.iter().any(|touch| touch.separation <= best + equal) {
        return;
    }
    out.clear();
    let apart = best > equal || best == f64::MIN;
    if apart { near(a, b, edges, reach, out) } else { out.extend(through(a, b, faces, edges)) }
}

/// A cylinder with its side on a face of a non-cylinder, if that face has at least this separation.
fn rolls(
    a: &Solid,
    b: &Solid,
    faces: [Option<FaceAxis>; 2],
    least: f64,
    out: &mut Vec<Touch>,
) -> bool {
    let [of_a, of_b] = faces.map(|axis| axis.filter(|axis| axis.separation >= least));
    match (of_a, of_b, [a, b].map(|solid| solid.cylinder().is_some())) {
        (Some(axis), _, [false, true]) => rim::on_face(a, axis.face, b, out),
        (_, Some(axis), [true, false]) => {
            let found = rim::on_face(b, axis.face, a, out);
            out.iter_mut().for_each(|touch| touch.swapped = !touch.swapped);
            found
        }
        _ => false,
    }
}

/// The overlap with the first face, of `a` and then of `b`, that has at least this separation.
fn over_face(a: &Solid, b: &Solid, faces: [Option<FaceAxis>; 2], least: f64, out: &mut Vec<Touch>) {
    let [of_a, of_b] = faces.map(|axis| axis.filter(|axis| axis.separation >= least));
    match (of_a, of_b) {
        (Some(axis), _) => overlap::touches(a, b, axis.face, out),
        (None, Some(axis)) => {
            overlap::touches(b, a, axis.face, out);
            out.iter_mut().for_each(|touch| touch.swapped = !touch.swapped);
        }
        (None, None) => {}
    }
}

/// Separated bodies: vertices near any feature, and two crossing edges.
fn near(a: &Solid, b: &Solid, edges: Option<EdgeAxis>, reach: f64, out: &mut Vec<Touch>) {
    let crossing = edges.map(|axis| crossing::touch(a, b, &axis));
    out.extend(crossing.filter(|(_, within)| *within).map(|(touch, _)| touch));
    nearest::touches(a, b, reach, out);
}

/// Overlapping bodies whose deepest point is covered by no face: the contact is along the edges'
/// normal, or along the normal of the best separating face.
fn through(
    a: &Solid,
    b: &Solid,
    [of_a, of_b]: [Option<FaceAxis>; 2],
    edges: Option<EdgeAxis>,
) -> Option<Touch> {
    let separation = |axis: Option<FaceAxis>| axis.map_or(f64::MIN, |axis| axis.separation);
    match edges {
        Some(axis) if axis.separation >= separation(of_a).max(separation(of_b)) => {
            Some(crossing::touch(a, b, &axis).0)
        }
        _ if separation(of_a) >= separation(of_b) => of_a.map(|axis| deepest(a, b, axis.face)),
        _ => of_b.map(|axis| deepest(b, a, axis.face).swap()),
    }
}

/// The deepest vertex of `b` below a face of `a`.
fn deepest(a: &Solid, b: &Solid, face: usize) -> Touch {
    let heights = b.vertices.iter().map(|vertex| a.height(face, vertex)).enumerate();
    let (k, separation) =
        heights.fold((0, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best });
    Touch {
        features: [Feature::Face(face), Feature::Vertex(k)],
        anchors: [b.vertices[k] - a.normals[face] * separation, b.vertices[k]],
        normal: Normal::Face(a.local_normal(face)),
        separation,
        swapped: false,
    }
}
