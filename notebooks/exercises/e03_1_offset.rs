//! Exercise 3.1: the b of a row.
//!
//! At velocity level w = J u⁺ = A x + b. A body has the velocity u (m/s), the force F (N) acts on it, its
//! inverse mass is 1/m (1/kg), the step takes dt (s), and j is the row. What is b, the w for x = 0?

/// b (m/s).
pub fn answer(j: [f64; 3], u: [f64; 3], force: [f64; 3], inverse_mass: f64, dt: f64) -> f64 {
    todo!()
}
