//! Up to which gap the contacts of two bodies are found.
//!
//! A step at velocity level must know of every gap that may close within it. The gap of two bodies
//! shrinks by no more than
//!
//! ```text
//! dt v,   v = |v1 − v0| + |ω0| r0 + |ω1| r1
//! ```
//!
//! with r the distance of a body's farthest vertex from its centre (0 of a ball: it turns in
//! itself). For each body the velocity at the beginning of the step and the one after its forces
//! are tried, because one body may be held while the other one falls.

use nalgebra::Vector3;

use crate::body::{Mass, Shape, State, angular, linear};
use crate::scene::{Scene, Scheme};

/// The least margin (m) where it follows the speed.
pub(super) const LEAST: f64 = 0.05;

/// Up to which gap contacts are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// The same (m) for all pairs of bodies.
    Gap(f64),
    /// As far as the two bodies of a pair can approach each other in a step, and at least 0.05 m.
    Step,
}

impl Reach {
    /// That of a scene's steps: the gap at which contacts touch at acceleration level, else the
    /// margin that the scene states, else what follows from the speeds.
    pub fn of_step(scene: &Scene) -> Self {
        match (scene.step.scheme, scene.contact.margin) {
            (Scheme::Acceleration, _) => Reach::Gap(scene.resting().gap),
            (_, Some(margin)) => Reach::Gap(margin),
            (_, None) => Reach::Step,
        }
    }

    /// The gap (m) of a pair of bodies, with the distance (m) of the farthest vertex of each from
    /// its centre.
    pub(super) fn of_pair(self, scene: &Scene, states: &[State], pair: [Site; 2]) -> f64 {
        match self {
            Reach::Gap(gap) => gap,
            Reach::Step => {
                let [a, b] = pair.map(|site| velocities(scene, states, site.body));
                // One may be held where the other falls.
                let both = a.iter().flat_map(|a| b.iter().map(move |b| (b - a).norm()));
                let approach = both.fold(0.0, f64::max);
                let turning = turning(scene, states, pair[0], pair[1])
                    + turning(scene, states, pair[1], pair[0]);
                LEAST.max(scene.step.dt * (approach + turning))
            }
        }
    }

    /// Half of the gap (m) for a body by itself: the halves of two bodies are no less than the gap
    /// of both.
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

/// A body, and how far (m) its farthest vertex is from its centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct Site {
    pub body: usize,
    pub arm: f64,
}

/// The velocity (m/s) of a body's centre now, and after the forces of a step.
fn velocities(scene: &Scene, states: &[State], body: usize) -> [Vector3<f64>; 2] {
    [states[body].v, after_forces(scene, states, body)[0]]
}

/// The speed (rad/s) at which a body turns now or after the forces of a step, whichever is larger.
fn fastest_turning(scene: &Scene, states: &[State], body: usize) -> f64 {
    states[body].omega.norm().max(after_forces(scene, states, body)[1].norm())
}

/// The velocities (m/s, rad/s) of a body after its weight and its own force have acted for a step.
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

/// How fast (m/s) a body's surface approaches another body by turning. A half space that turns
/// about its normal does not.
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
