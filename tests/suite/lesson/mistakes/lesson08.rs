use lcplab::lesson::exercise::{Verdict, lesson08};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // The change is clamped in place of the sum.
        (
            "8.1",
            lesson08::friction_row(|x_t, w_t, a_tt, mu, x_n| {
                x_t + (-w_t / a_tt).clamp(-mu * x_n, mu * x_n)
            }),
        ),
        // μ alone, whatever the pressure.
        ("8.1", lesson08::friction_row(|x_t, w_t, a_tt, mu, _| (x_t - w_t / a_tt).clamp(-mu, mu))),
        // x_n is kept and x_t cut to length: a point of the cone, but not the nearest one.
        (
            "8.2",
            lesson08::cone(|[n, t1, t2], mu| {
                let n = f64::max(n, 0.0);
                let part = f64::min(1.0, mu * n / f64::hypot(t1, t2).max(1e-300));
                [n, part * t1, part * t2]
            }),
        ),
        // The tip is forgotten: the surface is taken for all points outside.
        (
            "8.2",
            lesson08::cone(|p, mu| {
                let t = f64::hypot(p[1], p[2]);
                if t <= mu * p[0] {
                    return p;
                }
                let n = (p[0] + mu * t) / (1.0 + mu * mu);
                [n, mu * n * p[1] / t, mu * n * p[2] / t]
            }),
        ),
        // Friction downhill for ever.
        (
            "8.3",
            lesson08::uphill(|theta, mu, v0, t| v0 - 9.81 * (theta.sin() + mu * theta.cos()) * t),
        ),
        // What has stopped stays, however steep it is.
        (
            "8.3",
            lesson08::uphill(|theta, mu, v0, t| {
                (v0 - 9.81 * (theta.sin() + mu * theta.cos()) * t).max(0.0)
            }),
        ),
    ]
}
