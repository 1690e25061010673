//! Why a motion cannot go on.

use lcplab::number::readable;
use lcplab::scene::{Integrator, Scene, Scheme};
use lcplab::simulation::{Cause, Simulation};
use lcplab::solver::{Options, Registry, Stop};

/// The shipped scene of this name at this level, changed.
fn simulation(name: &str, level: Scheme, change: impl FnOnce(&mut Scene)) -> Simulation {
    let mut scene = Scene::load(name).unwrap();
    scene.step.scheme = level;
    change(&mut scene);
    Simulation::new(
        scene,
        Registry::standard().entry("dantzig").unwrap().build(&Options::default()),
    )
}

/// Why it ends within a thousand steps.
fn cause(name: &str, level: Scheme, change: impl FnOnce(&mut Scene)) -> Cause {
    let mut simulation = simulation(name, level, change);
    (0..1000).find_map(|_| simulation.step().err()).expect("a failure").cause
}

#[test]
fn every_end_of_a_motion_is_reached_and_named_with_its_row_or_body() {
    let midpoint = |scene: &mut Scene| {
        scene.step.integrator = Integrator::ImplicitMidpoint;
        scene.step.dt = 1.0; // almost half of a period
    };
    let stopped = || {
        let stop = Stop::default();
        stop.raise();
        let mut pendulum = simulation("pendulum", Scheme::Velocity, |_| ());
        pendulum.step_before(&stop).unwrap_err().cause
    };
    let interrupted = || {
        let stop = Stop::default();
        let mut pendulum = simulation("pendulum", Scheme::Velocity, |_| ());
        stop.raise();
        pendulum.observed_step(&mut stop.watch(&mut ())).unwrap_err().cause
    };
    each_variant! { Cause:
        Cause::Undefined(_) =>
            cause("pendulum", Scheme::Velocity, |scene| scene.states[0].pose.p.x = 0.0),
            "constraints[0]: the two points coincide, so their distance has no direction";
        Cause::Problem(_) => // J'u = |v|²: beyond the largest number
            cause("pendulum", Scheme::Acceleration, |scene| scene.states[0].v.z = 1e200),
            "pendulum: distance world bob 0: its entries of A and b are too large for 64-bit numbers; check masses, \
             sizes, speeds, forces and dt";
        Cause::NoSolution { .. } => cause("painleve", Scheme::Acceleration, |_| ()),
            "no forces satisfy the sliding contact \"normal ground rod 0 at face 0 on vertex 1\"";
        Cause::Unsettled { change } => cause("pendulum", Scheme::Acceleration, midpoint),
            format!("the implicit midpoint iteration does not converge; its rates change by {}", readable(*change, 2));
        Cause::Stopped(Some(_)) => stopped(), "interrupted";
        Cause::Stopped(None) => interrupted(), "stopped by the observer";
        Cause::Diverged { row: Some(_), .. } => // 1000/s is far beyond what steps of 0.01 s can follow
            cause("pendulum", Scheme::Acceleration, |scene| scene.step.alpha = 1000.0),
            "\"bob\" diverged; the row with the largest impulse on it is \"distance world bob 0\"";
        Cause::Diverged { row: None, .. } =>
            cause("sphere_plane", Scheme::Velocity, |scene| {
                scene.contact.margin = Some(0.05); // so that the ground is not seen
                (scene.states[1].pose.p.z, scene.states[1].v.z) = (1e3, 1e9);
            }),
            "\"ball\" diverged; no contact or joint impulse acts on it";
    }
}
