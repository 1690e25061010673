//! The constraint of `examples/own_constraint.rs`, as a user would verify it.

#[path = "../../examples/own_constraint.rs"]
mod example;

use std::f64::consts::PI;
use std::sync::Arc;

use example::Bowl;
use lcplab::body::{Pose, State};
use lcplab::constraint::verify;
use lcplab::scene::{Scene, Scheme};
use lcplab::simulation::Simulation;
use lcplab::solver::Dantzig;
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

use lcplab_testing::cases;

fn state() -> impl Strategy<Value = State> {
    proptest::array::uniform12(-3.0..3.0).prop_map(|x| {
        let [p, turn, v, omega] = [0, 3, 6, 9].map(|k| Vector3::new(x[k], x[k + 1], x[k + 2]));
        State { pose: Pose { p, q: UnitQuaternion::from_scaled_axis(turn) }, v, omega }
    })
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn a_users_constraint_matches_dual_numbers(body in state(), curvature in 0.1..10.0) {
        prop_assert_eq!(verify(&Bowl(curvature), [&State::WORLD, &body]), Ok(()));
    }
}

#[test]
fn the_example_runs() {
    example::main().unwrap();
}

#[test]
fn circles_in_a_bowl_take_the_same_time_at_any_height() {
    // ω² r = g tan of the slope = g κ r: 2π/√(g κ), whatever r.
    let curvature = 4.0 * PI * PI / 9.81; // a second
    for radius in [0.1, 0.7] {
        let missed = |dt: f64| {
            let mut scene = Scene::load("pendulum").unwrap();
            scene.constraints = vec![Arc::new(Bowl(curvature))];
            let height = 0.5 * curvature * (radius * radius - 1.0);
            scene.states[0].pose.p = Vector3::new(radius, 0.0, height);
            scene.states[0].v = Vector3::y() * (2.0 * PI * radius);
            (scene.step.dt, scene.step.scheme) = (dt, Scheme::Acceleration);
            let mut bead = Simulation::new(scene, Box::new(Dantzig::default()));
            for _ in 0..(1.0 / dt).round() as usize {
                bead.step().unwrap();
            }
            let p = bead.states()[0].pose.p;
            p.y.atan2(p.x).abs()
        };
        let (coarse, fine) = (missed(2e-3), missed(1e-3));
        assert!(coarse < 0.05 && fine < 0.6 * coarse, "{radius}: {coarse} {fine}");
    }
}
