//! The separation of two polytopes along the candidate axes: the face normals of either, and the
//! common normals of an edge of each.
//!
//! The separation along n is min over b of n·x − max over a of n·x. Overlapping polytopes separate
//! most easily along the axis with the largest separation, which is at most 0. For disjoint
//! polytopes it equals the distance, unless a vertex is nearest to an edge or a vertex.

use nalgebra::Vector3;

use super::solid::Solid;

/// Edges at a smaller angle than this (as a sine) count as parallel and have no common normal.
pub(super) const PARALLEL: f64 = 1e-3;

/// A face of body 0 as an axis.
#[derive(Clone, Copy)]
pub(super) struct FaceAxis {
    pub face: usize,
    /// The separation (m).
    pub separation: f64,
}

/// The common normal of an edge of each body as an axis.
#[derive(Clone, Copy)]
pub(super) struct EdgeAxis {
    pub edges: [usize; 2],
    /// The unit normal, from body 0 to body 1.
    pub n: Vector3<f64>,
    /// The separation (m).
    pub separation: f64,
}

/// The face of `a` with the largest separation from `b`.
pub(super) fn by_faces(a: &Solid, b: &Solid) -> Option<FaceAxis> {
    let mut best: Option<FaceAxis> = None;
    for face in 0..a.normals.len() {
        let highest = best.map_or(f64::NEG_INFINITY, |axis| axis.separation);
        let mut separation = f64::INFINITY;
        for vertex in &b.vertices {
            separation = separation.min(a.height(face, vertex));
            if separation <= highest {
                // Another face separates them better.
                break;
            }
        }
        if separation > highest {
            best = Some(FaceAxis { face, separation });
        }
    }
    best
}

/// The edges of `a` and `b` with the largest separation, each of which reaches farthest along the
/// normal. Parallel edges have the same common normal with another edge, so only the farthest of
/// them is tested.
pub(super) fn by_edges(a: &Solid, b: &Solid) -> Option<EdgeAxis> {
    let mut best: Option<EdgeAxis> = None;
    for of_a in a.parallels() {
        for of_b in b.parallels() {
            let [e0, e1] = [a.directions[of_a[0]], b.directions[of_b[0]]];
            let Some(across) = e0.cross(&e1).try_normalize(PARALLEL) else { continue };
            let [low_a, high_a] = a.extremes(of_a, &across);
            let [low_b, high_b] = b.extremes(of_b, &across);
            for (n, [i, j], separation) in [
                (across, [high_a.0, low_b.0], low_b.1 - high_a.1),
                (-across, [low_a.0, high_b.0], low_a.1 - high_b.1),
            ] {
                let is_better = best.is_none_or(|axis| separation > axis.separation);
                // Last, since it is the most expensive test and few axes are better than the best
                // so far.
                if is_better && a.edge_faces(i, &n) && b.edge_faces(j, &-n) {
                    best = Some(EdgeAxis { edges: [i, j], n, separation });
                }
            }
        }
    }
    best
}
