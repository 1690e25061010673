//! Every pair of shapes at poses with known gap, normal and number of points.

use lcplab_mechanics::body::{Pose, State};
use nalgebra::{UnitQuaternion, Vector3};

use super::{CAPSULE, CUBE, OCTAHEDRON, PLANE, POINT, SPHERE, found, nearest, turned};

/// The first body is at the origin with the world's axes; the second is at a distance along n,
/// shifted by `aside`.
struct Case {
    shapes: [&'static str; 2],
    /// The distance of the centers along n at which the bodies touch.
    touching: f64,
    n: Vector3<f64>,
    aside: Vector3<f64>,
    turn: UnitQuaternion<f64>,
    points: usize,
}

fn cases() -> Vec<Case> {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let diagonal = Vector3::repeat(1.0f64).normalize();
    let slope = Vector3::new(1.0, 0.0, 1.0).normalize();
    let face = 1.0 / 3f64.sqrt(); // from the octahedron's center to a face
    let straight = UnitQuaternion::identity();
    let lying = turned(y, 90.0); // a capsule along x
    let case = |shapes, touching, n, aside, turn, points| Case {
        shapes,
        touching,
        n,
        aside,
        turn,
        points,
    };
    vec![
        case([SPHERE, SPHERE], 1.0, diagonal, Vector3::zeros(), straight, 1),
        case([SPHERE, POINT], 0.5, diagonal, Vector3::zeros(), straight, 1),
        case([CAPSULE, POINT], 0.25, x, 0.2 * z, straight, 1),
        case([CAPSULE, SPHERE], 0.75, x, 0.2 * z, straight, 1),
        case([CAPSULE, SPHERE], 1.25, z, Vector3::zeros(), straight, 1),
        case([CAPSULE, CAPSULE], 0.5, x, 0.3 * z, straight, 2), // side by side
        case([CAPSULE, CAPSULE], 0.5, x, 0.1 * y, turned(x, 90.0), 1), // crossed
        case([CAPSULE, CAPSULE], 1.5, z, Vector3::zeros(), straight, 1), // end on end
        case([CUBE, POINT], 0.5, z, 0.1 * x, straight, 1),
        case([CUBE, SPHERE], 1.0, z, 0.1 * x + 0.2 * y, straight, 1),
        case([CUBE, SPHERE], 0.5f64.sqrt() + 0.5, slope, 0.2 * y, straight, 1),
        case([CUBE, SPHERE], 0.75f64.sqrt() + 0.5, diagonal, Vector3::zeros(), straight, 1),
        case([CUBE, CAPSULE], 1.25, z, 0.1 * x, straight, 1), // standing
        case([CUBE, CAPSULE], 0.75, z, 0.2 * x, lying, 2),    // one end over the face, one beyond
        case([CUBE, CAPSULE], 0.5f64.sqrt() + 0.25, slope, 0.1 * y, turned(x, 90.0), 2),
        case([CUBE, CUBE], 1.0, z, Vector3::zeros(), straight, 4),
        case([CUBE, CUBE], 1.0, z, 0.3 * x + 0.2 * y, straight, 4),
        case([CUBE, CUBE], 1.0, z, Vector3::zeros(), turned(z, 45.0), 8), // an octagon
        case([CUBE, CUBE], 2.0 * 0.75f64.sqrt(), diagonal, Vector3::zeros(), straight, 1),
        case([CUBE, CUBE], 2.0 * 0.5f64.sqrt(), slope, 0.1 * y, straight, 2), // edge on edge
        case([OCTAHEDRON, POINT], 1.0, z, Vector3::zeros(), straight, 1),
        case([OCTAHEDRON, SPHERE], face + 0.5, diagonal, Vector3::zeros(), straight, 1),
        case([OCTAHEDRON, CAPSULE], 1.25, z, 0.1 * x, lying, 1),
        case([CUBE, OCTAHEDRON], 1.5, z, 0.1 * x, straight, 1),
        case([OCTAHEDRON, OCTAHEDRON], 2.0 * face, diagonal, Vector3::zeros(), straight, 6),
        case([PLANE, POINT], 0.0, z, x, straight, 1),
        case([PLANE, SPHERE], 0.5, z, x, straight, 1),
        case([PLANE, CUBE], 0.5, z, x, straight, 4),
        case([PLANE, CAPSULE], 0.25, z, x, lying, 2),
        case([PLANE, CAPSULE], 0.75, z, x, straight, 1),
        case([PLANE, OCTAHEDRON], 1.0, z, x, straight, 1),
    ]
}

#[test]
fn every_pair_of_shapes_has_the_gap_normal_and_points_of_its_closed_form() {
    for gap in [0.01, -0.01] {
        for (k, case) in cases().into_iter().enumerate() {
            let place = case.n * (case.touching + gap) + case.aside;
            let poses = [State::WORLD.pose, Pose { p: place, q: case.turn }];
            for swap in [false, true] {
                let (mut shapes, mut poses, mut n) = (case.shapes, poses, case.n);
                if swap {
                    shapes.reverse();
                    poses.reverse();
                    n = -n;
                }
                let what = format!("case {k}, {shapes:?}, gap {gap}");
                let pointed = case.n.iter().filter(|x| **x != 0.0).count() > 1;
                if gap < 0.0 && (pointed && shapes == [CUBE, CUBE] || shapes.contains(&POINT)) {
                    continue; // where corners or edges overlap, a face is the shortest way out
                }
                let points = found(shapes, poses, 0.05);
                assert_eq!(points.len(), case.points, "{what}: {points:#?}");
                let touching = nearest(&points);
                assert!((touching.gap - gap).abs() < 1e-12, "{what}: {}", touching.gap);
                let outwards =
                    if touching.contact.bodies == [Some(0), Some(1)] { 1.0 } else { -1.0 };
                let difference = touching.normal * outwards - n;
                assert!(difference.norm() < 1e-12, "{what}: {}", touching.normal);
            }
        }
    }
}

#[test]
fn a_chamfered_corner_keeps_apart_points_that_do_not_touch() {
    // Corner next to corner: 0.3 apart along x and along y, so √0.18 in total; no face is near.
    let place = Vector3::new(1.3, 1.3, 0.0);
    let poses = [State::WORLD.pose, Pose { p: place, ..State::WORLD.pose }];
    let points = found([CUBE, CUBE], poses, 1.0);
    assert!((nearest(&points).gap - 0.18f64.sqrt()).abs() < 1e-12);
    assert!(found([CUBE, CUBE], poses, 0.4).is_empty());
}
