//! The pairs of bodies that may touch: those whose boxes along the world's axes meet.
//!
//! The boxes lie in a tree (parry's bounding volume hierarchy), so that n bodies with few
//! neighbours each cost n log n. A half space may touch everything.

use nalgebra::Vector3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::glamx::DVec3;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::solid::Solid;

/// The pairs [lower, higher] that may come within `margin` (m), ascending; bodies without a solid
/// are half spaces.
pub(super) fn pairs(solids: &[Option<Solid>], margin: f64) -> Vec<[usize; 2]> {
    let (bodies, planes): (Vec<usize>, Vec<usize>) =
        (0..solids.len()).partition(|&k| solids[k].is_some());
    let boxes: Vec<Aabb> =
        solids.iter().flatten().map(|solid| bounds(solid, margin / 2.0)).collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    let mut pairs = Vec::new();
    for (bounds, &body) in boxes.iter().zip(&bodies) {
        let others = tree.intersect_aabb(bounds).map(|leaf| bodies[leaf as usize]);
        pairs.extend(others.filter(|&other| body < other).map(|other| [body, other]));
    }
    for plane in planes {
        pairs.extend(bodies.iter().map(|&body| [plane.min(body), plane.max(body)]));
    }
    pairs.sort_unstable();
    pairs
}

/// The box around a solid, larger by its radius and `more` (m) on every side, and by rounding.
fn bounds(solid: &Solid, more: f64) -> Aabb {
    let first = solid.vertices[0];
    let low = solid.vertices.iter().fold(first, |low, v| low.inf(v));
    let high = solid.vertices.iter().fold(first, |high, v| high.sup(v));
    let wider = solid.radius + more + 1e-12 * (low.amax() + high.amax());
    let corner = |v: Vector3<f64>| DVec3::new(v.x, v.y, v.z);
    Aabb::new(corner(low.add_scalar(-wider)), corner(high.add_scalar(wider)))
}
