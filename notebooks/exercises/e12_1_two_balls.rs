//! Exercise 12.1: two balls collide.
//!
//! Ball 0 is on the left, ball 1 on the right; velocities count to the right. If they approach,
//! they part with the part e of that speed, and momentum stays. If they do not approach, nothing
//! happens.

/// The velocities after the impact.
pub fn answer(m: [f64; 2], v: [f64; 2], e: f64) -> [f64; 2] {
    todo!()
}
