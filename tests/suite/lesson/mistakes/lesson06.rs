use lcplab::lesson::exercise::{Verdict, lesson06};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // K&M (4): w must vanish.
        ("6.1", lesson06::residual(|_, w, _, _| w.abs())),
        // Contacts only: the upper bound is forgotten.
        ("6.1", lesson06::residual(|x, w, lo, _| (x - lo).min(w).abs())),
        // All w must vanish.
        (
            "6.2",
            lesson06::gap(|a, b, x| {
                (0..2).map(|i| (a[i][0] * x[0] + a[i][1] * x[1] + b[i]).abs()).sum()
            }),
        ),
        // Half of it.
        (
            "6.2",
            lesson06::gap(|a, b, x| {
                let w = |i: usize| a[i][0] * x[0] + a[i][1] * x[1] + b[i];
                0.5 * (x[0] * w(0) + x[1] * w(1))
            }),
        ),
        // The sign of d is not looked at.
        (
            "6.3",
            lesson06::farkas(|a, b, d| {
                (0..2).all(|j| d[0] * a[0][j] + d[1] * a[1][j] <= 0.0)
                    && d[0] * b[0] + d[1] * b[1] < 0.0
            }),
        ),
        // A d in place of Aᵀd.
        (
            "6.3",
            lesson06::farkas(|a, b, d| {
                d.iter().all(|&d| d >= 0.0)
                    && (0..2).all(|i| a[i][0] * d[0] + a[i][1] * d[1] <= 0.0)
                    && d[0] * b[0] + d[1] * b[1] < 0.0
            }),
        ),
    ]
}
