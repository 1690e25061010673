//! Exercise 10.3: a row that is a spring.
//!
//! The row w = ċ + (β/dt) c + γ x = 0 shall mean x = −dt (k c⁺ + d ċ), where ċ is the velocity at
//! the end of the step and c⁺ = c + dt ċ the place. Put c⁺ in, sort by ċ and c, and compare.

/// γ (1/kg) and β for the stiffness k (N/m), the damping d (N s/m) and the step dt (s).
pub fn answer(k: f64, d: f64, dt: f64) -> [f64; 2] {
    [1.0 / (dt * (d + dt * k)), dt * k / (d + dt * k)]
}
