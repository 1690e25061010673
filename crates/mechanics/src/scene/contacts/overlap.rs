//! A face of body 0 against what body 1 turns towards it: a face, an edge or a vertex.
//!
//! Seen along the face's normal, two convex polygons overlap in a polygon whose corners are of
//! three kinds, and each has the normal that its features have:
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

/// A vertex beside a face by up to this part of the bodies' size is over it: equal boxes that stand
/// flush would otherwise lose corners as rounding puts them on one side or the other of the rim.
const RIM: f64 = 1e-6;
/// Edges that cross have the normal across both if it is this near (as a cosine) to the face's; for
/// edges that are nearly parallel it may point anywhere.
const ALIGNED: f64 = 0.996;
/// The second face must look at the first at no more than 60° from straight.
const FACING: f64 = -0.5;

/// Adds the corners of the overlap of a face of `a` and what `b` turns towards it: a face, or,
/// where it has none, all its vertices and edges.
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

/// Of the faces at the vertex that lies lowest along n, the one that looks most against n.
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
    a.covers(face, &n, &vertex, rim).then(touch)
}

/// The corners of the face of `a` over the face of `b`, but for those where a corner of `b` is.
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

/// Where the rim of the face of `a` crosses edges of `b`.
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

/// Where edge i of the face of `a` and edge j of `b` cross, away from their ends.
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
    if !within(s, a.length(i)) || !within(t, b.length(j)) {
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
