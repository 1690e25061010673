//! Find the bug 3.b: one step of two bodies on a line.
//!
//! Body 1 is above body 0, velocities count upwards (m/s), each body has its inverse mass (1/kg; 0
//! for a table that cannot move) and its force (N). The gap opens at J u with J = [-1, 1]. The
//! program should return the velocities after a step of dt (s). Its users say: "With steps of 1 s
//! everything is right. With steps of 0.01 s a book that lies on a table flies up as if it had been
//! kicked." There is exactly one mistake.

/// The velocities of the two bodies after the step.
pub fn answer(inverse_mass: [f64; 2], u: [f64; 2], force: [f64; 2], dt: f64) -> [f64; 2] {
    let j = [-1.0, 1.0];
    // A = J M⁻¹ Jᵀ and b, the velocity of the gap without an impulse.
    let (mut a, mut b) = (0.0, 0.0);
    for k in 0..2 {
        a += j[k] * inverse_mass[k] * j[k];
        b += j[k] * (u[k] + inverse_mass[k] * force[k]);
    }
    let x = f64::max(0.0, -b / a);
    // u⁺ = u + M⁻¹ (dt F + Jᵀ x)
    let mut after = u;
    for k in 0..2 {
        after[k] += inverse_mass[k] * (dt * force[k] + j[k] * x);
    }
    after
}
