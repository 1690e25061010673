//! Motions that cannot continue report where and why, and keep their results.

use std::ops::ControlFlow;

use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::Cause;

use super::{scene, simulation};

#[test]
fn ends_of_a_rod_that_meet_are_named() {
    let mut pendulum = scene("pendulum", Scheme::Velocity);
    pendulum.states[0].pose.p.x = 0.0;
    let failure = simulation(pendulum).step().unwrap_err();
    assert_eq!(
        failure.to_string(),
        "step 1, at 0 s: constraints[0]: the two points coincide, so their distance has no direction"
    );
}

#[test]
fn a_diverging_motion_stops_with_its_step_its_body_and_its_row() {
    // α = 1000/s is far beyond what a step of 0.01 s can follow.
    let mut pendulum = scene("pendulum", Scheme::Acceleration);
    pendulum.step.alpha = 1000.0;
    let recording = simulation(pendulum).run(1000, |_| ControlFlow::Continue(()));
    let failure = recording.failure.unwrap();
    assert_eq!(recording.motion.len(), failure.step); // the start and every good step
    let Cause::Diverged { body, row } = failure.cause else { panic!("{failure}") };
    assert_eq!((body.as_str(), row.as_deref()), ("bob", Some("distance world bob 0")));
}

#[test]
fn a_run_ends_where_the_watcher_wants() {
    let mut ball = simulation(scene("sphere_plane", Scheme::Velocity));
    let recording = ball.run(50, |step| match step.number {
        7 => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    assert_eq!(recording.motion.len(), 8);
    assert!(recording.failure.is_none());
}

#[test]
fn the_same_scene_moves_the_same_to_the_last_bit() {
    let run = || {
        let mut stack = simulation(scene("double_pendulum", Scheme::Velocity));
        format!("{:?}", stack.run(200, |_| ControlFlow::Continue(())).motion)
    };
    assert_eq!(run(), run());
}

#[test]
fn an_empty_scene_takes_steps() {
    let mut empty = simulation(Scene::from_toml("empty.toml", "").unwrap());
    assert_eq!(empty.step().unwrap().number, 1);
}
