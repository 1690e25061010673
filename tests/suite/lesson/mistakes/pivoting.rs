use lcplab::lesson::exercise::{Verdict, pivoting};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Each row on its own.
        (
            "6.1",
            pivoting::active_set(|a, b, free| {
                [0, 1].map(|i| if free[i] { -b[i] / a[i][i] } else { 0.0 })
            }),
        ),
        // Both rows solved, then the bound put in.
        (
            "6.1",
            pivoting::active_set(|a, b, free| {
                let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
                let x = [
                    (a[0][1] * b[1] - a[1][1] * b[0]) / det,
                    (a[1][0] * b[0] - a[0][0] * b[1]) / det,
                ];
                [0, 1].map(|i| if free[i] { x[i] } else { 0.0 })
            }),
        ),
        // The most negative instead of the first.
        (
            "7.1",
            pivoting::murty(|x, w| {
                let size = |i: usize| x[i].min(w[i]);
                let least = (0..x.len()).min_by(|&i, &j| size(i).total_cmp(&size(j)))?;
                (size(least) < 0.0).then_some(least)
            }),
        ),
        // Only the rows at a bound are tested.
        ("7.1", pivoting::murty(|_, w| w.iter().position(|&w| w < 0.0))),
        // The fastest instead of the first to arrive.
        (
            "7.2",
            pivoting::ratio(|_, rate| {
                let falling = (0..rate.len()).filter(|&r| rate[r] < 0.0);
                falling.min_by(|&r, &s| rate[r].total_cmp(&rate[s]))
            }),
        ),
        // Rising variables take part too.
        (
            "7.2",
            pivoting::ratio(|constant, rate| {
                let ratio = |r: usize| (constant[r] / rate[r]).abs();
                (0..rate.len()).min_by(|&r, &s| ratio(r).total_cmp(&ratio(s)))
            }),
        ),
        // Of several the last.
        (
            "7.2",
            pivoting::ratio(|constant, rate| {
                let ratio = |r: usize| constant[r] / -rate[r];
                let falling = (0..rate.len()).rev().filter(|&r| rate[r] < 0.0);
                falling.min_by(|&r, &s| ratio(r).total_cmp(&ratio(s)))
            }),
        ),
        // Sizes of ratios are compared.
        ("6.b", pivoting::dantzig_step(|x, w, dx, dw| first(x, w, dx, dw, |v, dv| (v / dv).abs()))),
        // Only rising values are tested, falling ones are not.
        (
            "6.b",
            pivoting::dantzig_step(|x, w, dx, dw| {
                first(x, w, dx, dw, |v, dv| if dv > 0.0 { v / dv } else { f64::INFINITY })
            }),
        ),
        // No other row stops it.
        ("6.b", pivoting::dantzig_step(|x, w, dx, dw| first(x, w, dx, dw, |_, _| f64::INFINITY))),
    ]
}

/// The program of 5.b with any ratio of a value and its change.
fn first(x: &[f64], w: &[f64], dx: &[f64], dw: &[f64], ratio: fn(f64, f64) -> f64) -> (f64, usize) {
    let last = x.len() - 1;
    let mut best = (-w[last] / dw[last], last);
    for r in 0..last {
        let pair = if x[r] > 0.0 { (x[r], dx[r]) } else { (w[r], dw[r]) };
        let step = ratio(pair.0, pair.1);
        if step < best.0 {
            best = (step, r);
        }
    }
    best
}
