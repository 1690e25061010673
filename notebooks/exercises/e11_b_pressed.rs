//! Find the bug 11.b: a block is pushed and pressed.
//!
//! A block of mass m (kg) stands on the ground with friction μ. In each step of dt (s) a hand
//! pushes it along the ground and presses it down, forces[k] = [push, press] in N, press ≥ 0. The
//! program should return the speed along the ground after each step, by Coulomb's law. Its users
//! say: "A steady load is right, but for the first moment. If we press harder, it holds too late;
//! and when we stop pressing, the block stops as if it were still pressed." There is exactly one
//! mistake.

/// The speed after each step (m/s).
pub fn answer(m: f64, mu: f64, dt: f64, forces: &[[f64; 2]]) -> Vec<f64> {
    let mut v = 0.0;
    let mut limit = 0.0; // the most that friction can give (N s)
    let mut speeds = Vec::new();
    for [push, press] in forces {
        // The tangent: friction takes what it can of the slip.
        let slip = v + dt * push / m;
        let friction = f64::clamp(-m * slip, -limit, limit);
        // The normal: weight and press are carried.
        let x_n = dt * (m * 9.81 + press);
        limit = mu * x_n;
        v = slip + friction / m;
        speeds.push(v);
    }
    speeds
}
