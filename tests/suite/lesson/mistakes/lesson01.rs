use lcplab::lesson::exercise::{Verdict, lesson01};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        ("1.1", lesson01::clamp(|x, lo, _| x.max(lo))),
        ("1.1", lesson01::clamp(|x, lo, hi| if x < lo { hi } else { x.min(hi) })),
        ("1.2", lesson01::one_row(|a, b, lo, hi| (b / a).clamp(lo, hi))),
        ("1.2", lesson01::one_row(|_, b, lo, hi| (-b).clamp(lo, hi))),
        (
            "1.3",
            lesson01::two_rows(|a, b| [(-b[0] / a[0][0]).max(0.0), (-b[1] / a[1][1]).max(0.0)]),
        ),
        (
            "1.3",
            lesson01::two_rows(|a, b| {
                let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
                let x = [
                    (-b[0] * a[1][1] + a[0][1] * b[1]) / det,
                    (-b[1] * a[0][0] + a[1][0] * b[0]) / det,
                ];
                x.map(|x: f64| x.max(0.0))
            }),
        ),
    ]
}
