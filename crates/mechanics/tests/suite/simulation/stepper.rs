//! The fast step compared with the plain one: the same motion, up to rounding.

use std::sync::{Arc, Mutex};

use lcplab_lcp::Lcp;
use lcplab_lcp::friction::Model;
use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::{Scene, Scheme, catalogue};
use lcplab_mechanics::simulation::stepper::{Kernel, Part, Stepper};
use lcplab_mechanics::simulation::{Cause, Simulation};
use lcplab_solver::{Observer, Pgs, Settings, Solution, Solver, Start, Status};

use super::{assert_near, changed, scene};

/// Too few for most scenes: the remaining error is passed on from step to step, and must be the
/// same.
const SWEEPS: usize = 6;

/// Gauss-Seidel that does all its sweeps.
fn pgs() -> Box<dyn Solver> {
    let settings = Settings::default()
        .with_tolerance(0.0)
        .with_max_iterations(SWEEPS)
        .with_check_every(SWEEPS);
    Box::new(Pgs { settings, ..Pgs::default() })
}

/// The same in an order that is set before each solve.
struct InOrder(Arc<Mutex<Vec<usize>>>);

impl Solver for InOrder {
    fn name(&self) -> &str {
        "in order"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, _: &mut dyn Observer) -> Solution {
        let mut x = start.x.map_or(vec![0.0; lcp.len()], <[f64]>::to_vec);
        for _ in 0..SWEEPS {
            for &i in &*self.0.lock().unwrap() {
                let unclamped = x[i] - lcp.row_w(i, &x) / lcp.matrix().diagonal(i);
                x[i] = lcp.project(i, unclamped, &x);
            }
        }
        Solution::new(lcp, x, Status::IterationLimit, SWEEPS)
    }
}

fn velocity_level(name: &str) -> Scene {
    scene(name, Scheme::Velocity)
}

/// The largest difference between any numbers of the states.
fn difference(a: &[State], b: &[State]) -> f64 {
    let one = |(a, b): (&State, &State)| {
        let turn = (a.pose.q.coords - b.pose.q.coords).amax();
        let moves = (a.pose.p - b.pose.p).amax().max((a.v - b.v).amax());
        turn.max(moves).max((a.omega - b.omega).amax())
    };
    a.iter().zip(b).map(one).fold(0.0, f64::max)
}

/// Both take this number of steps; after each the difference is below the tolerance.
fn go_together(scene: Scene, kernel: Kernel, steps: usize, tolerance: f64) {
    let order = Arc::new(Mutex::new(Vec::new()));
    let solver = match kernel {
        Kernel::RowByRow => pgs(),
        Kernel::SimdPairs { .. } => Box::new(InOrder(order.clone())),
    };
    let mut stepper = Stepper::new(scene.clone(), SWEEPS, kernel).unwrap();
    let mut simulation = Simulation::new(scene, solver);
    for step in 1..=steps {
        stepper.step().unwrap();
        *order.lock().unwrap() = stepper.order();
        let plain = simulation.step().unwrap();
        assert_eq!(stepper.found().len(), plain.contacts.len());
        let apart = difference(stepper.states(), simulation.states());
        let name = &stepper.scene().name;
        assert!(apart < tolerance, "{name}, step {step}: {apart:.1e}");
    }
    assert_near(stepper.time(), simulation.time(), 1e-15);
}

/// For the four thousand rows of a net or a tower, few steps are enough.
fn steps(name: &str) -> usize {
    if ["tower", "net", "stack50"].contains(&name) { 2 } else { 12 }
}

/// All shipped scenes except those that the stepper rejects, and those where six sweeps are so few
/// that the motion is chaotic and rounding grows.
#[test]
fn the_stepper_moves_every_shipped_scene_as_a_simulation_by_pgs_does() {
    let yields = ["rush", "spring", "spring_damped"];
    for shipped in catalogue::SHIPPED {
        let scene = velocity_level(shipped.name);
        if yields.contains(&shipped.name) {
            assert!(Stepper::new(scene, SWEEPS, Kernel::RowByRow).is_err(), "{}", shipped.name);
            continue;
        }
        go_together(scene, Kernel::RowByRow, steps(shipped.name), 1e-9);
    }
}

#[test]
fn eight_pairs_move_as_a_simulation_by_pgs_in_their_order_does() {
    for name in ["stack", "pyramid", "chain", "net", "sphere_net", "ragdoll", "arch", "cradle"] {
        let kernel = Kernel::SimdPairs { threads: 1 };
        go_together(velocity_level(name), kernel, steps(name), 1e-9);
    }
}

#[test]
fn any_number_of_threads_moves_with_the_same_bits() {
    for name in ["pyramid", "sphere_net", "dominoes"] {
        let run = |threads| {
            let kernel = Kernel::SimdPairs { threads };
            let mut stepper = Stepper::new(velocity_level(name), SWEEPS, kernel).unwrap();
            (0..30).for_each(|_| stepper.step().unwrap());
            (stepper.states().to_vec(), stepper.x().to_vec())
        };
        let alone = run(1);
        for threads in 2..=4 {
            assert_eq!(run(threads), alone, "{name} on {threads} threads");
        }
    }
}

#[test]
fn a_run_from_the_start_again_is_the_same_run() {
    for name in ["pyramid", "cradle"] {
        let kernel = Kernel::SimdPairs { threads: 2 };
        let mut stepper = Stepper::new(velocity_level(name), SWEEPS, kernel).unwrap();
        let mut run = || {
            stepper.restart();
            (0..20).for_each(|_| stepper.step().unwrap());
            (stepper.states().to_vec(), stepper.x().to_vec(), stepper.time())
        };
        assert_eq!(run(), run());
    }
}

/// A ball that falls from rest hits at −v and leaves with e v.
#[test]
fn a_ball_bounces_with_its_coefficient_of_restitution() {
    let scene = velocity_level("bouncing_ball");
    let (e, dt, g) = (scene.contact.restitution, scene.step.dt, scene.gravity.norm());
    let ball = scene.bodies.iter().position(|body| body.mass.mass() > 0.0).unwrap();
    let mut stepper = Stepper::new(scene, SWEEPS, Kernel::RowByRow).unwrap();
    let mut before = 0.0;
    while stepper.states()[ball].v.z <= 0.0 {
        before = stepper.states()[ball].v.z;
        stepper.step().unwrap();
    }
    assert!(before < -10.0 * g * dt);
    assert_near(stepper.states()[ball].v.z, -e * before, 1e-12);
}

#[test]
fn contacts_that_forget_start_from_nothing_in_every_step() {
    let forget = changed("persistence", &[("\"features\"", "\"none\"")]);
    go_together(forget, Kernel::RowByRow, 10, 1e-9);
}

#[test]
fn what_the_stepper_does_not_do_it_says() {
    let refused = |scene: Scene| match Stepper::new(scene, SWEEPS, Kernel::RowByRow) {
        Ok(_) => panic!("it was taken"),
        Err(error) => error.to_string(),
    };
    let scheme = refused(scene("stack", Scheme::Xpbd));
    assert_eq!(
        scheme,
        "stack: step.scheme: the stepper supports only the velocity level, not xpbd"
    );
    let mut cone = velocity_level("stack");
    cone.contact.model = Model::CoulombCone;
    assert_eq!(refused(cone), "stack: contact.model: the stepper supports only the coupled box");
    let spring = refused(velocity_level("spring"));
    assert_eq!(spring, "spring: constraints[0]: the stepper does not support compliant rows");
}

#[test]
fn a_step_that_cannot_be_taken_leaves_the_states_and_names_the_row() {
    let mut scene = velocity_level("pendulum");
    let bob = scene.body("bob").unwrap();
    scene.states[bob].v = [1e12; 3].into();
    let mut stepper = Stepper::new(scene.clone(), SWEEPS, Kernel::RowByRow).unwrap();
    let failure = stepper.step().unwrap_err();
    let Cause::Diverged { body, row: Some(row) } = &failure.cause else { panic!("{failure}") };
    assert_eq!((body.as_str(), row.starts_with("distance")), ("bob", true), "{row}");
    assert_eq!((failure.step, stepper.states()), (1, &scene.states[..]));
}

#[test]
fn the_parts_of_a_step_come_in_their_order() {
    let mut parts = Vec::new();
    let mut stepper = Stepper::new(velocity_level("stack"), SWEEPS, Kernel::RowByRow).unwrap();
    stepper.watched_step(&mut |part| parts.push(part)).unwrap();
    assert_eq!(parts, Part::ALL);
}
