//! The pairs of convex parts that may touch: those whose boxes along the world's axes meet.
//!
//! Of a few boxes each is compared with each. Many lie in a tree (parry's bounding volume
//! hierarchy), so that n bodies with few neighbours each cost n log n; it is built anew each time,
//! in memory that is kept, so which pairs are found depends on where the bodies are and on nothing
//! before. A half space may touch every body that is not wholly above it.

use nalgebra::Vector3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::glamx::DVec3;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode, BvhWorkspace};

use super::solid::Solid;

/// Rounding, as a part of the coordinates.
const ROUNDING: f64 = 1e-12;

/// A tree of more boxes than this costs less than to compare each with each.
const FEW: usize = 32;

/// A half space in its place.
pub(super) struct HalfSpace {
    /// Its place among the solids.
    pub solid: usize,
    /// The unit normal (world), out of the matter.
    pub normal: Vector3<f64>,
    /// A point of its surface (m).
    pub point: Vector3<f64>,
}

/// The boxes, their tree, and the pairs that were found last.
#[derive(Default)]
pub(super) struct Broad {
    /// With the places of their solids.
    boxes: Vec<(usize, Aabb)>,
    tree: Bvh,
    workspace: BvhWorkspace,
    pairs: Vec<[usize; 2]>,
}

impl Broad {
    /// The pairs [lower, higher] of those that `may` touch and come within their `margin` (m),
    /// ascending. The `half` margins (m) of two solids are together no less than the margin of
    /// both.
    pub fn search(
        &mut self,
        solids: &[Option<Solid>],
        half_spaces: &[HalfSpace],
        half: impl Fn(usize) -> f64,
        margin: impl Fn([usize; 2]) -> f64,
        may: impl Fn([usize; 2]) -> bool,
    ) {
        let Broad { boxes, tree, workspace, pairs } = self;
        boxes.clear();
        pairs.clear();
        let mut add = |a: usize, b: usize| {
            let pair = [a.min(b), a.max(b)];
            if may(pair) {
                pairs.push(pair);
            }
        };
        for (k, solid) in solids.iter().enumerate() {
            let Some(solid) = solid else { continue };
            let own = half(k);
            let around = bounds(solid, own);
            boxes.push((k, around));
            for plane in half_spaces {
                if plane.reaches(&around, margin([plane.solid, k]) - own) {
                    add(plane.solid, k);
                }
            }
        }
        if boxes.len() <= FEW {
            for (k, (a, around)) in boxes.iter().enumerate() {
                let near = boxes[k + 1..].iter().filter(|(_, other)| around.intersects(other));
                near.for_each(|(b, _)| add(*a, *b));
            }
        } else {
            for (k, around) in &*boxes {
                tree.insert_or_update_partially(*around, *k as u32, 0.0);
            }
            tree.rebuild(workspace, BvhBuildStrategy::Binned);
            let found = &mut |a: u32, b: u32| add(a as usize, b as usize);
            tree.traverse_bvtt_single_tree::<false>(workspace, found);
        }
        pairs.sort_unstable();
    }

    /// The bytes that its arrays hold; those of the workspace are as many boxes as the tree has.
    pub fn bytes(&self) -> usize {
        let leaves = self.tree.leaf_count() as usize * size_of::<BvhNode>();
        let boxes = self.boxes.capacity() * size_of::<(usize, Aabb)>();
        let pairs = self.pairs.capacity() * size_of::<[usize; 2]>();
        self.tree.heap_memory_size() + leaves + boxes + pairs
    }

    /// The pairs that were found last.
    pub fn pairs(&self) -> &[[usize; 2]] {
        &self.pairs
    }
}

impl HalfSpace {
    /// Whether a box comes within a distance (m) of the matter.
    fn reaches(&self, around: &Aabb, distance: f64) -> bool {
        let vector = |v: DVec3| Vector3::new(v.x, v.y, v.z);
        let (centre, half) = (vector(around.center()), vector(around.half_extents()));
        let height = self.normal.dot(&(centre - self.point)) - self.normal.abs().dot(&half);
        height <= distance + ROUNDING * self.point.amax()
    }
}

/// The box around a solid, larger by its radius and `more` (m) on every side, and by rounding.
fn bounds(solid: &Solid, more: f64) -> Aabb {
    let first = solid.vertices[0];
    let low = solid.vertices.iter().fold(first, |low, v| low.inf(v));
    let high = solid.vertices.iter().fold(first, |high, v| high.sup(v));
    let wider = solid.radius + more + ROUNDING * (low.amax() + high.amax());
    let corner = |v: Vector3<f64>| DVec3::new(v.x, v.y, v.z);
    Aabb::new(corner(low.add_scalar(-wider)), corner(high.add_scalar(wider)))
}
