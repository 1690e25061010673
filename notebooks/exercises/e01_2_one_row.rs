//! Exercise 1.2: one row with two bounds.
//!
//! Find the x in [lo, hi] with: w > 0 only at x = lo, w < 0 only at x = hi, where w = a x + b and
//! a > 0.

/// The answer of the one-row problem.
pub fn answer(a: f64, b: f64, lo: f64, hi: f64) -> f64 {
    todo!()
}
