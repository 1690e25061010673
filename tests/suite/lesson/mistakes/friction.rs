use lcplab::lesson::exercise::{Verdict, friction};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // The diamond by shrinking, as the disc.
        (
            "11.1",
            friction::nearest(|[x, y], limit| {
                let shrunk = |size: f64| {
                    let part = if size > limit { limit / size } else { 1.0 };
                    [part * x, part * y]
                };
                let square = [x.clamp(-limit, limit), y.clamp(-limit, limit)];
                [square, shrunk(x.hypot(y)), shrunk(x.abs() + y.abs())]
            }),
        ),
        // The foot on the edge's line, also where it lies beyond the corner.
        (
            "11.1",
            friction::nearest(|[x, y], limit| {
                let square = [x.clamp(-limit, limit), y.clamp(-limit, limit)];
                let size = x.hypot(y);
                let disc = if size > limit { [limit * x / size, limit * y / size] } else { [x, y] };
                let over = f64::max(0.0, x.abs() + y.abs() - limit) / 2.0;
                let less = |x: f64| x.signum() * (x.abs() - over);
                [square, disc, [less(x), less(y)]]
            }),
        ),
        // The disc takes the square's corner.
        (
            "11.1",
            friction::nearest(|[x, y], limit| {
                let square = [x.clamp(-limit, limit), y.clamp(-limit, limit)];
                [square; 3]
            }),
        ),
        // x_n is kept and x_t cut to length: a point of the cone, but not the nearest one.
        (
            "11.2",
            friction::cone(|[n, t1, t2], mu| {
                let n = f64::max(n, 0.0);
                let part = f64::min(1.0, mu * n / f64::hypot(t1, t2).max(1e-300));
                [n, part * t1, part * t2]
            }),
        ),
        // The tip is forgotten: the surface is taken for all points outside.
        (
            "11.2",
            friction::cone(|p, mu| {
                let t = f64::hypot(p[1], p[2]);
                if t <= mu * p[0] {
                    return p;
                }
                let n = (p[0] + mu * t) / (1.0 + mu * mu);
                [n, mu * n * p[1] / t, mu * n * p[2] / t]
            }),
        ),
        // Friction always points downhill.
        (
            "11.3",
            friction::uphill(|theta, mu, v0, t| v0 - 9.81 * (theta.sin() + mu * theta.cos()) * t),
        ),
        // What has stopped stays, however steep it is.
        (
            "11.3",
            friction::uphill(|theta, mu, v0, t| {
                (v0 - 9.81 * (theta.sin() + mu * theta.cos()) * t).max(0.0)
            }),
        ),
        // The limit is kept from the heaviest load so far.
        (
            "11.b",
            friction::pressed(|m, mu, dt, forces| {
                let mut most = 0.0;
                slide(m, dt, forces, move |press| {
                    most = f64::max(most, mu * dt * (m * 9.81 + press));
                    most
                })
            }),
        ),
        // The weight alone presses.
        (
            "11.b",
            friction::pressed(|m, mu, dt, forces| slide(m, dt, forces, |_| mu * dt * m * 9.81)),
        ),
        // A force for an impulse.
        (
            "11.b",
            friction::pressed(|m, mu, dt, forces| {
                slide(m, dt, forces, |press| mu * (m * 9.81 + press))
            }),
        ),
    ]
}

/// The block of 8.b with any limit of friction.
fn slide(m: f64, dt: f64, forces: &[[f64; 2]], mut limit: impl FnMut(f64) -> f64) -> Vec<f64> {
    let mut v = 0.0;
    let mut step = |[push, press]: &[f64; 2]| {
        let (slip, limit) = (v + dt * push / m, limit(*press));
        v = slip + (-m * slip).clamp(-limit, limit) / m;
        v
    };
    forces.iter().map(&mut step).collect()
}
