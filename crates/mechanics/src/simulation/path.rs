//! Where bodies are between the beginning and the end of a step, and what they went through on the way.
//!
//! ```text
//! p(θ) = p₀ + θ h v₀ + θ² (p₁ − p₀ − h v₀),   0 ≤ θ ≤ 1,   and the angle likewise
//! ```
//!
//! is the path of Euler's methods under constant acceleration, and meets the ends of any other.

use std::collections::BTreeSet;

use nalgebra::UnitQuaternion;

use crate::body::{Pose, State};
use crate::scene::{Detector, Found, Scene};

/// A path is looked at no more often than this.
const MOST_LOOKS: usize = 256;

/// How often to look at a path so that no body moves by more than half of the thinnest one in between.
pub(super) fn looks(scene: &Scene, before: &[State], after: &[State]) -> usize {
    let way = |(a, b): (&State, &State)| (b.pose.p - a.pose.p).norm();
    let longest = before.iter().zip(after).map(way).fold(0.0, f64::max);
    let stride = scene.thinnest().map_or(f64::INFINITY, |thickness| 0.5 * thickness);
    ((longest / stride).ceil() as usize).clamp(1, MOST_LOOKS)
}

/// The pairs of bodies of which one went through the other within the step, of h (s): they overlap on the
/// way, and neither touch at its beginning nor overlap at its end.
pub(super) fn passages(
    scene: &Scene,
    before: &[State],
    after: &[State],
    found: &[Found],
    h: f64,
) -> Vec<[usize; 2]> {
    let looks = looks(scene, before, after);
    if looks == 1 {
        return Vec::new();
    }
    let mut detector = Detector::new(scene);
    let mut overlapping = |states: &[State]| -> BTreeSet<[usize; 2]> {
        detector.find(scene, states, 0.0).iter().map(|found| found.id.bodies).collect()
    };
    let mut passed = BTreeSet::new();
    for look in 1..looks {
        let theta = look as f64 / looks as f64;
        let ends = before.iter().zip(after);
        let states: Vec<State> = ends.map(|(a, b)| between(a, b, h, theta)).collect();
        passed.extend(overlapping(&states));
    }
    let at_end = overlapping(after);
    let touched = |pair: &[usize; 2]| found.iter().any(|found| found.id.bodies == *pair);
    passed.into_iter().filter(|pair| !touched(pair) && !at_end.contains(pair)).collect()
}

/// The state at a part of the way between two, h (s) apart; the velocity is the earlier one.
pub(super) fn between(a: &State, b: &State, h: f64, theta: f64) -> State {
    let curve = |first, way| h * theta * first + theta * theta * (way - h * first);
    let turn = (b.pose.q * a.pose.q.inverse()).scaled_axis();
    let angle = UnitQuaternion::from_scaled_axis(curve(a.omega, turn));
    let pose = Pose { p: a.pose.p + curve(a.v, b.pose.p - a.pose.p), q: angle * a.pose.q };
    State { pose, ..*a }
}
