//! Find the bug 12.b: a ball that bounces.
//!
//! A ball starts at rest at this height (m) over the ground. A contact has a bias, and the velocity
//! after a step is at least -bias. While the ground is out of reach the gap may close within the
//! step of dt (s), but not more; a ball that hits leaves with e times its speed before the step.
//! The program should return [height, velocity] after each step. Its users say: "With e = 1 the
//! ball should come back forever. It loses height, at each bounce another amount, and soon it
//! hardly leaves the ground. Shorter steps do not help." There is exactly one mistake.

/// [height, velocity] after each step.
pub fn answer(height: f64, e: f64, dt: f64, steps: usize) -> Vec<[f64; 2]> {
    let (mut z, mut v) = (height, 0.0);
    let mut states = Vec::new();
    for _step in 0..steps {
        let free = v - 9.81 * dt;
        // The gap may close within the step.
        let mut bias = z / dt;
        if free + bias < 0.0 {
            // The ball hits; v < 0 is its velocity before.
            bias = e * f64::min(v, 0.0);
        }
        v = f64::max(free, -bias);
        z += dt * v;
        states.push([z, v]);
    }
    states
}
