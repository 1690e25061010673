//! Exercise 10.1: leaving the circle.
//!
//! A bob on a circle of radius l (m) moves at the speed v (m/s) along the tangent for a time dt
//! (s). How much farther from the center is it then? Exactly, please, not only for short steps.

/// How much the distance has grown (m).
pub fn answer(l: f64, v: f64, dt: f64) -> f64 {
    l.hypot(v * dt) - l
}
