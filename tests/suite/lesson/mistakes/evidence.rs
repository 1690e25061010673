use lcplab::lesson::exercise::{Verdict, evidence};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // The natural residual: it has units.
        (
            "8.1",
            evidence::scaled(|a, b, lo, hi, x| {
                worst(a, b, x, |i, w, _| (x[i] - (x[i] - w).clamp(lo[i], hi[i])).abs())
            }),
        ),
        // All w must vanish, whatever the bounds.
        (
            "8.1",
            evidence::scaled(|a, b, _, _, x| {
                worst(a, b, x, |_, w, terms| if terms == 0.0 { 0.0 } else { w.abs() / terms })
            }),
        ),
        // Contacts only: the upper bound is forgotten.
        (
            "8.1",
            evidence::scaled(|a, b, lo, _, x| {
                worst(a, b, x, |i, w, terms| {
                    let part = f64::min(a[i][i] * (x[i] - lo[i]), w).abs() / terms;
                    if terms == 0.0 { 0.0 } else { part }
                })
            }),
        ),
        // An impulse divided by a velocity.
        (
            "8.1",
            evidence::scaled(|a, b, lo, hi, x| {
                worst(a, b, x, |i, w, terms| {
                    let step = (x[i] - (x[i] - w / a[i][i]).clamp(lo[i], hi[i])).abs();
                    if terms == 0.0 { 0.0 } else { step / terms }
                })
            }),
        ),
        // The signs of the set are not tested.
        (
            "8.2",
            evidence::repair(|a, b, x| {
                let exact = of_set(a, b, [0, 1].map(|i| a[i][i] * x[i] > w_of(a, b, x)[i]));
                Some((exact, far(exact, x)))
            }),
        ),
        // Only the impulses are tested, not the motion of the other contact.
        (
            "8.2",
            evidence::repair(|a, b, x| {
                let exact = of_set(a, b, [0, 1].map(|i| a[i][i] * x[i] > w_of(a, b, x)[i]));
                (exact[0] >= 0.0 && exact[1] >= 0.0).then(|| (exact, far(exact, x)))
            }),
        ),
        // Each row with a positive x is taken for free.
        (
            "8.2",
            evidence::repair(|a, b, x| {
                let exact = of_set(a, b, x.map(|x| x > 0.0));
                let w = w_of(a, b, exact);
                let fits = (0..2).all(|i| exact[i] >= 0.0 && w[i] >= -1e-12);
                fits.then(|| (exact, far(exact, x)))
            }),
        ),
        // The sign of d is not tested.
        (
            "9.1",
            evidence::farkas(|a, b, d| {
                (0..2).all(|j| d[0] * a[0][j] + d[1] * a[1][j] <= 0.0)
                    && d[0] * b[0] + d[1] * b[1] < 0.0
            }),
        ),
        // A d instead of Aᵀd.
        (
            "9.1",
            evidence::farkas(|a, b, d| {
                d.iter().all(|&d| d >= 0.0)
                    && (0..2).all(|i| a[i][0] * d[0] + a[i][1] * d[1] <= 0.0)
                    && d[0] * b[0] + d[1] * b[1] < 0.0
            }),
        ),
        // bᵀd = 0 is taken for a proof.
        (
            "9.1",
            evidence::farkas(|a, b, d| {
                d.iter().all(|&d| d >= 0.0)
                    && (0..2).all(|j| d[0] * a[0][j] + d[1] * a[1][j] <= 0.0)
                    && d[0] * b[0] + d[1] * b[1] <= 0.0
            }),
        ),
        // It may end with a w that is not negative and an x that still pushes.
        ("8.b", evidence::stop(|a, b, tolerance| swept(a, b, tolerance, |_, w| f64::max(0.0, -w)))),
        // The product alone.
        ("8.b", evidence::stop(|a, b, tolerance| swept(a, b, tolerance, |x, w| (x * w).abs()))),
        // The sum instead of the smaller one.
        ("8.b", evidence::stop(|a, b, tolerance| swept(a, b, tolerance, |x, w| (x + w).abs()))),
    ]
}

/// The largest part of all rows, each from its number, its w and the sum of its terms in size.
fn worst(a: &[Vec<f64>], b: &[f64], x: &[f64], part: impl Fn(usize, f64, f64) -> f64) -> f64 {
    let row = |i: usize| {
        let products = || (0..b.len()).map(|j| a[i][j] * x[j]).chain([b[i]]);
        part(i, products().sum(), products().map(f64::abs).sum())
    };
    (0..b.len()).map(row).fold(0.0, f64::max)
}

fn w_of(a: [[f64; 2]; 2], b: [f64; 2], x: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|i| a[i][0] * x[0] + a[i][1] * x[1] + b[i])
}

fn far(x: [f64; 2], y: [f64; 2]) -> f64 {
    f64::max((x[0] - y[0]).abs(), (x[1] - y[1]).abs())
}

/// The point of an active set.
fn of_set(a: [[f64; 2]; 2], b: [f64; 2], free: [bool; 2]) -> [f64; 2] {
    let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    match free {
        [true, true] => {
            [(a[0][1] * b[1] - a[1][1] * b[0]) / det, (a[1][0] * b[0] - a[0][0] * b[1]) / det]
        }
        _ => [0, 1].map(|i| if free[i] { -b[i] / a[i][i] } else { 0.0 }),
    }
}

/// The program of 6.b with any number for how bad a row is.
fn swept(a: &[Vec<f64>], b: &[f64], tolerance: f64, bad: fn(f64, f64) -> f64) -> (Vec<f64>, usize) {
    let n = b.len();
    let mut x = vec![0.0; n];
    for sweep in 1..=1000 {
        let w = |x: &[f64], i: usize| b[i] + (0..n).map(|j| a[i][j] * x[j]).sum::<f64>();
        for i in 0..n {
            x[i] = f64::max(0.0, x[i] - w(&x, i) / a[i][i]);
        }
        if (0..n).all(|i| bad(x[i], w(&x, i)) <= tolerance) {
            return (x, sweep);
        }
    }
    (x, 1000)
}
