//! Exercise 7.1: Murty's least-index rule.
//!
//! Given the point of an active set: free rows have w = 0, the others x = 0. A row is wrong if its
//! x or its w is negative.

/// The row that changes sides next; `None` if no row is wrong.
pub fn answer(x: &[f64], w: &[f64]) -> Option<usize> {
    (0..x.len()).find(|&i| x[i] < 0.0 || w[i] < 0.0)
}
