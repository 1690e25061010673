//! Exercise 8.1: the scaled residual of a whole problem.
//!
//! The lesson has a program for contacts. Write it for rows with any bounds, ±∞ among them. Row i
//! alone would like to have the impulse x[i] - w[i] / a[i][i], and gets the nearest one to that in
//! [lo[i], hi[i]]. How far is that from x[i]? Turn this impulse into a velocity, and divide it by
//! the velocities of which w[i] is the sum, all counted as positive. The largest of these quotients
//! counts; a row for which the divisor is 0 counts 0. Other units must not change the answer.

/// The scaled residual of x.
pub fn answer(a: &[Vec<f64>], b: &[f64], lo: &[f64], hi: &[f64], x: &[f64]) -> f64 {
    todo!()
}
