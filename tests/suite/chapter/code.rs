//! The listings: what of them stands is right, what does not fails as theory says, and the
//! corrected forms are what the library does.

use lcplab::body::{Mass, Pose, State};
use lcplab::chapter::code::code01_unconstrained_step::{self as code01, Blocks};
use lcplab::chapter::code::code05_rigid_body::{self as code05, RigidBody, Vectors};
use lcplab::chapter::code::code07_whole_step::{Limits, WholeStep, World, gathered};
use lcplab::chapter::code::constraint_class::{Constraint, Joint};
use lcplab::chapter::code::{
    Form, code02_constrained_step as code02, code03_update as code03,
    code04_drift_correction as code04, code06_solver as code06,
};
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver;
use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, UnitQuaternion, Vector3};
use proptest::prelude::*;

use lcplab_testing::cases;

const DT: f64 = 1.0 / 60.0;
const G: f64 = 9.81;
const MANY: usize = 4000;

fn small() -> impl Strategy<Value = f64> {
    (-20..=20i32).prop_map(|k| f64::from(k) / 8.0)
}

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    (small(), small(), small()).prop_map(|(x, y, z)| Vector3::new(x, y, z))
}

fn body() -> impl Strategy<Value = RigidBody> {
    let inertia = (1..9u8, 1..9u8, 1..9u8);
    let vectors = (vector(), vector(), vector(), vector(), vector(), vector());
    (vectors, inertia, 1..9u8).prop_map(|((p, axis, v, omega, f, torque), (a, b, c), mass)| {
        RigidBody {
            position: p,
            orientation: UnitQuaternion::from_scaled_axis(axis).into_inner(),
            linear_velocity: v,
            angular_velocity: omega,
            force: f,
            torque,
            inverse_mass: 1.0 / f64::from(mass),
            inverse_inertia: Matrix3::from_diagonal(&Vector3::new(
                1.0 / f64::from(a),
                1.0 / f64::from(b),
                1.0 / f64::from(c),
            )),
        }
    })
}

fn world(bodies: Vec<RigidBody>, joints: Vec<Joint>) -> World {
    let constraints = joints.into_iter().map(|joint| Box::new(joint) as Box<dyn Constraint>);
    World { bodies, constraints: constraints.collect(), x: Vec::new() }
}

/// A point mass of 1 kg on the z axis.
fn point(z: f64, speed: f64) -> RigidBody {
    RigidBody::point(1.0, Vector3::z() * z, Vector3::z() * speed)
}

fn weigh(bodies: &mut [RigidBody]) {
    for body in bodies {
        body.force.z -= G / body.inverse_mass;
    }
}

proptest! {
    #![proptest_config(cases(64))]

    /// Each body by itself: v' = f/m, ω' = I⁻¹ τ, p' = v⁺, q' = ½ (0, ω⁺) q.
    #[test]
    fn code_1_moves_each_body_by_itself(bodies in proptest::collection::vec(body(), 1..4)) {
        let (u, s) = code01::printed(&gathered(&bodies, Form::Printed), DT);
        for (i, body) in bodies.iter().enumerate() {
            let moments = body.inverse_inertia.diagonal().map(f64::recip);
            let pose = Pose {
                p: body.position,
                q: UnitQuaternion::new_unchecked(body.orientation),
            };
            let inertia = Mass::Rigid { mass: 1.0, moments }.world_inertia(&pose);
            let v = body.linear_velocity + body.force * body.inverse_mass * DT;
            let omega = body.angular_velocity + inertia.lu().solve(&body.torque).unwrap() * DT;
            let (p_rate, q_rate) = State { pose, v, omega }.rate();
            let (p, q) = (body.position + p_rate * DT, body.orientation + q_rate * DT);
            for k in 0..3 {
                prop_assert!((u[6 * i + k] - v[k]).abs() < 1e-12);
                prop_assert!((u[6 * i + 3 + k] - omega[k]).abs() < 1e-11);
                prop_assert!((s[7 * i + k] - p[k]).abs() < 1e-12);
            }
            for (k, q) in [q.w, q.i, q.j, q.k].into_iter().enumerate() {
                prop_assert!((s[7 * i + 3 + k] - q).abs() < 1e-12);
            }
        }
    }

    /// Code 2 with Code 4's x leaves J u⁺ = −β c; (23) leaves (1 − dt) J u* − dt β c.
    #[test]
    fn codes_2_and_4_go_together_and_code_4_and_23_do_not(
        entries in proptest::collection::vec(small(), 8),
        u in proptest::collection::vec(small(), 4),
        c in proptest::collection::vec(small(), 2),
    ) {
        let mut jacobian = DMatrix::from_row_slice(2, 4, &entries);
        jacobian[(0, 0)] += 8.0;
        jacobian[(1, 1)] += 8.0; // two rows that are never near each other
        let blocks = Blocks::on_a_line(&u, &[1.0, 0.5, 2.0, 0.0], &[-1.0, 2.0, 0.0, 3.0]);
        let c = DVector::from_vec(c);
        let x = code04::printed(&blocks, &jacobian, &c, DT, MANY).unwrap();
        let free = &jacobian * blocks.unconstrained(DT);
        let wanted = -code04::BETA * &c;
        let (by_code_2, _) = code02::printed(&blocks, &jacobian, &x, DT);
        prop_assert!((&jacobian * by_code_2 - &wanted).amax() < 1e-10);
        let (by_23, _) = code02::equation(&blocks, &jacobian, &x, DT);
        let left = &free * (1.0 - DT) + &wanted * DT;
        prop_assert!((&jacobian * &by_23 - &left).amax() < 1e-10);
        // With a force in the place of the impulse (23) is right.
        let (by_force, _) = code02::equation(&blocks, &jacobian, &(&x / DT), DT);
        prop_assert!((&jacobian * by_force - &wanted).amax() < 1e-9);
    }

    /// The inertia of the turned points themselves, for both kinds of vectors.
    #[test]
    fn code_5_turns_the_inertia_rightly_for_row_vectors_only(
        points in proptest::collection::vec(vector(), 6),
        axis in vector(),
    ) {
        let inertia = |points: &[Vector3<f64>]| -> Matrix3<f64> {
            let of = |r: &Vector3<f64>| {
                Matrix3::identity() * r.norm_squared() - r * r.transpose()
            };
            // A ball at the center keeps it regular.
            points.iter().map(of).sum::<Matrix3<f64>>() + Matrix3::identity()
        };
        let turn = UnitQuaternion::from_scaled_axis(axis);
        let turned: Vec<_> = points.iter().map(|r| turn * r).collect();
        let mut body = point(0.0, 0.0);
        body.orientation = turn.into_inner();
        body.inverse_inertia = inertia(&points).try_inverse().unwrap();
        let truth = inertia(&turned).try_inverse().unwrap();
        prop_assert!((code05::printed(&body, Vectors::Rows) - truth).amax() < 1e-12);
        prop_assert!((code05::corrected(&body) - truth).amax() < 1e-12);
        // Where vectors are columns the listing turns the other way round.
        let back: Vec<_> = points.iter().map(|r| turn.inverse() * r).collect();
        let wrong = inertia(&back).try_inverse().unwrap();
        prop_assert!((code05::printed(&body, Vectors::Columns) - wrong).amax() < 1e-12);
    }

    /// τ = r × f, and the gyroscopic torque leaves I ω alone to second order.
    #[test]
    fn code_5_adds_up_forces_with_their_torques(mut body in body(), at in vector(), f in vector()) {
        let (force, torque) = (body.force, body.torque);
        body.add_force(&at, &f);
        let r = at - body.position;
        let moment = Vector3::new(r.y * f.z - r.z * f.y, r.z * f.x - r.x * f.z, r.x * f.y - r.y * f.x);
        prop_assert_eq!(body.force, force + f);
        prop_assert!((body.torque - torque - moment).amax() < 1e-12);
    }
}

#[test]
fn both_forms_of_code_6_are_gauss_seidel_without_bounds() {
    let a = DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 2.0]);
    let b = DVector::from_column_slice(&[1.0, 1.0]);
    // The error starts at 1 and, by hand, is ½ and ¼ after the first sweep; then a quarter each
    // sweep.
    let x = code06::printed(&a, &b, None, None, 3).unwrap();
    assert_eq!(x.as_slice(), [1.0 - 0.5 / 16.0, 1.0 - 0.25 / 16.0]);
    assert_eq!(code06::corrected(&a, &-b, None, None, 3).unwrap(), x);
}

#[test]
fn code_6_has_another_limit_with_bounds() {
    let a = DMatrix::from_row_slice(2, 2, &[1.0, 0.5, 0.5, 1.0]);
    let b = DVector::from_column_slice(&[-1.0, 1.0]);
    let x = code06::printed(&a, &b, Some(&[0.0; 2]), None, 60).unwrap();
    assert!((x - DVector::from_column_slice(&[0.0, 2.0])).amax() < 1e-12);
    let x = code06::corrected(&a, &-b, Some(&[0.0; 2]), None, 60).unwrap();
    assert_eq!(x.as_slice(), [0.0, 1.0]);
}

#[test]
fn code_3_lets_a_free_body_fall_in_its_corrected_form_only() {
    let (mut printed, mut corrected) =
        (world(vec![point(10.0, 0.0)], vec![]), world(vec![point(10.0, 0.0)], vec![]));
    for _ in 0..60 {
        code03::printed(&mut printed, weigh, DT).unwrap();
        code03::corrected(&mut corrected, weigh, DT).unwrap();
    }
    assert_eq!(printed.bodies[0].position.z, 10.0);
    assert!((printed.bodies[0].force.z + 60.0 * G).abs() < 1e-9);
    let fallen = G * DT * DT * 60.0 * 61.0 / 2.0; // of semi-implicit Euler
    assert!((corrected.bodies[0].position.z - (10.0 - fallen)).abs() < 1e-12);
    assert_eq!(corrected.bodies[0].force.z, 0.0);
}

/// A scene, its velocities, its J by rows, and the impulses.
type Worked = (&'static str, &'static [f64], &'static [f64], &'static [f64]);

/// The corrected Codes 4 and 2 on the two worked examples, and the shipped scenes of them.
#[test]
fn corrected_codes_2_and_4_give_figures_6_and_7() {
    let examples: [Worked; 2] = [
        ("fig6", &[-1.0], &[1.0], &[2.0]),
        (
            "fig7",
            &[0.0, -1.0, 0.0],
            &[1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, -1.0, 1.0],
            &[4.0, 3.0, 1.0],
        ),
    ];
    for (name, u, jacobian, impulses) in examples {
        let n = u.len();
        let blocks = Blocks::on_a_line(u, &vec![1.0; n], &vec![-1.0; n]);
        let jacobian = DMatrix::from_row_slice(n, n, jacobian);
        let x = code04::corrected(&blocks, &jacobian, &DVector::zeros(n), 1.0, 300).unwrap();
        let (u_next, _) = code02::corrected(&blocks, &jacobian, &x, 1.0);
        assert!((&x - DVector::from_column_slice(impulses)).amax() < 1e-12, "{name}: {x}");
        assert!(u_next.amax() < 1e-12);
        let step = simulation(Scene::load(name).unwrap()).step().unwrap();
        assert!((&x - DVector::from_column_slice(&step.solves[0].solution.x)).amax() < 1e-12);
        // As printed, x has the other sign and the same motion comes of it.
        let taken = code04::printed(&blocks, &jacobian, &DVector::zeros(n), 1.0, 300).unwrap();
        assert!((&taken + &x).amax() < 1e-12);
        assert!((code02::printed(&blocks, &jacobian, &taken, 1.0).0 - u_next).amax() < 1e-12);
    }
}

#[test]
fn corrected_code_7_steps_figures_6_and_7_as_the_library_does() {
    let fig6 = world(vec![point(0.0, -1.0)], vec![Joint::contact([None, Some(0)], 0.0)]);
    let stack = vec![point(0.5, 0.0), point(1.5, -1.0), point(2.5, 0.0)];
    let touching = |pair, length| Joint::contact(pair, length);
    let joints = vec![
        touching([None, Some(0)], 0.5),
        touching([Some(0), Some(1)], 1.0),
        touching([Some(1), Some(2)], 1.0),
    ];
    let step = WholeStep { sweeps: 300, ..WholeStep::CORRECTED };
    for (name, mut world) in [("fig6", fig6), ("fig7", world(stack, joints))] {
        let mut simulation = simulation(Scene::load(name).unwrap());
        for _ in 0..3 {
            let theirs = simulation.step().unwrap();
            for body in &mut world.bodies {
                body.force.z -= 1.0;
            }
            step.take(&mut world, 1.0).unwrap();
            for (x, y) in world.x.iter().zip(&theirs.solves[0].solution.x) {
                assert!((x - y).abs() < 1e-12, "{name}: {x} {y}");
            }
            for (body, state) in world.bodies.iter().zip(&theirs.states[1..]) {
                assert!((body.position - state.pose.p).norm() < 1e-12);
                assert!((body.linear_velocity - state.v).norm() < 1e-12);
            }
        }
    }
}

const TWO_BODIES: &str = r#"
[step]
dt = 0.01
baumgarte = 0.1
gyroscopic = "explicit"

[[bodies]]
name = "upper"
shape = { box = [0.2, 0.1, 1] }
mass = 2
position = [0.5, 0, 0]
rotation = { y = 90 }
velocity = [0, 0.5, 0]
angular_velocity = [0.5, 0, 1]

[[bodies]]
name = "lower"
shape = { box = [0.1, 0.3, 1] }
mass = 1
position = [1, 0, -0.5]
rotation = { z = 30 }
velocity = [0, 1, 0]
angular_velocity = [1, -0.5, 2]

[[constraints]]
kind = "nail"
bodies = ["upper"]
point = [0, 0, 0]

[[constraints]]
kind = "ball"
bodies = ["upper", "lower"]
point = [1, 0, 0]
"#;

/// Two boxes that hang from a nail and from each other: inertias, arms and drift take part.
#[test]
fn corrected_code_7_swings_a_double_pendulum_as_the_library_does() {
    let scene = Scene::from_toml("two_bodies.toml", TWO_BODIES).unwrap();
    let bodies = scene.bodies.iter().zip(&scene.states).map(|(body, state)| {
        let Mass::Rigid { mass, moments } = body.mass else { panic!("a rigid body") };
        let mut own = RigidBody::point(mass, state.pose.p, state.v);
        own.orientation = *state.pose.q.quaternion();
        own.angular_velocity = state.omega;
        own.inverse_inertia = Matrix3::from_diagonal(&moments.map(f64::recip));
        own
    });
    let local = |body: usize, at: Vector3<f64>| scene.states[body].pose.local(&at);
    let elbow = Vector3::x();
    let joints = vec![
        Joint::ball([None, Some(0)], [Vector3::zeros(), local(0, Vector3::zeros())]),
        Joint::ball([Some(0), Some(1)], [local(0, elbow), local(1, elbow)]),
    ];
    let mut world = world(bodies.collect(), joints);
    let step = WholeStep { sweeps: MANY, ..WholeStep::CORRECTED };
    let mut simulation = simulation(scene.clone());
    for _ in 0..10 {
        let theirs = simulation.step().unwrap();
        weigh(&mut world.bodies);
        step.take(&mut world, 0.01).unwrap();
        for (body, state) in world.bodies.iter_mut().zip(&theirs.states) {
            let turned = body.orientation - state.pose.q.into_inner();
            assert!((body.position - state.pose.p).norm() < 1e-9);
            assert!((body.linear_velocity - state.v).norm() < 1e-8);
            assert!((body.angular_velocity - state.omega).norm() < 1e-8);
            // q + q' dt turns by 2 atan(φ/2) instead of φ = |ω| dt, too little by φ³/12 or less;
            // two quaternions are apart by half the angle.
            let lag = (state.omega.norm() * 0.01).powi(3) / 12.0;
            assert!(turned.norm() < 0.5 * lag + 1e-9);
            body.orientation = state.pose.q.into_inner();
        }
    }
}

fn simulation(scene: Scene) -> Simulation {
    Simulation::new(
        scene,
        solver::Registry::standard().entry("dantzig").unwrap().build(&solver::Options::default()),
    )
}

/// What is left of an error of 0.1 m after one step in one direction, with these parts of Code 7.
fn left(step: &WholeStep, joint: Joint) -> f64 {
    let mut world = world(vec![point(0.0, 0.0), point(1.1, 0.0)], vec![joint]);
    step.take(&mut world, DT).unwrap();
    (world.bodies[1].position.z - world.bodies[0].position.z - 1.0) / 0.1
}

#[test]
fn code_7_as_printed_feeds_errors_back_as_theory_says() {
    let near =
        |value: f64, theory: f64| assert!((value - theory).abs() < 1e-12, "{value} {theory}");
    let printed = WholeStep::PRINTED;
    let once = WholeStep { penalty: Form::Corrected, ..printed.clone() };
    let scaled = WholeStep { beta: Form::Corrected, ..printed.clone() };
    let both = [Some(0), Some(1)];
    near(left(&printed, Joint::rod([None, Some(1)], 1.0)), 1.0 - 0.1 * DT);
    near(left(&printed, Joint::rod(both, 1.0)), 1.0 - 0.2 * DT);
    near(left(&once, Joint::rod(both, 1.0)), 1.0 - 0.1 * DT);
    near(left(&scaled, Joint::rod(both, 1.0)), 0.8);
    near(left(&WholeStep::CORRECTED, Joint::rod(both, 1.0)), 0.9);
    // J of (34) and (44) with e = c: the error grows.
    let negative = Joint { jacobian: -1.0, ..Joint::rod(both, 1.0) };
    near(left(&printed, negative.clone()), 1.0 + 0.2 * DT);
    near(left(&printed, Joint { penalty: -1.0, ..negative }), 1.0 - 0.2 * DT);
}

#[test]
fn code_7_as_printed_glues_what_parts() {
    let contact = || vec![Joint::contact([None, Some(0)], 0.0)];
    let speed = |step: &WholeStep, joints| {
        let mut world = world(vec![point(0.0, 1.0)], joints);
        step.take(&mut world, DT).unwrap();
        world.bodies[0].linear_velocity.z
    };
    assert_eq!(speed(&WholeStep::PRINTED, contact()), 0.0);
    assert_eq!(speed(&WholeStep::CORRECTED, contact()), 1.0);
    // With the bound "λ ≥ 0" in the listing's own sign only J = −∂c/∂s lets the bodies separate.
    let bounded = WholeStep { limits: Limits::OfEachRow, ..WholeStep::PRINTED };
    assert_eq!(speed(&bounded, contact()), 0.0);
    assert_eq!(speed(&bounded, vec![Joint { jacobian: -1.0, ..contact().remove(0) }]), 1.0);
}

/// A row that says it is an equation is one for Code 7 with bounds by `IsEquality`; x in the
/// listing's sign.
#[test]
fn the_default_of_is_equality_releases_a_nail() {
    #[derive(Debug)]
    struct Equation(Joint);
    impl Constraint for Equation {
        fn dimension(&self) -> usize {
            self.0.dimension()
        }
        fn jacobian(&self, bodies: &[RigidBody], body: usize) -> Option<DMatrix<f64>> {
            self.0.jacobian(bodies, body)
        }
        fn penalty(&self, bodies: &[RigidBody]) -> DVector<f64> {
            self.0.penalty(bodies)
        }
        fn is_equality(&self) -> bool {
            true
        }
        fn bounds(&self) -> Vec<(f64, f64)> {
            self.0.bounds()
        }
    }
    let step = WholeStep { limits: Limits::ByIsEquality, ..WholeStep::PRINTED };
    let nail = || Joint::ball([None, Some(0)], [Vector3::zeros(); 2]);
    let constraints: [Box<dyn Constraint>; 2] = [Box::new(nail()), Box::new(Equation(nail()))];
    let fallen = constraints.map(|nail| {
        let mut world =
            World { bodies: vec![point(0.0, 0.0)], constraints: vec![nail], x: Vec::new() };
        for _ in 0..60 {
            weigh(&mut world.bodies);
            step.take(&mut world, DT).unwrap();
        }
        -world.bodies[0].position.z
    });
    assert!((fallen[0] - G * DT * DT * 1830.0).abs() < 1e-9);
    assert!(fallen[1].abs() < 1e-12);
}

/// A stack of two at rest, one sweep a frame: with x kept frame k has made k sweeps, else always
/// one.
#[test]
fn code_7_as_printed_starts_each_frame_from_nothing() {
    let push = DT * G;
    let sweeps = |start: Form| {
        let joints =
            vec![Joint::contact([None, Some(0)], 0.0), Joint::contact([Some(0), Some(1)], 1.0)];
        let mut world = world(vec![point(0.0, 0.0), point(1.0, 0.0)], joints);
        let step = WholeStep { start, sweeps: 1, feedback: 0.0, ..WholeStep::CORRECTED };
        let mut x = Vec::new();
        for _ in 0..3 {
            world.bodies = vec![point(0.0, 0.0), point(1.0, 0.0)];
            weigh(&mut world.bodies);
            step.take(&mut world, DT).unwrap();
            x.push(world.x[0] / push);
        }
        x
    };
    // A = [1 −1; −1 2], b = −dt g (1, 0): x₀ = 1 + x₁ and x₁ = x₀/2, so 1, 3/2, 7/4, … towards 2.
    for (ours, theory) in sweeps(Form::Corrected).iter().zip([1.0, 1.5, 1.75]) {
        assert!((ours - theory).abs() < 1e-12);
    }
    for ours in sweeps(Form::Printed) {
        assert!((ours - 1.0).abs() < 1e-12);
    }
}

/// Constraints of dimension 0 make J 0 × 6m: nothing stops, and the bodies fall.
#[test]
fn a_step_with_no_rows_is_a_fall() {
    let empty = Joint { axes: Vec::new(), ..Joint::rod([None, Some(0)], 0.0) };
    for step in [WholeStep::PRINTED, WholeStep::CORRECTED] {
        let mut world = world(vec![point(0.0, 0.0)], vec![empty.clone()]);
        weigh(&mut world.bodies);
        step.take(&mut world, DT).unwrap();
        assert!((world.bodies[0].linear_velocity.z + G * DT).abs() < 1e-15);
    }
}

/// A spinning body of moments 2, 3, 4 without torque: as printed ω never changes.
#[test]
fn code_7_as_printed_lacks_the_gyroscopic_torque() {
    let moments = Vector3::new(2.0, 3.0, 4.0);
    let mut body = point(0.0, 0.0);
    body.orientation = Quaternion::identity();
    body.angular_velocity = Vector3::new(0.5, 5.0, 0.5);
    body.inverse_inertia = Matrix3::from_diagonal(&moments.map(f64::recip));
    // −ω × I ω = ((I₂ − I₃) ω₂ ω₃, (I₃ − I₁) ω₃ ω₁, (I₁ − I₂) ω₁ ω₂)
    assert_eq!(body.gyroscopic_torque(), Vector3::new(-2.5, 0.5, -2.5));
    let step = WholeStep { early_return: Form::Corrected, ..WholeStep::PRINTED };
    let mut printed = world(vec![body.clone()], vec![]);
    step.take(&mut printed, 1e-3).unwrap();
    assert_eq!(printed.bodies[0].angular_velocity, body.angular_velocity);
}
