//! Exercise 6.2: the duality gap.
//!
//! For contacts, and an x ≥ 0 with w = A x + b ≥ 0: the objective ½ xᵀA x + bᵀx minus its bound from below,
//! −½ xᵀA x.

/// The gap.
pub fn answer(a: [[f64; 2]; 2], b: [f64; 2], x: [f64; 2]) -> f64 {
    (0..2).map(|i| x[i] * (a[i][0] * x[0] + a[i][1] * x[1] + b[i])).sum()
}
