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
//! itself). v1 − v0 is that at the beginning of the step or that after the forces of the step,
//! whichever is larger.

use nalgebra::Vector3;

use crate::body::{Mass, Shape, State};
use crate::scene::{Scene, Scheme};

/// The least margin (m) where it follows the speed.
const LEAST: f64 = 0.05;

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
                let approach = [0, 1].map(|k| (b[k] - a[k]).norm());
                let turning = turning(scene, states, pair[0], pair[1])
                    + turning(scene, states, pair[1], pair[0]);
                LEAST.max(scene.step.dt * (approach[0].max(approach[1]) + turning))
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
                let turning = states[site.body].omega.norm() * site.arm;
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
    let (own, v) = (&scene.bodies[body], states[body].v);
    let change = match own.mass {
        Mass::Fixed => Vector3::zeros(),
        Mass::Point { mass } | Mass::Rigid { mass, .. } => scene.gravity + own.force / mass,
    };
    [v, v + scene.step.dt * change]
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
        _ => omega.norm() * own.arm,
    }
}
