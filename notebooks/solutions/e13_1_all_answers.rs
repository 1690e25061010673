//! Exercise 13.1: all answers of a one-row LCP.
//!
//! w = a x + b, x ≥ 0, w ≥ 0, x w = 0. Neither a nor b is 0, but a may be negative, as on
//! Painlevé's rod: then there may be two answers, or none.

/// All x that solve it, in any order.
pub fn answer(a: f64, b: f64) -> Vec<f64> {
    let mut all = Vec::new();
    if b > 0.0 {
        all.push(0.0);
    }
    if -b / a > 0.0 {
        all.push(-b / a);
    }
    all
}
