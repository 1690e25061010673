//! Find the bug 15.b: a column that keeps its impulses.
//!
//! Balls stand on each other, ball 0 on the ground. Each step of dt (s) starts from the impulses x
//! of the step before: the balls get them at once, together with gravity, and sweeps of sequential
//! impulses correct what is left. The program should return, after so many steps, x (N s) and how
//! far each ball has moved upwards (m). Its users say: "One ball alone is right. Under two balls
//! the ground carries only one of them. Five jump off each other, and without the warm start they
//! only sank." There is exactly one mistake.

/// The impulses of the last step, and the ways of the balls.
pub fn answer(masses: &[f64], dt: f64, sweeps: usize, steps: usize) -> (Vec<f64>, Vec<f64>) {
    let n = masses.len();
    let (mut z, mut u, mut x) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for _step in 0..steps {
        for k in 0..n {
            // Contact k is the one below ball k.
            let other = if k > 0 { x[k - 1] } else { 0.0 };
            u[k] += (x[k] - other) / masses[k] - 9.81 * dt;
        }
        for _sweep in 0..sweeps {
            for k in 0..n {
                let (below, give) =
                    if k > 0 { (u[k - 1], 1.0 / masses[k - 1]) } else { (0.0, 0.0) };
                let step = f64::max(-x[k], -(u[k] - below) / (1.0 / masses[k] + give));
                x[k] += step;
                u[k] += step / masses[k];
                if k > 0 {
                    u[k - 1] -= step / masses[k - 1];
                }
            }
        }
        for k in 0..n {
            z[k] += dt * u[k];
        }
    }
    (x, z)
}
