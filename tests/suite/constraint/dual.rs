//! c'(0) = J u and c''(0) = J'u for each constraint at random states.

use lcplab::body::{Pose, State};
use lcplab::constraint::{
    AxisLock, Coincidence, Constraint, Contact, Distance, Motion, Normal, Orientation, Position,
    Weld,
};
use lcplab::scene::{Scene, contacts};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use num_dual::Dual2_64;
use proptest::prelude::*;

const SHAPES: [&str; 4] = [
    "{ sphere = 0.5 }",
    "{ box = [1, 1, 1] }",
    "{ capsule = { length = 1, radius = 0.25 } }",
    "{ hull = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] }",
];
const BODIES: [Option<usize>; 2] = [Some(0), Some(1)];

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    [-2.0..2.0, -2.0..2.0, -2.0..2.0].prop_map(Vector3::from)
}

fn unit() -> impl Strategy<Value = Vector3<f64>> {
    vector().prop_filter("not too short", |v| v.norm() > 0.1).prop_map(|v| v.normalize())
}

fn rotation() -> impl Strategy<Value = UnitQuaternion<f64>> {
    vector().prop_map(UnitQuaternion::from_scaled_axis)
}

pub fn state() -> impl Strategy<Value = State> {
    (vector(), rotation(), vector(), vector()).prop_map(|(p, q, v, omega)| State {
        pose: Pose { p, q },
        v,
        omega,
    })
}

/// p + v t and exp(ω t) q at t = 0 with their first two derivatives: with q' = ½ (0, ω) q and ω
/// constant, q'' = −¼ |ω|² q.
fn moving(state: &State) -> Pose<Dual2_64> {
    let (p, v, q) = (state.pose.p, state.v, state.pose.q.into_inner());
    let q_rate = Quaternion::from_imag(state.omega) * q * 0.5;
    let q_bend = q * (-0.25 * state.omega.norm_squared());
    let dual = |k: usize| Dual2_64::new(q.coords[k], q_rate.coords[k], q_bend.coords[k]);
    Pose {
        p: Vector3::from_fn(|k, _| Dual2_64::new(p[k], v[k], 0.0)),
        q: UnitQuaternion::new_unchecked(Quaternion::new(dual(3), dual(0), dual(1), dual(2))),
    }
}

/// Compares the first rows of a constraint, those that have a position, with dual numbers.
fn check<C: Constraint + Position>(
    constraint: &C,
    states: [&State; 2],
) -> Result<(), TestCaseError> {
    let exact = constraint.c([&moving(states[0]), &moving(states[1])]);
    let rows = constraint.rows(states).expect("a regular state");
    prop_assert!(rows.len() >= exact.len());
    for (row, exact) in rows.iter().zip(exact) {
        let rate =
            row.jacobian[0].dot(&states[0].velocity()) + row.jacobian[1].dot(&states[1].velocity());
        for (ours, dual) in [(row.c, exact.re), (rate, exact.v1), (row.velocity_product, exact.v2)]
        {
            prop_assert!((ours - dual).abs() <= 1e-9 * (1.0 + dual.abs()), "{ours} {dual}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn coincidence_matches_dual_numbers(a in state(), b in state(), r0 in vector(), r1 in vector()) {
        check(&Coincidence { bodies: BODIES, anchors: [r0, r1] }, [&a, &b])?;
    }

    #[test]
    fn distance_matches_dual_numbers(a in state(), b in state(), r0 in vector(), r1 in vector()) {
        let rod = Distance { bodies: BODIES, anchors: [r0, r1], length: 1.5 };
        prop_assume!(rod.c([&a.pose, &b.pose])[0] > -1.4); // the ends are not together
        check(&rod, [&a, &b])?;
    }

    #[test]
    fn orientation_matches_dual_numbers(a in state(), b in state(), relative in rotation()) {
        check(&Orientation { bodies: BODIES, relative }, [&a, &b])?;
    }

    #[test]
    fn weld_matches_dual_numbers(
        a in state(), b in state(), r0 in vector(), r1 in vector(), relative in rotation(),
    ) {
        let point = Coincidence { bodies: BODIES, anchors: [r0, r1] };
        check(&Weld { point, orientation: Orientation { bodies: BODIES, relative } }, [&a, &b])?;
    }

    #[test]
    fn translation_lock_matches_dual_numbers(
        a in state(), b in state(), r0 in vector(), r1 in vector(), axis in unit(),
    ) {
        let motion = Motion::Translation { anchors: [r0, r1], offset: 0.3 };
        check(&AxisLock { bodies: BODIES, axis, motion }, [&a, &b])?;
    }

    #[test]
    fn rotation_lock_matches_dual_numbers(
        a in state(), b in state(), axis in unit(), relative in rotation(),
    ) {
        let motion = Motion::Rotation { relative: Orientation { bodies: BODIES, relative } };
        check(&AxisLock { bodies: BODIES, axis, motion }, [&a, &b])?;
    }

    #[test]
    fn contacts_of_every_kind_match_dual_numbers(
        a in state(), b in state(), r0 in vector(), r1 in vector(), e0 in unit(), e1 in unit(),
    ) {
        for normal in [Normal::Face(e0), Normal::Centres, Normal::Edge(e0), Normal::Edges([e0, e1])] {
            let contact =
                Contact { bodies: BODIES, anchors: [r0, r1], radii: [0.2, 0.3], normal, friction: 0.0 };
            let [e0, e1] = [a.pose.direction(&e0), b.pose.direction(&e1)];
            let d = b.pose.point(&r1) - a.pose.point(&r0);
            prop_assume!(e0.cross(&e1).norm() > 0.1 && d.cross(&e0).norm() > 0.1);
            check(&contact, [&a, &b])?;
        }
    }

    #[test]
    fn contacts_found_between_shapes_match_dual_numbers(
        a in state(), b in state(), shapes in [0..4usize, 0..4usize],
    ) {
        let body = |k: usize| {
            let shape = SHAPES[shapes[k]];
            format!("[[bodies]]\nname = \"{k}\"\nmass = 1\nshape = {shape}\n")
        };
        let scene = Scene::from_toml("two.toml", &(body(0) + &body(1))).expect("a valid scene");
        for found in contacts(&scene, &[a, b], 1.0) {
            prop_assume!(found.gap.abs() > 1e-3); // the normals are well defined
            let swapped = found.contact.bodies == [Some(1), Some(0)];
            check(&found.contact, if swapped { [&b, &a] } else { [&a, &b] })?;
        }
    }
}
