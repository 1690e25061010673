//! Bodies by themselves.

use lcplab_bodies::body::alignment;
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-size..size).prop_map(Vector3::from)
}

proptest! {
    #![proptest_config(lcplab_testing::cases(256))]

    #[test]
    fn the_rotation_of_three_points_is_found_again(
        points in prop::array::uniform3(vector(2.0)),
        turn in vector(3.0),
        shift in vector(10.0),
    ) {
        let [a, b, c] = points;
        let (longest, area) = ((b - a).norm().max((c - a).norm()), (b - a).cross(&(c - a)).norm());
        prop_assume!(area > 0.05 * longest * longest);
        let turn = UnitQuaternion::from_scaled_axis(turn);
        let moved = points.map(|point| turn * point + shift);
        prop_assert!(alignment(&points, &moved).unwrap().angle_to(&turn) < 1e-9);
    }

    #[test]
    fn points_that_have_strayed_still_give_a_rotation(
        points in prop::array::uniform4(vector(2.0)),
        strayed in prop::array::uniform4(vector(2.0)),
    ) {
        // The best one: no small turn about an axis brings the points closer.
        let Some(found) = alignment(&points, &strayed) else { return Ok(()) };
        let mean = |cloud: &[Vector3<f64>; 4]| cloud.iter().sum::<Vector3<f64>>() / 4.0;
        let miss = |turn: UnitQuaternion<f64>| -> f64 {
            let pairs = points.iter().zip(&strayed);
            pairs.map(|(r, p)| (turn * (r - mean(&points)) - (p - mean(&strayed))).norm_squared()).sum()
        };
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            for angle in [-1e-3, 1e-3] {
                let near = UnitQuaternion::from_scaled_axis(angle * axis) * found;
                prop_assert!(miss(found) <= miss(near) + 1e-12);
            }
        }
    }
}

#[test]
fn points_in_a_line_have_no_orientation() {
    let line = [Vector3::zeros(), Vector3::x(), 3.0 * Vector3::x()];
    let triangle = [Vector3::zeros(), Vector3::x(), Vector3::y()];
    assert_eq!(alignment(&line, &triangle), None);
    assert_eq!(alignment(&triangle, &line), None);
    assert_eq!(alignment(&triangle, &triangle[..2]), None);
    assert_eq!(alignment(&[], &[]), None);
}
