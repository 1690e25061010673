//! The slip of a contact and its derivative, compared with a naive version with dual numbers.

use lcplab_mechanics::body::{Anisotropy, Pose, State};
use lcplab_mechanics::constraint::{Bounds, Constraint, Contact, Kind, Normal, tangents};
use nalgebra::Vector3;
use proptest::prelude::*;

use super::dual::state;

/// The state after a small time with constant v and ω.
fn later(s: &State, t: f64) -> State {
    let q = nalgebra::UnitQuaternion::from_scaled_axis(s.omega * t) * s.pose.q;
    State { pose: Pose { p: s.pose.p + s.v * t, q }, ..*s }
}

/// The slip velocity (m/s) of a ball on a face that is fixed to body 0, along a tangent fixed to
/// it.
fn slip(s0: &State, s1: &State, n: &Vector3<f64>, t: &Vector3<f64>, radius: f64) -> f64 {
    let touching = s1.pose.p - radius * s0.pose.direction(n);
    let velocity = |s: &State| s.v + s.omega.cross(&(touching - s.pose.p));
    s0.pose.direction(t).dot(&(velocity(s1) - velocity(s0)))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn friction_rows_are_the_slip_and_its_derivative(a in state(), b in state(), radius in 0.1..2.0) {
        let n = Vector3::new(0.6, 0.0, 0.8);
        let contact = Contact {
            bodies: [Some(0), Some(1)],
            anchors: [Vector3::new(0.3, -0.2, 0.1), Vector3::zeros()],
            radii: [0.0, radius],
            normal: Normal::Face(n),
            friction: 0.5,
            anisotropy: None,
        };
        let rows = contact.rows([&a, &b]).unwrap();
        for (row, t) in rows[1..].iter().zip(tangents(&a.pose.direction(&n))) {
            let t = a.pose.q.inverse() * t;
            let at = |time| slip(&later(&a, time), &later(&b, time), &n, &t, radius);
            let rate = row.jacobian[0].dot(&a.velocity()) + row.jacobian[1].dot(&b.velocity());
            let h = 1e-5;
            let derivative = (at(h) - at(-h)) / (2.0 * h);
            prop_assert!((rate - at(0.0)).abs() < 1e-12 * (1.0 + rate.abs()));
            prop_assert!((row.velocity_product - derivative).abs() < 1e-6 * (1.0 + derivative.abs()));
            prop_assert_eq!((row.kind, row.c), (Kind::Friction, 0.0));
            prop_assert_eq!(row.bounds, Bounds::Friction { normal: 0, mu: 0.5 });
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn tangents_of_anisotropic_friction_follow_the_direction_on_its_body(
        a in state(), b in state(), radius in 0.1..2.0, owner in 0..2usize
    ) {
        // The direction is fixed to one body, the normal to body 0; the second tangent is shorter.
        let (n, direction, ratio) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.0, 0.6, -0.8), 0.25);
        let contact = Contact {
            bodies: [Some(0), Some(1)],
            anchors: [Vector3::new(0.3, -0.2, 0.1), Vector3::zeros()],
            radii: [0.0, radius],
            normal: Normal::Face(n),
            friction: 0.5,
            anisotropy: Some((owner, Anisotropy { direction, ratio })),
        };
        let axes = |s0: &State, s1: &State| {
            let (n, d) = (s0.pose.direction(&n), [s0, s1][owner].pose.direction(&direction));
            let along = (d - n * n.dot(&d)).normalize();
            [along, n.cross(&along) * ratio]
        };
        let sliding = |s0: &State, s1: &State, k: usize| {
            let touching = s1.pose.p - radius * s0.pose.direction(&n);
            let velocity = |s: &State| s.v + s.omega.cross(&(touching - s.pose.p));
            axes(s0, s1)[k].dot(&(velocity(s1) - velocity(s0)))
        };
        // Near the normal the direction on the surface turns arbitrarily fast.
        let projected = [&a, &b][owner].pose.direction(&direction).cross(&a.pose.direction(&n));
        prop_assume!(projected.norm() > 0.2);
        let rows = contact.rows([&a, &b]).unwrap();
        for (k, row) in rows[1..].iter().enumerate() {
            let at = |time| sliding(&later(&a, time), &later(&b, time), k);
            let rate = row.jacobian[0].dot(&a.velocity()) + row.jacobian[1].dot(&b.velocity());
            let h = 1e-5;
            let derivative = (at(h) - at(-h)) / (2.0 * h);
            prop_assert!((rate - at(0.0)).abs() < 1e-12 * (1.0 + rate.abs()));
            prop_assert!((row.velocity_product - derivative).abs() < 1e-5 * (1.0 + derivative.abs()));
            prop_assert_eq!(row.bounds, Bounds::Friction { normal: 0, mu: 0.5 });
        }
    }
}

#[test]
fn a_rolling_ball_accelerates_neither_into_the_plane_nor_along_it() {
    // v = ω R without slip: the contact point is at rest and stays so, J'u = 0 in all three rows.
    let (radius, speed) = (0.5, 3.0);
    let ball = State {
        pose: Pose { p: Vector3::new(0.0, 0.0, radius), ..State::WORLD.pose },
        v: Vector3::new(speed, 0.0, 0.0),
        omega: Vector3::new(0.0, speed / radius, 0.0),
    };
    let contact = Contact {
        bodies: [None, Some(0)],
        anchors: [Vector3::zeros(); 2],
        radii: [0.0, radius],
        normal: Normal::Face(Vector3::z()),
        friction: 1.0,
        anisotropy: None,
    };
    for row in contact.rows([&State::WORLD, &ball]).unwrap() {
        assert_eq!(row.c, 0.0);
        assert_eq!(row.jacobian[1].dot(&ball.velocity()), 0.0);
        assert_eq!(row.velocity_product, 0.0);
    }
}
