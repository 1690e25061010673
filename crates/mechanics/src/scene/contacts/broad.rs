//! Broad phase: pairs of convex parts that may touch because their axis-aligned bounding boxes
//! overlap.
//!
//! A few boxes are compared pairwise. More are put into a tree (parry's bounding volume hierarchy),
//! so that n bodies with few neighbors each cost n log n. The tree is rebuilt each time, in reused
//! memory, so the result depends only on the current poses. A half space may touch every body that
//! is not wholly above it.

use nalgebra::Vector3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::glamx::DVec3;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhWorkspace};

use super::solid::Solid;

/// A bound on rounding, relative to the coordinates.
const ROUNDING: f64 = 1e-12;

/// For more boxes than this, a tree costs less than comparing all pairs.
const FEW: usize = 32;

/// A half space in world coordinates.
pub(super) struct HalfSpace {
    /// Its index among the solids.
    pub solid: usize,
    /// The unit normal (world), pointing out of the half space.
    pub normal: Vector3<f64>,
    /// A point on its surface (m).
    pub point: Vector3<f64>,
}

/// The boxes, their tree, and the pairs found last.
#[derive(Default)]
pub(super) struct Broad {
    /// The boxes with the indices of their solids.
    boxes: Vec<(usize, Aabb)>,
    tree: Bvh,
    workspace: BvhWorkspace,
    pairs: Vec<[usize; 2]>,
}

impl Broad {
    /// The pairs [lower, higher], ascending, of those that `may` touch and come within their
    /// `margin` (m). The sum of the `half` margins (m) of two solids must be at least the margin of
    /// the pair.
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

    /// The pairs found last.
    pub fn pairs(&self) -> &[[usize; 2]] {
        &self.pairs
    }
}

impl HalfSpace {
    /// Whether a box comes within a distance (m) of the half space.
    fn reaches(&self, around: &Aabb, distance: f64) -> bool {
        let vector = |v: DVec3| Vector3::new(v.x, v.y, v.z);
        let (center, half) = (vector(around.center()), vector(around.half_extents()));
        let height = self.normal.dot(&(center - self.point)) - self.normal.abs().dot(&half);
        height <= distance + ROUNDING * self.point.amax()
    }
}

/// The bounding box of a solid, enlarged on every side by its radius, `more` (m), and a bound on
/// rounding.
fn bounds(solid: &Solid, more: f64) -> Aabb {
    let first = solid.vertices[0];
    let low = solid.vertices.iter().fold(first, |low, v| low.inf(v));
    let high = solid.vertices.iter().fold(first, |high, v| high.sup(v));
    let wider = solid.radius + more + ROUNDING * (low.amax() + high.amax());
    let corner = |v: Vector3<f64>| DVec3::new(v.x, v.y, v.z);
    Aabb::new(corner(low.add_scalar(-wider)), corner(high.add_scalar(wider)))
}
