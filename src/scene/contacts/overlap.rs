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

/// What a body turns towards a face.
struct Incident {
    face: Option<usize>,
    corners: Vec<usize>,
    edges: Vec<usize>,
}

/// The corners of the overlap of a face of `a` and what `b` turns towards it.
pub(super) fn touches(a: &Solid, b: &Solid, face: usize) -> Vec<Touch> {
    let rim = RIM * a.size().max(b.size());
    let incident = towards(b, &a.normals[face]);
    let mut touches = vertices(a, b, face, &incident.corners, rim);
    if let Some(other) = incident.face.filter(|&f| b.normals[f].dot(&a.normals[face]) < FACING) {
        touches.extend(corners(a, b, [face, other], rim));
    }
    for &i in a.rim(face) {
        touches.extend(incident.edges.iter().filter_map(|&j| cross(a, b, face, [i, j], rim)));
    }
    touches
}

/// Of the faces at the vertex that lies lowest along n, the one that looks most against n; an edge
/// or a vertex where there are no faces.
fn towards(b: &Solid, n: &Vector3<f64>) -> Incident {
    let lower = |best: usize, k: usize| {
        if n.dot(&b.vertices[k]) < n.dot(&b.vertices[best]) { k } else { best }
    };
    let lowest = (0..b.vertices.len()).fold(0, lower);
    let at_it = (0..b.normals.len()).filter(|&f| b.corners(f).contains(&lowest));
    let face = at_it.min_by(|&f, &g| b.normals[f].dot(n).total_cmp(&b.normals[g].dot(n)));
    match face {
        Some(f) => Incident { face, corners: b.corners(f).to_vec(), edges: b.rim(f).to_vec() },
        None => Incident {
            face,
            corners: (0..b.vertices.len()).collect(),
            edges: (0..b.directions.len()).collect(),
        },
    }
}

/// The vertices of `b` over the face of `a`.
fn vertices(a: &Solid, b: &Solid, face: usize, corners: &[usize], rim: f64) -> Vec<Touch> {
    let n = a.normals[face];
    let over = corners.iter().filter(|&&k| a.covers(face, &n, &b.vertices[k], rim));
    let touch = |&k: &usize| {
        let separation = a.height(face, &b.vertices[k]);
        Touch {
            features: [Feature::Face(face), Feature::Vertex(k)],
            anchors: [b.vertices[k] - n * separation, b.vertices[k]],
            normal: Normal::Face(a.local_normal(face)),
            separation,
            swapped: false,
        }
    };
    over.map(touch).collect()
}

/// The corners of the face of `a` over the face of `b`, but for those where a corner of `b` is.
fn corners(a: &Solid, b: &Solid, [face, other]: [usize; 2], rim: f64) -> Vec<Touch> {
    let (n, m) = (a.normals[face], b.normals[other]);
    let beside = |k: usize, vertex: &Vector3<f64>| {
        let d = b.vertices[k] - vertex;
        (d - n * n.dot(&d)).norm() > 2.0 * rim
    };
    let over = |k: &usize| {
        let vertex = &a.vertices[*k];
        b.covers(other, &m, vertex, rim) && b.corners(other).iter().all(|&k| beside(k, vertex))
    };
    let touch = |&k: &usize| {
        let vertex = a.vertices[k];
        let separation = b.height(other, &vertex);
        Touch {
            features: [Feature::Face(other), Feature::Vertex(k)],
            anchors: [vertex - m * separation, vertex],
            normal: Normal::Face(b.local_normal(other)),
            separation,
            swapped: true,
        }
    };
    a.corners(face).iter().filter(|k| over(k)).map(touch).collect()
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
