//! Thresholds for resting contacts at acceleration level, derived from the scene.
//!
//! A force requires a contact that touches, c ≤ slop, and does not separate, ċ ≤ v_slop. Both
//! thresholds must be positive because the numbers are never exact; if they are too small, a
//! contact is lost and the body falls until it hits again. A body that separates so slowly that it
//! would fall back within the step has not separated:
//!
//! ```text
//! a = max |g + f/m|,   v_slop = 2 a dt,   slop = a dt², at most 1/1000 of the smallest body
//! ```
//!
//! A body that would bounce off with less than a dt/2, and so would return within the step, does
//! not bounce; otherwise it would bounce forever, step by step.

use super::Scene;
use crate::body::Shape;

/// The gap threshold is at most this fraction of the smallest body.
const OF_SIZE: f64 = 1e-3;
/// If nothing falls, a body is assumed to fall by this fraction of the smallest one in a step.
const WITHOUT_WEIGHT: f64 = 1e-6;

/// The thresholds for resting contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resting {
    /// The gap (m) up to which it touches.
    pub gap: f64,
    /// The separation speed (m/s) up to which it stays in contact.
    pub speed: f64,
    /// The speed (m/s) below which a bounce would end within the step.
    pub bounce: f64,
}

impl Resting {
    /// The values of the scene, or those derived from it.
    pub(super) fn of(scene: &Scene) -> Self {
        let (dt, contact) = (scene.step.dt, &scene.contact);
        let moving = scene.bodies.iter().filter(|body| body.mass.mass() > 0.0);
        let accelerations =
            moving.map(|body| (scene.gravity + body.force / body.mass.mass()).norm());
        let size = scene.thinnest().unwrap_or(1.0);
        let acceleration = match accelerations.fold(0.0, f64::max) {
            0.0 => WITHOUT_WEIGHT * size / (dt * dt),
            acceleration => acceleration,
        };
        Resting {
            gap: contact.resting_gap.unwrap_or((acceleration * dt * dt).min(OF_SIZE * size)),
            speed: contact.resting_speed.unwrap_or(2.0 * acceleration * dt),
            bounce: 0.5 * acceleration * dt,
        }
    }
}

/// The thickness of a shape (m), if it has one.
pub(crate) fn size(shape: &Shape) -> Option<f64> {
    match shape {
        Shape::Point | Shape::Plane { .. } => None,
        Shape::Sphere { radius } | Shape::Capsule { radius, .. } => Some(2.0 * radius),
        Shape::Box { half } => Some(2.0 * half.min()),
        Shape::Compound(parts) => {
            parts.iter().filter_map(|part| size(&part.shape)).reduce(f64::min)
        }
        Shape::Hull(hull) => {
            let deepest = hull.faces.iter().map(|face| {
                let heights = hull.vertices.iter().map(|v| face.normal.dot(v));
                heights.clone().fold(f64::MIN, f64::max) - heights.fold(f64::MAX, f64::min)
            });
            deepest.reduce(f64::min)
        }
    }
}
