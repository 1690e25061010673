//! How far two polytopes are apart along the axes that can separate them: the normals of the faces
//! of either, and the common normals of an edge of each.
//!
//! The separation along n is min over b of n·x − max over a of n·x. Overlapping polytopes are
//! nearest to parting along the axis where it is largest, and none is above 0; polytopes that are
//! apart have it equal to their distance, unless a vertex is nearest to an edge or a vertex.

use nalgebra::Vector3;

use super::solid::Solid;

/// Edges at a smaller angle than this (as a sine) count as parallel: they have no common normal.
pub(super) const PARALLEL: f64 = 1e-3;

/// A face of body 0 as an axis.
#[derive(Clone, Copy)]
pub(super) struct FaceAxis {
    pub face: usize,
    /// (m)
    pub separation: f64,
}

/// The common normal of an edge of each body as an axis.
#[derive(Clone, Copy)]
pub(super) struct EdgeAxis {
    pub edges: [usize; 2],
    /// The unit normal, from body 0 to body 1.
    pub n: Vector3<f64>,
    /// (m)
    pub separation: f64,
}

/// The face of `a` over which `b` lies highest.
pub(super) fn by_faces(a: &Solid, b: &Solid) -> Option<FaceAxis> {
    let mut best: Option<FaceAxis> = None;
    for face in 0..a.normals.len() {
        let highest = best.map_or(f64::NEG_INFINITY, |axis| axis.separation);
        let mut separation = f64::INFINITY;
        for vertex in &b.vertices {
            separation = separation.min(a.height(face, vertex));
            if separation <= highest {
                break; // another face parts them better
            }
        }
        if separation > highest {
            best = Some(FaceAxis { face, separation });
        }
    }
    best
}

/// The edges that part `a` and `b` best, each of which reaches farthest along the normal. Parallel
/// edges have one normal with another edge, and only the farthest of them can reach farthest of
/// all.
pub(super) fn by_edges(a: &Solid, b: &Solid) -> Option<EdgeAxis> {
    let mut best: Option<EdgeAxis> = None;
    for of_a in a.parallels() {
        for of_b in b.parallels() {
            let [e0, e1] = [a.directions[of_a[0]], b.directions[of_b[0]]];
            let Some(across) = e0.cross(&e1).try_normalize(PARALLEL) else { continue };
            for n in [across, -across] {
                let [(i, top), (j, bottom)] = [a.farthest(of_a, &n), b.farthest(of_b, &-n)];
                let separation = -bottom - top;
                let is_better = best.is_none_or(|axis| separation > axis.separation);
                // Last, since it takes longest and few axes are better than the best so far.
                if is_better && a.edge_faces(i, &n) && b.edge_faces(j, &-n) {
                    best = Some(EdgeAxis { edges: [i, j], n, separation });
                }
            }
        }
    }
    best
}
