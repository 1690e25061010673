use lcplab::lesson::exercise::{Verdict, lesson07};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Only for short steps.
        ("7.1", lesson07::tangent(|l, v, dt| (v * dt).powi(2) / (2.0 * l))),
        // The way along the tangent.
        ("7.1", lesson07::tangent(|_, v, dt| v * dt)),
        // β without 1/dt, K&M (25).
        (
            "7.2",
            lesson07::bias(
                |c, dt, beta, slop| {
                    if c > 0.0 { c / dt } else { beta * (c + slop).min(0.0) }
                },
            ),
        ),
        // A gap is fed back as if it were an overlap.
        ("7.2", lesson07::bias(|c, dt, beta, _| beta / dt * c)),
        // The spring at the beginning of the step.
        ("7.3", lesson07::spring(|k, d, dt| [1.0 / (dt * d), dt * k / d])),
        // Compliance as if there were no time.
        ("7.3", lesson07::spring(|k, d, dt| [1.0 / k, dt * k / (d + dt * k)])),
    ]
}
