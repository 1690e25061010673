//! Exercise 5.3: the ratio test.
//!
//! When the entering variable rises to t, basic variable r has the value constant[r] + rate[r] t. All constants are
//! positive; no variable may become negative.

/// The row whose variable becomes 0 first; `None` if none ever does: a ray.
pub fn answer(constant: &[f64], rate: &[f64]) -> Option<usize> {
    todo!()
}
