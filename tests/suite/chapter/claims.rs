//! Claims of the chapter that the other tests do not measure on their way.

use lcplab::simulation::Simulation;
use std::ops::ControlFlow;

use lcplab::body::State;
use lcplab::scene::Scene;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// T12: a stack held by a global method stands at every step from 1/240 s to 1/30 s.
#[test]
fn a_stack_stands_at_large_steps() {
    for rate in [240.0, 120.0, 60.0, 30.0] {
        let mut scene = Scene::load("stack").unwrap();
        scene.step.dt = 1.0 / rate;
        let mut stack = Simulation::of(&scene).unwrap();
        let recording = stack.run(rate as usize, |_| ControlFlow::Continue(()));
        assert!(recording.failure.is_none());
        for (before, after) in scene.states.iter().zip(stack.states()) {
            assert!((before.pose.p - after.pose.p).norm() < 1e-6, "1/{rate} s");
        }
        assert!(recording.motion.iter().all(|motion| motion.kinetic < 1e-9), "1/{rate} s");
    }
}

/// T41: without normalization the norm of the quaternion grows by √(1 + (ω dt/2)²) a step.
#[test]
fn a_quaternion_that_is_not_normalized_grows() {
    let (dt, steps) = (0.01_f64, 1000);
    let omega = Vector3::new(2.0, -3.0, 6.0); // 7 rad/s
    let state = State { omega, ..State::WORLD };
    let mut q = Quaternion::identity();
    for _ in 0..steps {
        q += Quaternion::from_imag(omega) * q * (0.5 * dt);
    }
    let growth = (1.0 + (3.5 * dt).powi(2)).powf(0.5 * f64::from(steps));
    assert!((q.norm() / growth - 1.0).abs() < 1e-12);
    // The library's step keeps the norm and turns by |ω| t, here farther than the normalized q:
    // each of its steps turns by 2 atan(|ω| dt/2) only.
    let turned = (0..steps).fold(state, |state, _| state.advanced(dt)).pose.q;
    assert!((turned.norm() - 1.0).abs() < 1e-12);
    let lag = f64::from(steps) * (7.0 * dt - 2.0 * (3.5 * dt).atan());
    assert!((turned.angle_to(&UnitQuaternion::new_normalize(q)) - lag).abs() < 1e-10, "{lag}");
}

/// T44: the fewer sweeps a chain of rods is given, the farther it stretches.
#[test]
fn rods_stretch_when_sweeps_are_few() {
    let stretch = |sweeps: usize| {
        let mut scene = Scene::load("chain").unwrap();
        scene.solver.name = "pgs".into();
        scene.solver.max_iterations = sweeps;
        let mut chain = Simulation::of(&scene).unwrap();
        let recording = chain.run(200, |_| ControlFlow::Continue(()));
        recording.motion.iter().map(|motion| motion.drift).fold(0.0, f64::max)
    };
    // From 16 sweeps on only the drift of the step itself is left, 16 mm.
    let stretches = [1, 4, 16].map(stretch);
    assert!(stretches.is_sorted_by(|few, more| *few > 1.25 * more), "{stretches:?}");
}
