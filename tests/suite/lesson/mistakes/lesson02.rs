use lcplab::lesson::exercise::{Verdict, lesson02};

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // The vector is not made a unit vector.
        ("2.1", lesson02::rod(|p, v| (p, dot(v, v) / dot(p, p).sqrt()))),
        // A rod that does not turn.
        ("2.1", lesson02::rod(|p, _| (p.map(|x| x / dot(p, p).sqrt()), 0.0))),
        // The velocity along the rod is taken to bend it too.
        (
            "2.1",
            lesson02::rod(|p, v| {
                let length = dot(p, p).sqrt();
                (p.map(|x| x / length), dot(v, v) / length)
            }),
        ),
        // r × ω for ω × r.
        (
            "2.2",
            lesson02::nail(|[x, y, z]| {
                [
                    [1.0, 0.0, 0.0, 0.0, -z, y],
                    [0.0, 1.0, 0.0, z, 0.0, -x],
                    [0.0, 0.0, 1.0, -y, x, 0.0],
                ]
            }),
        ),
        // The turning is forgotten.
        (
            "2.2",
            lesson02::nail(|_| std::array::from_fn(|i| std::array::from_fn(|k| f64::from(i == k)))),
        ),
        // Rows are counted.
        ("2.3", lesson02::freedoms(|j| j.ncols().saturating_sub(j.nrows()))),
        // What is removed, not what is left.
        ("2.3", lesson02::freedoms(|j| j.rank(1e-9))),
    ]
}
