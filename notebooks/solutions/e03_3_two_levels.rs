//! Exercise 3.3: a pendulum at both levels.
//!
//! A bob of mass m (kg) at the angle φ (rad) from the vertical turns at ω (rad/s) on a rod of
//! length l (m). The row's direction n points from the pivot to the bob, x ≥ 0 would push the bob
//! away. The bob moves along the circle, so J u = 0 now. Gravity along n is g cos φ.

/// The impulse x (N s) of one step dt (s) at velocity level, and the force λ (N) at acceleration
/// level.
pub fn answer(m: f64, l: f64, g: f64, phi: f64, omega: f64, dt: f64) -> [f64; 2] {
    let weight = m * g * phi.cos();
    [-dt * weight, -(weight + m * l * omega * omega)]
}
