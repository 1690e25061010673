//! Random poses compared with the library parry, which uses other methods (GJK, EPA).

use lcplab_mechanics::body::{Body, Pose, Shape, State};
use lcplab_mechanics::scene::contacts;
use nalgebra::Vector3;
use parry3d_f64::glamx::{DPose3, DQuat, DVec3};
use parry3d_f64::query;
use parry3d_f64::shape::{Ball, Capsule, ConvexPolyhedron, Cuboid, Segment, SharedShape};
use proptest::prelude::*;

use super::{SOLIDS, nearest, pair, pose, solids};
use lcplab_testing::cases;

fn glam(v: &Vector3<f64>) -> DVec3 {
    DVec3::new(v.x, v.y, v.z)
}

fn placed(pose: &Pose) -> DPose3 {
    let q = pose.q.coords;
    DPose3::from_parts(glam(&pose.p), DQuat::from_xyzw(q.x, q.y, q.z, q.w))
}

fn shape(shape: &Shape) -> SharedShape {
    match shape {
        Shape::Sphere { radius } => SharedShape::new(Ball::new(*radius)),
        Shape::Box { half } => SharedShape::new(Cuboid::new(glam(half))),
        Shape::Capsule { half_length, radius } => {
            SharedShape::new(Capsule::new_z(*half_length, *radius))
        }
        Shape::Hull(hull) => {
            let points: Vec<DVec3> = hull.vertices.iter().map(glam).collect();
            SharedShape::new(ConvexPolyhedron::from_convex_hull(&points).unwrap())
        }
        Shape::Point | Shape::Plane { .. } | Shape::Compound(_) => {
            unreachable!("not among the solids")
        }
    }
}

/// The distance of the shapes, at most 0 if they overlap; for capsules, that of their axes minus
/// their radii, because the library's own answer for capsules is accurate only to 1e-5.
fn distance(bodies: &[Body], places: &[DPose3; 2]) -> f64 {
    let core = |body: &Body| match body.shape {
        Shape::Capsule { half_length, radius } => {
            let end = DVec3::new(0.0, 0.0, half_length);
            (SharedShape::new(Segment::new(-end, end)), radius)
        }
        _ => (shape(&body.shape), 0.0),
    };
    let [(first, r0), (second, r1)] = [0, 1].map(|k| core(&bodies[k]));
    let apart = query::distance(&places[0], &*first.0, &places[1], &*second.0).unwrap();
    apart.distance - r0 - r1
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn the_smallest_gap_is_the_distance_and_its_points_lie_on_both_surfaces(
        names in solids(), poses in [pose(), pose()],
    ) {
        let scene = pair(names);
        let states = poses.map(|pose| State { pose, ..State::WORLD });
        let shapes = [0, 1].map(|k| shape(&scene.bodies[k].shape));
        let places = poses.map(|pose| placed(&pose));
        let distance = distance(&scene.bodies, &places);
        prop_assume!(distance > 1e-6);
        let found = contacts(&scene, &states, 10.0);
        let near = nearest(&found);
        prop_assert!((near.gap - distance).abs() < 1e-6, "{} {distance}", near.gap);
        let [k0, k1] = near.contact.bodies.map(Option::unwrap);
        for (k, point) in [(k1, near.point), (k0, near.point - near.normal * near.gap)] {
            let beside = shapes[k].project_point(&places[k], glam(&point), false).point;
            prop_assert!((beside - glam(&point)).length() < 1e-6);
        }
    }

    #[test]
    fn the_deepest_gap_is_the_least_way_out(names in solids(), poses in [pose(), pose()]) {
        let scene = pair(names);
        let states = poses.map(|pose| State { pose: Pose { p: pose.p * 0.4, ..pose }, ..State::WORLD });
        let shapes = [0, 1].map(|k| shape(&scene.bodies[k].shape));
        let places = states.map(|state| placed(&state.pose));
        let contact = query::contact(&places[0], &*shapes[0].0, &places[1], &*shapes[1].0, 0.0);
        let Ok(Some(contact)) = contact else { return Ok(()) };
        prop_assume!(contact.dist < -1e-3);
        let found = contacts(&scene, &states, 0.0);
        let depth = nearest(&found).gap;
        // A face is preferred to edges that separate the bodies better by up to a hundredth of the
        // size.
        prop_assert!((depth - contact.dist).abs() < 0.012, "{depth} {}", contact.dist);
    }

    #[test]
    fn nothing_is_found_beyond_the_margin_and_everything_within(
        k in 0..SOLIDS.len(), poses in [pose(), pose()], margin in 0.0..1.0f64,
    ) {
        let scene = pair([SOLIDS[k], SOLIDS[(k + 1) % 4]]);
        let states = poses.map(|pose| State { pose, ..State::WORLD });
        let places = poses.map(|pose| placed(&pose));
        let distance = distance(&scene.bodies, &places);
        prop_assume!((distance - margin).abs() > 1e-6 && distance > 0.0);
        prop_assert_eq!(contacts(&scene, &states, margin).is_empty(), distance > margin);
    }
}
