//! Contact points of two boxes, by the library parry.
//!
//! The library clips the two nearest faces against each other and names the features of each point.
//! What is left to do here is to say what the common normal depends on: on a face of either box, or
//! on an edge of each. A clipped point on a face counts as a material point of the other box.

use nalgebra::Vector3;
use parry3d_f64::glamx::{DPose3, DQuat, DVec3};
use parry3d_f64::query::ContactManifold;
use parry3d_f64::query::details::contact_manifold_cuboid_cuboid;
use parry3d_f64::shape::Cuboid;

use super::contacts::Touch;
use crate::body::Pose;
use crate::constraint::Normal;

/// A normal this near to a box's axis (as 1 − cosine) is that axis.
const ALIGNED: f64 = 1e-10;
/// Box 0 is made larger by this part before clipping: equal boxes that stand flush would otherwise
/// lose or double corners as rounding puts them on one side or the other of the face's rim.
const RIM: f64 = 1e-6;

/// The contact points of two boxes with these half edges, with distance up to `margin` (m).
pub(super) fn touches(half: [Vector3<f64>; 2], poses: [Pose; 2], margin: f64) -> Vec<Touch> {
    let grown = half[0] * (1.0 + RIM);
    let [cuboid0, cuboid1] = [grown, half[1]].map(|half| Cuboid::new(to_glam(&half)));
    let [pose0, pose1] = poses.map(|pose| to_pose(&pose));
    let mut manifold = ContactManifold::<(), ()>::new();
    let between = pose0.inverse() * pose1;
    contact_manifold_cuboid_cuboid(&between, &cuboid0, &cuboid1, margin, &mut manifold);
    let (n0, n1) = (Vector3::from(manifold.local_n1), Vector3::from(manifold.local_n2));
    let (swapped, normal) = normal(&n0, &n1, &poses);
    let mut touches: Vec<Touch> = Vec::new();
    for point in manifold.points.iter().filter(|point| point.dist <= margin) {
        let on_box_0 = Vector3::from(point.local_p1).zip_map(&half[0], |x, h| x.clamp(-h, h));
        let [a0, a1] = [on_box_0, Vector3::from(point.local_p2)];
        let names = [point.fid1.0, point.fid2.0];
        // Clipping may name several points of one pair of features alike: count them apart.
        let alike = touches.iter().filter(|touch| touch.feature[..2] == names).count() as u32;
        touches.push(Touch {
            feature: [names[0], names[1], alike],
            swapped,
            anchors: if swapped { [a1, a0] } else { [a0, a1] },
            radii: [0.0; 2],
            normal,
        });
    }
    touches
}

/// What the normal depends on, and whether on a face of box 1 rather than box 0. `n0` points out of
/// box 0 in its frame, `n1` out of box 1 in its own.
fn normal(n0: &Vector3<f64>, n1: &Vector3<f64>, poses: &[Pose; 2]) -> (bool, Normal) {
    if let Some(face) = axis_along(n0) {
        return (false, Normal::Face(face));
    }
    if let Some(face) = axis_along(n1) {
        return (true, Normal::Face(face));
    }
    let n = poses[0].direction(n0);
    let crossing = |(i, j): (usize, usize)| {
        let axes =
            [poses[0].direction(&Vector3::ith(i, 1.0)), poses[1].direction(&Vector3::ith(j, 1.0))];
        axes[0].cross(&axes[1]).try_normalize(1e-9).map_or(0.0, |across| across.dot(&n))
    };
    let pairs = (0..9).map(|k| (k / 3, k % 3));
    let best = pairs.max_by(|&a, &b| crossing(a).abs().total_cmp(&crossing(b).abs()));
    let (i, j) = best.unwrap_or_default();
    let sign = 1.0f64.copysign(crossing((i, j)));
    (false, Normal::Edges([Vector3::ith(i, sign), Vector3::ith(j, 1.0)]))
}

/// The coordinate axis that a unit vector lies along, with its sign, if it lies along one.
fn axis_along(n: &Vector3<f64>) -> Option<Vector3<f64>> {
    let i = n.iamax();
    (1.0 - n[i].abs() <= ALIGNED).then(|| Vector3::ith(i, 1.0f64.copysign(n[i])))
}

fn to_glam(v: &Vector3<f64>) -> DVec3 {
    DVec3::new(v.x, v.y, v.z)
}

fn to_pose(pose: &Pose) -> DPose3 {
    let q = pose.q.coords;
    DPose3::from_parts(to_glam(&pose.p), DQuat::from_xyzw(q.x, q.y, q.z, q.w))
}
