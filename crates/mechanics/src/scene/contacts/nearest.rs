//! Separated polytopes whose nearest features include an edge or a vertex: the vertices of each,
//! with the nearest feature of the other.
//!
//! Each such contact keeps a vertex from passing the nearest face, edge or vertex. Each is valid
//! independently, so any number of them can be used.

use nalgebra::Vector3;

use super::solid::Solid;
use super::{Feature, Touch};
use crate::constraint::Normal;

/// A vertex counts if none of its edges leads towards the other body more steeply than this (as a
/// sine): for parallel capsules both ends count.
const LEVEL: f64 = 0.1;

/// Adds the vertices of `a` and of `b` that come within `reach` (m) of the other.
pub(super) fn touches(a: &Solid, b: &Solid, reach: f64, out: &mut Vec<Touch>) {
    let first = out.len();
    out.extend(vertices_of_second(a, b, reach));
    for touch in vertices_of_second(b, a, reach) {
        let touch = touch.swap();
        if out[first..].iter().all(|known| known.names() != touch.names()) {
            out.push(touch);
        }
    }
}

fn vertices_of_second(a: &Solid, b: &Solid, reach: f64) -> impl Iterator<Item = Touch> {
    let vertices = b.vertices.iter().enumerate();
    vertices.filter_map(move |(k, vertex)| {
        let touch = nearest_feature(a, k, vertex);
        let counts = match (touch.anchors[0] - vertex).try_normalize(0.0) {
            Some(towards) => touch.separation <= reach && b.vertex_faces(k, &towards, LEVEL),
            // Two balls with the same center.
            None => a.vertices.len() == 1 && b.vertices.len() == 1,
        };
        counts.then_some(touch)
    })
}

/// The feature of `a` nearest to vertex k of the other body, which is outside.
fn nearest_feature(a: &Solid, k: usize, vertex: &Vector3<f64>) -> Touch {
    let touch = |feature: Feature, foot: Vector3<f64>, normal: Normal| Touch {
        features: [feature, Feature::Vertex(k)],
        anchors: [foot, *vertex],
        normal,
        separation: (vertex - foot).norm(),
        swapped: false,
    };
    let faces = (0..a.normals.len()).filter_map(|face| {
        let height = a.height(face, vertex);
        let over = height >= 0.0 && a.covers(face, vertex, 0.0);
        let foot = vertex - a.normals[face] * height;
        over.then(|| touch(Feature::Face(face), foot, Normal::Face(a.local_normal(face))))
    });
    let edges = (0..a.directions.len()).filter_map(|edge| {
        let ([from, _], e) = (a.ends(edge), a.directions[edge]);
        let along = e.dot(&(vertex - from));
        let beside = along > 0.0 && along < a.lengths[edge];
        beside.then(|| touch(Feature::Edge(edge), from + e * along, Normal::Edge(a.local(&e))))
    });
    let first = touch(Feature::Vertex(0), a.vertices[0], Normal::Centers);
    let corners = a.vertices.iter().enumerate().skip(1);
    let corners = corners.map(|(i, v)| touch(Feature::Vertex(i), *v, Normal::Centers));
    let nearer = |best: Touch, touch: Touch| {
        if touch.separation < best.separation { touch } else { best }
    };
    faces.chain(edges).chain(corners).fold(first, nearer)
}
