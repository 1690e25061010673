use lcplab::lesson::exercise::{Verdict, complementarity};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // The height is not tested: the ground reaches up to the box.
        (
            "1.1",
            complementarity::hand(|m, pull, dt| {
                let mut v = 0.0;
                let mut step = |force: &f64| {
                    v += dt * (force / m - 9.81);
                    let x = f64::max(0.0, -m * v);
                    v += x / m;
                    x
                };
                pull.iter().map(&mut step).collect()
            }),
        ),
        // Forces are balanced, but the speed of the fall is forgotten.
        (
            "1.1",
            complementarity::hand(|m, pull, dt| {
                let (mut z, mut v) = (0.0, 0.0);
                let mut step = |force: &f64| {
                    let x = if z < 1e-9 { f64::max(0.0, dt * (m * 9.81 - force)) } else { 0.0 };
                    v += dt * (force / m - 9.81) + x / m;
                    z += dt * v;
                    x
                };
                pull.iter().map(&mut step).collect()
            }),
        ),
        // The impulse always stops the box: it is held when it should leave.
        (
            "1.1",
            complementarity::hand(|m, pull, dt| pull.iter().map(|f| dt * (m * 9.81 - f)).collect()),
        ),
        ("1.2", complementarity::one_row(|a, b, lo, hi| (b / a).clamp(lo, hi))),
        ("1.2", complementarity::one_row(|_, b, lo, hi| (-b).clamp(lo, hi))),
        // The lower bound is taken for 0.
        ("1.2", complementarity::one_row(|a, b, _, hi| (-b / a).max(0.0).min(hi))),
        (
            "1.3",
            complementarity::two_rows(|a, b| {
                [(-b[0] / a[0][0]).max(0.0), (-b[1] / a[1][1]).max(0.0)]
            }),
        ),
        (
            "1.3",
            complementarity::two_rows(|a, b| {
                let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
                let x = [
                    (-b[0] * a[1][1] + a[0][1] * b[1]) / det,
                    (-b[1] * a[0][0] + a[1][0] * b[0]) / det,
                ];
                x.map(|x: f64| x.max(0.0))
            }),
        ),
        // Mended with the wrong sign.
        (
            "1.b",
            complementarity::two_contacts(|a, b| cases(a, b, |i, k, push| b[k] - a[k][i] * push)),
        ),
        // Mended with the pushing contact's own entry.
        (
            "1.b",
            complementarity::two_contacts(|a, b| cases(a, b, |i, k, push| b[k] + a[i][i] * push)),
        ),
        // The other contact is ignored.
        ("1.b", complementarity::two_contacts(|a, b| cases(a, b, |_, _, _| 0.0))),
    ]
}

/// The program of 1.b, with any idea of how the other contact moves.
fn cases(a: [[f64; 2]; 2], b: [f64; 2], opens: impl Fn(usize, usize, f64) -> f64) -> [f64; 2] {
    if b[0] >= 0.0 && b[1] >= 0.0 {
        return [0.0, 0.0];
    }
    for (i, k) in [(0, 1), (1, 0)] {
        let push = -b[i] / a[i][i];
        if push >= 0.0 && opens(i, k, push) >= 0.0 {
            return if i == 0 { [push, 0.0] } else { [0.0, push] };
        }
    }
    let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    [(a[0][1] * b[1] - a[1][1] * b[0]) / det, (a[1][0] * b[0] - a[0][0] * b[1]) / det]
}
