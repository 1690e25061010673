//! Exercise 9.1: is d a proof that no solution exists?
//!
//! Contacts: x ≥ 0 and w = A x + b ≥ 0 are asked for; A need not be symmetric. d is a proof if the
//! sum of d[i] w[i] cannot be negative when all w are allowed, and yet is negative for every x ≥ 0.
//! Compare with 0 exactly.

/// Whether d proves it.
pub fn answer(a: [[f64; 2]; 2], b: [f64; 2], d: [f64; 2]) -> bool {
    let pull_back = |j: usize| d[0] * a[0][j] + d[1] * a[1][j]; // (Aᵀd)_j, the factor of x_j
    let is_allowed = d.iter().all(|&d| d >= 0.0);
    is_allowed && (0..2).all(|j| pull_back(j) <= 0.0) && d[0] * b[0] + d[1] * b[1] < 0.0
}
