use lcplab::lesson::exercise::{Verdict, drift};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Only for short steps.
        ("10.1", drift::tangent(|l, v, dt| (v * dt).powi(2) / (2.0 * l))),
        // The way along the tangent.
        ("10.1", drift::tangent(|_, v, dt| v * dt)),
        // β without 1/dt, K&M (25).
        (
            "10.2",
            drift::bias(
                |c, dt, beta, slop| {
                    if c > 0.0 { c / dt } else { beta * (c + slop).min(0.0) }
                },
            ),
        ),
        // A gap is fed back as if it were an overlap.
        ("10.2", drift::bias(|c, dt, beta, _| beta / dt * c)),
        // The spring at the beginning of the step.
        ("10.3", drift::spring(|k, d, dt| [1.0 / (dt * d), dt * k / d])),
        // Compliance as if there were no time.
        ("10.3", drift::spring(|k, d, dt| [1.0 / k, dt * k / (d + dt * k)])),
        // What lies within the slop is corrected too.
        ("10.2", drift::bias(|c, dt, beta, _| if c > 0.0 { c / dt } else { beta / dt * c })),
        // Multiplied by the step.
        ("10.b", drift::feedback(|p, l, g, beta, dt, n| swing(p, l, g, beta * dt, dt, n))),
        // All of the error in one step.
        ("10.b", drift::feedback(|p, l, g, _, dt, n| swing(p, l, g, 1.0 / dt, dt, n))),
        // The other sign.
        ("10.b", drift::feedback(|p, l, g, beta, dt, n| swing(p, l, g, -beta / dt, dt, n))),
    ]
}

/// The bob of 7.b, with any factor before the error.
fn swing(start: [f64; 2], l: f64, g: f64, factor: f64, dt: f64, steps: usize) -> [f64; 2] {
    let (mut p, mut u) = (start, [0.0, 0.0]);
    for _step in 0..steps {
        let length = f64::hypot(p[0], p[1]);
        let n = [p[0] / length, p[1] / length];
        u[1] -= dt * g;
        let x = -(n[0] * u[0] + n[1] * u[1] + factor * (length - l));
        for k in 0..2 {
            u[k] += n[k] * x;
            p[k] += dt * u[k];
        }
    }
    p
}
