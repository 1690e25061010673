//! Exercise 3.2: the matrix A.
//!
//! Three bodies move along one line, body k with the inverse mass inverse_mass[k] (1/kg). Row i of
//! J says how the gap i opens. Entry A[i][k] is how fast gap i opens after a unit impulse in row k.

/// A = J M⁻¹ Jᵀ (1/kg).
pub fn answer(j: [[f64; 3]; 3], inverse_mass: [f64; 3]) -> [[f64; 3]; 3] {
    let entry = |i: usize, k: usize| (0..3).map(|b| j[i][b] * inverse_mass[b] * j[k][b]).sum();
    std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k)))
}
