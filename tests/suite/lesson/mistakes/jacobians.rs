use lcplab::lesson::exercise::{Verdict, jacobians};

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // The vector is not made a unit vector.
        ("2.1", jacobians::rod(|p, v| (p, dot(v, v) / dot(p, p).sqrt()))),
        // A rod that does not turn.
        ("2.1", jacobians::rod(|p, _| (p.map(|x| x / dot(p, p).sqrt()), 0.0))),
        // The velocity along the rod is taken to bend it too.
        (
            "2.1",
            jacobians::rod(|p, v| {
                let length = dot(p, p).sqrt();
                (p.map(|x| x / length), dot(v, v) / length)
            }),
        ),
        // r × ω for ω × r.
        (
            "2.2",
            jacobians::nail(|[x, y, z]| {
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
            jacobians::nail(|_| {
                std::array::from_fn(|i| std::array::from_fn(|k| f64::from(i == k)))
            }),
        ),
        // The direction from center to center, not from end to end.
        ("2.3", jacobians::two_ends(|p, r| rod(p, r, [[0.0; 3]; 2], 1.0))),
        // Not a unit vector.
        (
            "2.3",
            jacobians::two_ends(|p, r| {
                let d: [f64; 3] = std::array::from_fn(|k| p[1][k] + r[1][k] - p[0][k] - r[0][k]);
                rod(p, r, r, 1.0).map(|entry| entry * dot(d, d).sqrt())
            }),
        ),
        // n × r for r × n.
        ("2.3", jacobians::two_ends(|p, r| rod(p, r, r, -1.0))),
        // The turning is forgotten.
        ("2.3", jacobians::two_ends(|p, r| rod(p, r, r, 0.0))),
        // Mended at body 0 as well.
        ("2.b", jacobians::contact(|c, p, n| touch(c, p, n, [-1.0, 1.0], [-1.0, 1.0]).map(|j| -j))),
        // Both turns with the other sign.
        ("2.b", jacobians::contact(|c, p, n| touch(c, p, n, [-1.0, 1.0], [1.0, -1.0]))),
        // Both with the same sign.
        ("2.b", jacobians::contact(|c, p, n| touch(c, p, n, [-1.0, 1.0], [1.0, 1.0]))),
    ]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A rod whose direction is taken with the arms `towards`, and its turns times a factor.
fn rod(p: [[f64; 3]; 2], r: [[f64; 3]; 2], towards: [[f64; 3]; 2], turn: f64) -> [f64; 12] {
    let d: [f64; 3] = std::array::from_fn(|k| p[1][k] + towards[1][k] - p[0][k] - towards[0][k]);
    let n = d.map(|d_k| d_k / dot(d, d).sqrt());
    let turns = [cross(r[0], n), cross(r[1], n)];
    std::array::from_fn(|k| match k {
        0..3 => -n[k],
        3..6 => -turn * turns[0][k - 3],
        6..9 => n[k - 6],
        _ => turn * turns[1][k - 9],
    })
}

/// A contact's row: ± n and ± r × n for each body.
fn touch(
    centers: [[f64; 3]; 2],
    point: [f64; 3],
    normal: [f64; 3],
    push: [f64; 2],
    turn: [f64; 2],
) -> [f64; 12] {
    let n = normal.map(|entry| entry / dot(normal, normal).sqrt());
    std::array::from_fn(|k| {
        let arm = std::array::from_fn(|i| point[i] - centers[k / 6][i]);
        if k % 6 < 3 { push[k / 6] * n[k % 3] } else { turn[k / 6] * cross(arm, n)[k % 3] }
    })
}
