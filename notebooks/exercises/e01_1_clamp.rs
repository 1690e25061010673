//! Exercise 1.1: the projection onto an interval.
//!
//! An impulse x is kept between its bounds by Π(x): the value in [lo, hi] that is nearest to x.
//! lo may be −∞ and hi may be +∞.

/// The value in [lo, hi] nearest to x.
pub fn answer(x: f64, lo: f64, hi: f64) -> f64 {
    todo!()
}
