use lcplab::lesson::exercise::{Verdict, stack};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Each contact carries the body on it alone.
        ("15.1", stack::layers(|masses, g, dt| masses.iter().map(|m| m * g * dt).collect())),
        // Weights are summed from the ground up.
        (
            "15.1",
            stack::layers(|masses, g, dt| {
                (0..masses.len()).map(|k| masses[..=k].iter().sum::<f64>() * g * dt).collect()
            }),
        ),
        // Both ends of a layer carry the same.
        (
            "15.2",
            stack::tower(|x, m, dt| {
                let half = |k: usize| 0.5 * 9.81 * dt * m[k..].iter().sum::<f64>();
                Some((0..x.len()).map(|k| [half(k); 2]).collect())
            }),
        ),
        // The load is taken to press in the middle of the next box.
        ("15.2", stack::tower(|x, m, dt| layers(x, m, dt, |k| x[k], true))),
        // It never falls.
        ("15.2", stack::tower(|x, m, dt| layers(x, m, dt, |k| middle(x, m, k), false))),
        // The place of the load without the masses.
        (
            "15.2",
            stack::tower(|x, m, dt| layers(x, m, dt, |k| middle(x, &vec![1.0; m.len()], k), true)),
        ),
        // ρ upside down: the light one on top.
        (
            "15.3",
            stack::sweeps(|below, above, reduction| {
                (reduction.ln() / (below / (below + above)).ln()).ceil() as usize
            }),
        ),
        // The ratio of the masses instead of the number of sweeps.
        (
            "15.3",
            stack::sweeps(|below, above, reduction| {
                ((above / below) * (1.0 / reduction).log10()).ceil() as usize
            }),
        ),
        // What is kept is not given to the balls at all.
        ("15.b", stack::kept(|m, dt, sweeps, steps| column(m, dt, sweeps, steps, |_, _| 0.0))),
        // The reaction on the ball below is forgotten.
        ("15.b", stack::kept(|m, dt, sweeps, steps| column(m, dt, sweeps, steps, |x, k| x[k]))),
        // Both contacts push upwards.
        (
            "15.b",
            stack::kept(|m, dt, sweeps, steps| {
                column(m, dt, sweeps, steps, |x, k| x[k] + x.get(k + 1).copied().unwrap_or(0.0))
            }),
        ),
    ]
}

/// The center of mass of the boxes from k upwards.
fn middle(x: &[f64], m: &[f64], k: usize) -> f64 {
    (k..x.len()).map(|j| m[j] * x[j]).sum::<f64>() / m[k..].iter().sum::<f64>()
}

/// The layers of a tower, with any idea of where a load presses.
fn layers(
    x: &[f64],
    m: &[f64],
    dt: f64,
    place: impl Fn(usize) -> f64,
    may_fall: bool,
) -> Option<Vec<[f64; 2]>> {
    let mut impulses = Vec::new();
    for k in 0..x.len() {
        let below = if k == 0 { x[0] } else { x[k - 1] };
        let (left, right) = (x[k].max(below) - 0.5, x[k].min(below) + 0.5);
        let part = (place(k) - left) / (right - left);
        if may_fall && !(0.0..=1.0).contains(&part) {
            return None;
        }
        let load = 9.81 * dt * m[k..].iter().sum::<f64>();
        impulses.push([(1.0 - part) * load, part * load]);
    }
    Some(impulses)
}

/// The column of 11.b, with any idea of what the kept impulses give to ball k.
fn column(
    masses: &[f64],
    dt: f64,
    sweeps: usize,
    steps: usize,
    kept: fn(&[f64], usize) -> f64,
) -> (Vec<f64>, Vec<f64>) {
    let n = masses.len();
    let (mut z, mut u, mut x) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for _step in 0..steps {
        for k in 0..n {
            u[k] += kept(&x, k) / masses[k] - 9.81 * dt;
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
