//! Where bodies are between the beginning and the end of a step.
//!
//! ```text
//! p(θ) = p₀ + θ h v₀ + θ² (p₁ − p₀ − h v₀),   0 ≤ θ ≤ 1,   and the angle likewise
//! ```
//!
//! is the path of Euler's methods under constant acceleration, and meets the ends of any other.

use nalgebra::UnitQuaternion;

use crate::body::{Pose, State};
use crate::scene::Scene;

/// The maximum number of samples of a path.
const MOST_SAMPLES: usize = 256;

/// How many samples a path needs so that no body moves by more than half of the thinnest one in
/// between.
pub(super) fn samples(scene: &Scene, before: &[State], after: &[State]) -> usize {
    let way = |(a, b): (&State, &State)| (b.pose.p - a.pose.p).norm();
    let longest = before.iter().zip(after).map(way).fold(0.0, f64::max);
    let stride = scene.thinnest().map_or(f64::INFINITY, |thickness| 0.5 * thickness);
    ((longest / stride).ceil() as usize).clamp(1, MOST_SAMPLES)
}

/// The state at a part of the way between two, h (s) apart; the velocity is the earlier one.
pub(super) fn between(a: &State, b: &State, h: f64, theta: f64) -> State {
    let curve = |first, way| h * theta * first + theta * theta * (way - h * first);
    let turn = (b.pose.q * a.pose.q.inverse()).scaled_axis();
    let angle = UnitQuaternion::from_scaled_axis(curve(a.omega, turn));
    let pose = Pose { p: a.pose.p + curve(a.v, b.pose.p - a.pose.p), q: angle * a.pose.q };
    State { pose, ..*a }
}
