//! Exercise 4.1: one sweep of projected Gauss-Seidel.
//!
//! Take the rows from first to last. With the newest x, w_i is the sum of a[i][j] x[j] over all j,
//! plus b[i]. Move x[i] to where w_i is 0, but not out of [lo[i], hi[i]], before the next row is
//! looked at.

/// x after one sweep.
pub fn answer(a: &[Vec<f64>], b: &[f64], lo: &[f64], hi: &[f64], mut x: Vec<f64>) -> Vec<f64> {
    todo!()
}
