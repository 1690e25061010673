//! c'(0) = J u and c''(0) = J'u for each constraint at random states, by `constraint::verify`.

use lcplab_mechanics::body::{Pose, State};
use lcplab_mechanics::constraint::{
    ALL, Bodies, Contact, Coordinate, Field, Joint, Motion, Normal, Orientation, Placement, Rim,
    Verifiable, verify,
};
use lcplab_mechanics::scene::{Scene, contacts};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

use lcplab_testing::cases;

const SHAPES: [&str; 4] = [
    "{ sphere = 0.5 }",
    "{ box = [1, 1, 1] }",
    "{ capsule = { length = 1, radius = 0.25 } }",
    "{ hull = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] }",
];
const BODIES: Bodies = [Some(0), Some(1)];

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    [-2.0..2.0, -2.0..2.0, -2.0..2.0].prop_map(Vector3::from)
}

fn unit() -> impl Strategy<Value = Vector3<f64>> {
    vector().prop_filter("not too short", |v| v.norm() > 0.1).prop_map(|v| v.normalize())
}

fn rotation() -> impl Strategy<Value = UnitQuaternion<f64>> {
    vector().prop_map(UnitQuaternion::from_scaled_axis)
}

fn pose() -> impl Strategy<Value = Pose> {
    (vector(), rotation()).prop_map(|(p, q)| Pose { p, q })
}

pub fn state() -> impl Strategy<Value = State> {
    (pose(), vector(), vector()).prop_map(|(pose, v, omega)| State { pose, v, omega })
}

/// A placement for any joint: every field has a value.
#[derive(Debug)]
pub struct Place(Placement);

pub fn placement() -> impl Strategy<Value = Place> {
    let at = (pose(), pose(), vector(), [vector(), vector()], unit(), unit());
    at.prop_filter("axes apart", |at| at.4.cross(&at.5).norm() > 0.1).prop_map(
        |(pose0, pose1, point, points, axis, other)| {
            let across = axis.cross(&other).normalize();
            Place(Placement {
                poses: [pose0, pose1],
                point: Some(point),
                points: Some(points),
                axis: Some(axis),
                axes: Some([axis, across]),
                ..Place::plain().0
            })
        },
    )
}

impl Place {
    /// Everything at the origin, the axis upwards.
    pub fn plain() -> Self {
        Place(Placement {
            bodies: BODIES,
            point: Some(Vector3::zeros()),
            axis: Some(Vector3::z()),
            length: Some(1.5),
            angle: Some(0.7),
            limits: Some([-0.4, 1.1]),
            speed: Some(2.0),
            effort: Some(3.0),
            stiffness: Some(40.0),
            damping: Some(5.0),
            teeth: Some([12, 35]),
            ..Placement::default()
        })
    }

    /// The placement for this joint; a joint of one body is joined to the world.
    pub fn of(&self, joint: &Joint) -> Placement {
        let mut at = self.0.clone();
        if joint.bodies.1 == 1 {
            (at.bodies, at.poses[0]) = ([None, Some(1)], State::WORLD.pose);
        }
        at
    }
}

/// Whether the state is far from singular configurations of the joints, such as coincident points
/// or a reversed axis, where the numbers and their rounding errors grow without bound.
fn is_regular(at: &Placement, states: [&State; 2]) -> bool {
    let [q0, q1] = states.map(|state| state.pose.q);
    let axis = at.axis.unwrap();
    let ends = at.points.unwrap();
    let [end0, end1] = [0, 1].map(|k| states[k].pose.point(&at.poses[k].local(&ends[k])));
    let [axis0, axis1] =
        [0, 1].map(|k| states[k].pose.direction(&(at.poses[k].q.inverse() * axis)));
    let twists = |n: Vector3<f64>, e: UnitQuaternion<f64>| {
        e.w.abs() > 0.05 && e.w.hypot(e.imag().dot(&n)) > 0.1
    };
    let relative = q0.inverse() * q1 * (at.poses[0].q.inverse() * at.poses[1].q).inverse();
    let wheel = |k: usize| states[k].pose.q * at.poses[k].q.inverse();
    (end1 - end0).norm() > 0.1
        // The rollers of a pulley.
        && [0, 1].into_iter().all(|k| (states[k].pose.p - ends[k]).norm() > 0.1)
        && axis0.cross(&axis1).norm() > 0.1
        && axis0.dot(&axis1).abs() > 0.02
        && twists(at.poses[0].q.inverse() * axis, relative)
        && [0, 1].into_iter().all(|k| twists(at.axes.unwrap()[k], wheel(k)))
}

fn check(
    constraint: &dyn Verifiable,
    states: [&State; 2],
    name: &str,
) -> Result<(), TestCaseError> {
    verify(constraint, states).map_err(|mistake| TestCaseError::fail(format!("{name}: {mistake}")))
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn every_joint_matches_dual_numbers(at in placement(), a in state(), b in state()) {
        for joint in ALL {
            let at = at.of(joint);
            let a = if at.bodies[0].is_none() { &State::WORLD } else { &a };
            prop_assume!(is_regular(&at, [a, &b]));
            let constraint = (joint.build)(&at).unwrap();
            check(constraint.as_ref(), [a, &b], joint.name)?;
        }
    }

    #[test]
    fn every_joint_to_the_world_matches_dual_numbers(at in placement(), b in state()) {
        for joint in ALL.iter().filter(|joint| joint.bodies.0 == 1) {
            let mut at = at.of(joint);
            (at.bodies, at.poses[0]) = ([None, Some(0)], State::WORLD.pose);
            prop_assume!(is_regular(&at, [&State::WORLD, &b]));
            check((joint.build)(&at).unwrap().as_ref(), [&State::WORLD, &b], joint.name)?;
        }
    }

    #[test]
    fn a_joint_holds_where_it_was_made(at in placement()) {
        // c = 0 at the start, except for joints with their own length, angle or stops.
        for joint in ALL {
            let at = at.of(joint);
            let length = at.length.filter(|_| joint.needs.contains(&Field::Length));
            let at = Placement { length, ..at };
            let states = at.poses.map(|pose| State { pose, ..State::WORLD });
            let rows = (joint.build)(&at).unwrap().rows([&states[0], &states[1]]).unwrap();
            let expected: &[f64] = match joint.name {
                "limit_translation" | "limit_rotation" => &[0.4, 1.1],
                "limit_cone" => &[0.7],
                _ => &[0.0; 6],
            };
            for (row, expected) in rows.iter().zip(expected) {
                // By rounding, an angle between axes is the arc sine of 1e-16 or its square root.
                let rounding = if joint.name == "limit_cone" { 1e-7 } else { 1e-13 };
                prop_assert!((row.c - expected).abs() < rounding, "{} {} {expected}", joint.name, row.c);
            }
        }
    }

    #[test]
    fn contacts_of_every_kind_match_dual_numbers(
        a in state(), b in state(), r0 in vector(), r1 in vector(), e0 in unit(), e1 in unit(),
    ) {
        let rim = Rim { normal: e0, axis: e1, radius: 0.4 };
        let kinds = [
            Normal::Face(e0),
            Normal::Centers,
            Normal::Edge(e0),
            Normal::Edges([e0, e1]),
            Normal::Rim(rim),
        ];
        for normal in kinds {
            let radii = if normal == Normal::Rim(rim) { [0.0; 2] } else { [0.2, 0.3] };
            let contact =
                Contact { bodies: BODIES, anchors: [r0, r1], radii, normal, friction: 0.0, anisotropy: None };
            let [e0, e1] = [a.pose.direction(&e0), b.pose.direction(&e1)];
            let d = b.pose.point(&r1) - a.pose.point(&r0);
            prop_assume!(e0.cross(&e1).norm() > 0.1 && d.cross(&e0).norm() > 0.1);
            check(&contact, [&a, &b], "contact")?;
        }
    }

    #[test]
    fn the_twist_of_a_turn_about_the_axis_is_its_angle(n in unit(), phi in -3.1..3.1_f64, q0 in rotation()) {
        let relative = Orientation { bodies: BODIES, relative: UnitQuaternion::identity() };
        let angle = Coordinate { bodies: BODIES, axis: n, motion: Motion::Rotation { relative } };
        let pose = |q| Pose { p: Vector3::zeros(), q };
        let turned = q0 * UnitQuaternion::from_scaled_axis(n * phi);
        let value: f64 = angle.value([&pose(q0), &pose(turned)]);
        prop_assert!((value - phi).abs() < 1e-13);
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
            check(&found.contact, if swapped { [&b, &a] } else { [&a, &b] }, "contact")?;
        }
    }
}
