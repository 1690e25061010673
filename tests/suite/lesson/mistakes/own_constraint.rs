use lcplab::lesson::exercise::{Verdict, own_constraint};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // J'u is forgotten: the weight alone.
        ("17.1", own_constraint::skier(|m, slope, _, _| snow(m, slope, 0.0))),
        // J'u with the other sign.
        ("17.1", own_constraint::skier(|m, slope, bend, v| snow(m, slope, bend * v * v))),
        // The snow holds her like a wire.
        (
            "17.1",
            own_constraint::skier(|m, slope, bend, v| {
                let force = m * (9.81 + bend * v * v) / (1.0 + slope * slope);
                [-slope * force, force]
            }),
        ),
        // J is not squared: upright ground.
        (
            "17.1",
            own_constraint::skier(|m, slope, bend, v| {
                let force = f64::max(0.0, m * (9.81 + bend * v * v));
                [-slope * force, force]
            }),
        ),
        // To one side only: the bend stays in.
        ("17.2", own_constraint::tested(|c, p, j| first(p, j, |q, p| c(q) - c(p), 1e-5, 1e-5))),
        // Too near: rounding.
        ("17.2", own_constraint::tested(|c, p, j| central(c, p, j, 1e-9))),
        // Too far: the bend of the bend.
        ("17.2", own_constraint::tested(|c, p, j| central(c, p, j, 1e-2))),
        // An absolute tolerance that is too wide.
        (
            "17.2",
            own_constraint::tested(|c, p, j| {
                first(p, j, |q, p| 0.5 * (c(q) - c(mirrored(q, p))), 1e-5, 0.02)
            }),
        ),
        // Divided instead of multiplied.
        (
            "17.b",
            own_constraint::bead(|slope, mu, m, dt, n| {
                slide(slope, mu / f64::hypot(1.0, slope), m, dt, n)
            }),
        ),
        // Multiplied by the slope alone.
        (
            "17.b",
            own_constraint::bead(|slope, mu, m, dt, n| slide(slope, mu * slope.abs(), m, dt, n)),
        ),
        // By its square.
        (
            "17.b",
            own_constraint::bead(|slope, mu, m, dt, n| {
                slide(slope, mu * (1.0 + slope * slope), m, dt, n)
            }),
        ),
    ]
}

/// The force of the snow, from −J'u.
fn snow(m: f64, slope: f64, minus: f64) -> [f64; 2] {
    let force = f64::max(0.0, m * (9.81 - minus) / (1.0 + slope * slope));
    [-slope * force, force]
}

fn mirrored(q: [f64; 3], p: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| 2.0 * p[k] - q[k])
}

/// The first entry that differs from a quotient, in parts of the row's length.
fn first(
    p: [f64; 3],
    j: [f64; 3],
    change: impl Fn([f64; 3], [f64; 3]) -> f64,
    h: f64,
    tolerance: f64,
) -> Option<usize> {
    let length = j.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    (0..3).find(|&k| {
        let mut q = p;
        q[k] += h;
        (j[k] - change(q, p) / h).abs() > tolerance * length
    })
}

fn central(c: fn([f64; 3]) -> f64, p: [f64; 3], j: [f64; 3], h: f64) -> Option<usize> {
    first(p, j, |q, p| 0.5 * (c(q) - c(mirrored(q, p))), h, 1e-5)
}

/// The bead of 12.b, with any factor of the row's own x.
fn slide(slope: f64, factor: f64, m: f64, dt: f64, steps: usize) -> f64 {
    let size = f64::hypot(1.0, slope);
    let mut speed = 0.0; // along the wire
    for _step in 0..steps {
        let x = m * 9.81 * dt / (size * size);
        let slip = speed - 9.81 * dt * slope / size;
        speed = slip + f64::clamp(-m * slip, -factor * x, factor * x) / m;
    }
    speed
}
