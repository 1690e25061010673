//! A face of body 0 with the opposing feature of body 1: a face, an edge or a vertex.
//!
//! Projected along the face's normal, two convex polygons overlap in a polygon whose corners are of
//! three kinds, each with the normal of its features:
//!
//! ```text
//! a vertex of body 1 over the face           face of body 0
//! a vertex of the face over one of body 1    face of body 1
//! an edge of each, crossing                  across both edges
//! ```

use nalgebra::Vector3;

use super::separation::{EdgeAxis, PARALLEL};
use super::solid::Solid;
use super::{Feature, Touch, crossing};
use crate::constraint::Normal;

/// A vertex outside a face by up to this fraction of the bodies' size still counts as over it:
/// equal boxes with flush sides would otherwise lose corners by rounding.
const RIM: f64 = 1e-6;
/// Crossing edges use the normal perpendicular to both if its cosine with the face's normal is at
/// least this; for nearly parallel edges that normal is ill-defined.
const ALIGNED: f64 = 0.996;
/// The second face must oppose the first within 60°.
const FACING: f64 = -0.5;

/// Adds the corners of the overlap of a face of `a` with the opposing feature of `b`: a face or, if
/// there is none, all its vertices and edges.
pub(super) fn touches(a: &Solid, b: &Solid, face: usize, out: &mut Vec<Touch>) {
    let rim = RIM * a.size.max(b.size);
    let Some(other) = towards(b, &a.normals[face]) else {
        out.extend((0..b.vertices.len()).filter_map(|k| over(a, b, face, k, rim)));
        crossings(a, b, face, 0..b.directions.len(), rim, out);
        return;
    };
    out.extend(b.corners(other).iter().filter_map(|&k| over(a, b, face, k, rim)));
    if b.normals[other].dot(&a.normals[face]) < FACING {
        corners(a, b, [face, other], rim, out);
    }
    crossings(a, b, face, b.rim(other).iter().copied(), rim, out);
}

/// Of the faces at the lowest vertex along n, the one whose normal is most opposed to n.
fn towards(b: &Solid, n: &Vector3<f64>) -> Option<usize> {
    let lower = |best: usize, k: usize| {
        if n.dot(&b.vertices[k]) < n.dot(&b.vertices[best]) { k } else { best }
    };
    let lowest = (0..b.vertices.len()).fold(0, lower);
    let at_it = (0..b.normals.len()).filter(|&f| b.corners(f).contains(&lowest));
    at_it.min_by(|&f, &g| b.normals[f].dot(n).total_cmp(&b.normals[g].dot(n)))
}

/// Vertex k of `b` if it is over the face of `a`.
fn over(a: &Solid, b: &Solid, face: usize, k: usize, rim: f64) -> Option<Touch> {
    let (n, vertex) = (a.normals[face], b.vertices[k]);
    let touch = || {
        let separation = a.height(face, &vertex);
        Touch {
            features: [Feature::Face(face), Feature::Vertex(k)],
            anchors: [vertex - n * separation, vertex],
            normal: Normal::Face(a.local_normal(face)),
            separation,
            swapped: false,
        }
    };
    a.covers(face, &vertex, rim).then(touch)
}

/// The corners of the face of `a` over the face of `b`, except where `b` has a corner.
fn corners(a: &Solid, b: &Solid, [face, other]: [usize; 2], rim: f64, out: &mut Vec<Touch>) {
    let n = a.normals[face];
    let is_beside = |k: usize, vertex: &Vector3<f64>| {
        let d = b.vertices[k] - vertex;
        (d - n * n.dot(&d)).norm() > 2.0 * rim
    };
    let is_alone =
        |touch: &Touch| b.corners(other).iter().all(|&k| is_beside(k, &touch.anchors[1]));
    let corners = a.corners(face).iter().filter_map(|&k| over(b, a, other, k, rim));
    out.extend(corners.filter(is_alone).map(Touch::swap));
}

/// The crossings of the boundary of the face of `a` with edges of `b`.
fn crossings(
    a: &Solid,
    b: &Solid,
    face: usize,
    edges: impl Iterator<Item = usize> + Clone,
    rim: f64,
    out: &mut Vec<Touch>,
) {
    for &i in a.rim(face) {
        out.extend(edges.clone().filter_map(|j| cross(a, b, face, [i, j], rim)));
    }
}

/// The crossing of edge i of the face of `a` and edge j of `b`, away from their ends.
fn cross(a: &Solid, b: &Solid, face: usize, [i, j]: [usize; 2], rim: f64) -> Option<Touch> {
    let (n, e0, e1) = (a.normals[face], a.directions[i], b.directions[j]);
    let (p0, p1) = (a.ends(i)[0], b.ends(j)[0]);
    let (across, d) = (e0.cross(&e1), p1 - p0);
    let turn = n.dot(&across);
    if turn.abs() < PARALLEL {
        return None;
    }
    let [s, t] = [d.cross(&e1), d.cross(&e0)].map(|moment| n.dot(&moment) / turn);
    let within = |s: f64, length: f64| s > rim && s < length - rim;
    if !within(s, a.lengths[i]) || !within(t, b.lengths[j]) {
        return None;
    }
    let normal = across.normalize() * turn.signum();
    let sharp = a.edge_faces(i, &normal) && b.edge_faces(j, &-normal);
    if sharp && normal.dot(&n) > ALIGNED {
        let axis = EdgeAxis { edges: [i, j], n: normal, separation: normal.dot(&d) };
        let (touch, within) = crossing::touch(a, b, &axis);
        if within {
            return Some(touch);
        }
    }
    let point = p1 + e1 * t;
    let separation = a.height(face, &point);
    Some(Touch {
        features: [Feature::Edge(i), Feature::Edge(j)],
        anchors: [point - n * separation, point],
        normal: Normal::Face(a.local_normal(face)),
        separation,
        swapped: false,
    })
}
