//! The gap up to which contacts of two bodies are detected.
//!
//! A step at velocity level needs every gap that may close within it. The gap of two bodies
//! decreases by at most
//!
//! ```text
//! dt v,   v = |v1 − v0| + |ω0| r0 + |ω1| r1
//! ```
//!
//! with r the distance of a body's farthest vertex from its center (0 for a ball, which rotates in
//! place). For each body both the velocity at the beginning of the step and that after its forces
//! are considered, because one body may be held while the other falls.

use nalgebra::Vector3;

use crate::body::{Mass, Shape, State, angular, linear};
use crate::scene::{Scene, Scheme};

/// The minimum margin (m) if the margin depends on the speed.
pub(super) const LEAST: f64 = 0.05;

/// The gap up to which contacts are detected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// The same (m) for all pairs of bodies.
    Gap(f64),
    /// The distance that the two bodies of a pair can approach each other in a step, at least 0.05
    /// m.
    Step,
}

impl Reach {
    /// The reach for a scene's steps: at acceleration level the gap at which contacts touch;
    /// otherwise the margin of the scene or, without one, the distance from the speeds.
    pub(crate) fn of_step(scene: &Scene) -> Self {
        match (scene.step.scheme, scene.contact.margin) {
            (Scheme::Acceleration, _) => Reach::Gap(scene.resting().gap),
            (_, Some(margin)) => Reach::Gap(margin),
            (_, None) => Reach::Step,
        }
    }

    /// The gap (m) for a pair of bodies, given the distance (m) of each one's farthest vertex from
    /// its center.
    pub(super) fn of_pair(self, scene: &Scene, states: &[State], pair: [Site; 2]) -> f64 {
        match self {
            Reach::Gap(gap) => gap,
            Reach::Step => {
                let [a, b] = pair.map(|site| velocities(scene, states, site.body));
                // One may be held while the other falls.
                let both = a.iter().flat_map(|a| b.iter().map(move |b| (b - a).norm()));
                let approach = both.fold(0.0, f64::max);
                let turning = turning(scene, states, pair[0], pair[1])
                    + turning(scene, states, pair[1], pair[0]);
                LEAST.max(scene.step.dt * (approach + turning))
            }
        }
    }

    /// Half of the gap (m) for a single body: the sum of the halves of two bodies is at least the
    /// gap of the pair.
    pub(super) fn of_body(self, scene: &Scene, states: &[State], site: Site) -> f64 {
        match self {
            Reach::Gap(gap) => gap / 2.0,
            Reach::Step => {
                let [before, after] = velocities(scene, states, site.body).map(|v| v.norm());
                let turning = fastest_turning(scene, states, site.body) * site.arm;
                (LEAST / 2.0).max(scene.step.dt * (before.max(after) + turning))
            }
        }
    }
}

/// A body, with the distance (m) of its farthest vertex from its center.
#[derive(Debug, Clone, Copy)]
pub(super) struct Site {
    pub body: usize,
    pub arm: f64,
}

/// The velocity (m/s) of a body's center now, and after the forces of a step.
fn velocities(scene: &Scene, states: &[State], body: usize) -> [Vector3<f64>; 2] {
    [states[body].v, after_forces(scene, states, body)[0]]
}

/// The larger of the angular speeds (rad/s) of a body now and after the forces of a step.
fn fastest_turning(scene: &Scene, states: &[State], body: usize) -> f64 {
    states[body].omega.norm().max(after_forces(scene, states, body)[1].norm())
}

/// The velocities (m/s, rad/s) of a body after its weight and own force have acted for a step.
pub(super) fn after_forces(scene: &Scene, states: &[State], body: usize) -> [Vector3<f64>; 2] {
    let (own, State { pose, v, omega }, dt) = (&scene.bodies[body], &states[body], scene.step.dt);
    let wrench = own.wrench(pose);
    match own.mass {
        Mass::Fixed => [*v, *omega],
        Mass::Point { mass } => [v + dt * (scene.gravity + linear(&wrench) / mass), *omega],
        Mass::Rigid { mass, moments } => {
            let turned = pose.q.inverse() * angular(&wrench);
            let spin = pose.q * turned.component_div(&moments);
            [v + dt * (scene.gravity + linear(&wrench) / mass), omega + dt * spin]
        }
    }
}

/// The speed (m/s) at which rotation moves a body's surface towards another body. A half space that
/// rotates about its normal has none.
fn turning(scene: &Scene, states: &[State], own: Site, other: Site) -> f64 {
    let State { pose, omega, .. } = &states[own.body];
    match &scene.bodies[own.body].shape {
        Shape::Plane { normal } => {
            let n = pose.direction(normal);
            let tilting = omega - n * n.dot(omega);
            tilting.norm() * ((states[other.body].pose.p - pose.p).norm() + other.arm)
        }
        _ => fastest_turning(scene, states, own.body) * own.arm,
    }
}
