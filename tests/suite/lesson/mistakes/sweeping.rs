use lcplab::lesson::exercise::{Verdict, sweeping};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Jacobi: every row sees the old x.
        (
            "4.1",
            sweeping::sweep(|a, b, lo, hi, x| {
                let w = |i: usize| b[i] + (0..3).map(|j| a[i][j] * x[j]).sum::<f64>();
                (0..3).map(|i| (x[i] - w(i) / a[i][i]).clamp(lo[i], hi[i])).collect()
            }),
        ),
        // Code 6: the clamp after the sweep.
        (
            "4.1",
            sweeping::sweep(|a, b, lo, hi, mut x| {
                for i in 0..3 {
                    let w = b[i] + (0..3).map(|j| a[i][j] * x[j]).sum::<f64>();
                    x[i] -= w / a[i][i];
                }
                (0..3).map(|i| x[i].clamp(lo[i], hi[i])).collect()
            }),
        ),
        // The increment is clamped, not the sum.
        (
            "4.2",
            sweeping::impulse(|v, inverse_mass, total| {
                let push = f64::max(0.0, -v / inverse_mass);
                (v + push * inverse_mass, total + push)
            }),
        ),
        // An equality: the contact pulls.
        ("4.2", sweeping::impulse(|v, inverse_mass, total| (0.0, total - v / inverse_mass))),
        // One more sweep, not all that are left.
        ("5.1", sweeping::extrapolate(|sweeps| to_the_end(sweeps, |rho| rho))),
        // ρ is taken for positive.
        (
            "5.1",
            sweeping::extrapolate(|sweeps| to_the_end(sweeps, |rho| rho.abs() / (1.0 - rho.abs()))),
        ),
        // Counted from the last but one change.
        ("5.1", sweeping::extrapolate(|sweeps| to_the_end(sweeps, |rho| 1.0 / (1.0 - rho)))),
        // Each row has its own ρ, and some do not move.
        (
            "5.1",
            sweeping::extrapolate(|[x, y, z]| {
                let of = |i: usize| z[i] - (z[i] - y[i]).powi(2) / (z[i] - 2.0 * y[i] + x[i]);
                (0..x.len()).map(of).collect()
            }),
        ),
        // The clamp once, at the very end.
        (
            "4.b",
            sweeping::projected(|a, b, sweeps| {
                let x = swept(a, b, sweeps, |x, step| x + step);
                x.into_iter().map(|x| x.max(0.0)).collect()
            }),
        ),
        // The step is clamped, not the sum.
        (
            "4.b",
            sweeping::projected(|a, b, sweeps| swept(a, b, sweeps, |x, step| x + step.max(0.0))),
        ),
        // A row that would pull is left as it is.
        (
            "4.b",
            sweeping::projected(|a, b, sweeps| {
                swept(a, b, sweeps, |x, step| if x + step < 0.0 { x } else { x + step })
            }),
        ),
    ]
}

/// x from three sweeps, and a factor of the last change.
fn to_the_end([x, y, z]: [&[f64]; 3], factor: fn(f64) -> f64) -> Vec<f64> {
    let product: f64 = (0..x.len()).map(|i| (z[i] - y[i]) * (y[i] - x[i])).sum();
    let square: f64 = (0..x.len()).map(|i| (y[i] - x[i]).powi(2)).sum();
    if square == 0.0 {
        return z.to_vec();
    }
    (0..x.len()).map(|i| (z[i] + factor(product / square) * (z[i] - y[i])).max(0.0)).collect()
}

/// Sweeps with any way to take a step.
fn swept(a: &[Vec<f64>], b: &[f64], sweeps: usize, step: fn(f64, f64) -> f64) -> Vec<f64> {
    let mut x = vec![0.0; b.len()];
    for _sweep in 0..sweeps {
        for i in 0..b.len() {
            let w = b[i] + (0..b.len()).map(|j| a[i][j] * x[j]).sum::<f64>();
            x[i] = step(x[i], -w / a[i][i]);
        }
    }
    x
}
