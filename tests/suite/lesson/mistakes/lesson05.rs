use lcplab::lesson::exercise::{Verdict, lesson05};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Each row on its own.
        (
            "5.1",
            lesson05::active_set(|a, b, free| {
                [0, 1].map(|i| if free[i] { -b[i] / a[i][i] } else { 0.0 })
            }),
        ),
        // Both rows solved, then the bound put in.
        (
            "5.1",
            lesson05::active_set(|a, b, free| {
                let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
                let x = [
                    (a[0][1] * b[1] - a[1][1] * b[0]) / det,
                    (a[1][0] * b[0] - a[0][0] * b[1]) / det,
                ];
                [0, 1].map(|i| if free[i] { x[i] } else { 0.0 })
            }),
        ),
        // The most negative in place of the first.
        (
            "5.2",
            lesson05::murty(|x, w| {
                let size = |i: usize| x[i].min(w[i]);
                let least = (0..x.len()).min_by(|&i, &j| size(i).total_cmp(&size(j)))?;
                (size(least) < 0.0).then_some(least)
            }),
        ),
        // Only the rows at a bound are looked at.
        ("5.2", lesson05::murty(|_, w| w.iter().position(|&w| w < 0.0))),
        // The fastest in place of the first to arrive.
        (
            "5.3",
            lesson05::ratio(|_, rate| {
                let falling = (0..rate.len()).filter(|&r| rate[r] < 0.0);
                falling.min_by(|&r, &s| rate[r].total_cmp(&rate[s]))
            }),
        ),
        // Rising variables take part too.
        (
            "5.3",
            lesson05::ratio(|constant, rate| {
                let ratio = |r: usize| (constant[r] / rate[r]).abs();
                (0..rate.len()).min_by(|&r, &s| ratio(r).total_cmp(&ratio(s)))
            }),
        ),
    ]
}
