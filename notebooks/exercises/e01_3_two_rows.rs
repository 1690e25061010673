//! Exercise 1.3: two rows, by trying the four cases.
//!
//! Find x ≥ 0 with w = A x + b ≥ 0 and x[i] w[i] = 0 for both rows. A is symmetric, positive
//! definite.

/// The answer of the two-row problem.
pub fn answer(a: [[f64; 2]; 2], b: [f64; 2]) -> [f64; 2] {
    todo!()
}
