use lcplab::lesson::exercise::{Verdict, newton};

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Everything is taken to end at rest: weights are summed, contacts may pull.
        (
            "3.1",
            newton::column(|m, u| {
                (0..m.len()).map(|k| -(k..m.len()).map(|j| m[j] * u[j]).sum::<f64>()).collect()
            }),
        ),
        // The same with a clamp, from the top down: what pushes is taken to end at rest.
        (
            "3.1",
            newton::column(|m, u| {
                let mut x = vec![0.0; m.len() + 1];
                for k in (0..m.len()).rev() {
                    x[k] = f64::max(0.0, x[k + 1] - m[k] * u[k]);
                }
                x[..m.len()].to_vec()
            }),
        ),
        // Each ball joins the one below it at most once: groups do not join again.
        (
            "3.1",
            newton::column(|m, u| {
                let mut v = u.to_vec();
                v[0] = v[0].max(0.0);
                for k in 1..m.len() {
                    if v[k] < v[k - 1] {
                        let both = (m[k - 1] * v[k - 1] + m[k] * v[k]) / (m[k - 1] + m[k]);
                        (v[k - 1], v[k]) = (both.max(0.0), both.max(0.0));
                    }
                }
                let given = |j: usize| m[j] * (v[j] - u[j]);
                (0..m.len()).map(|k| (k..m.len()).map(given).sum()).collect()
            }),
        ),
        // Masses are left out.
        (
            "3.2",
            newton::delassus(|j, _| {
                std::array::from_fn(|i| std::array::from_fn(|k| dot(j[i], j[k])))
            }),
        ),
        // Jᵀ M⁻¹ J.
        (
            "3.2",
            newton::delassus(|j, inverse| {
                let entry =
                    |i: usize, k: usize| (0..3).map(|r| j[r][i] * inverse[r] * j[r][k]).sum();
                std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k)))
            }),
        ),
        // The impulse is taken to bend the path too.
        (
            "3.3",
            newton::two_levels(|m, l, g, phi, omega, dt| {
                let force = -m * (g * phi.cos() + l * omega * omega);
                [dt * force, force]
            }),
        ),
        // A pull counted as a push.
        (
            "3.3",
            newton::two_levels(|m, l, g, phi, omega, dt| {
                let weight = m * g * phi.cos();
                [dt * weight, weight + m * l * omega * omega]
            }),
        ),
        // dt before all of b.
        (
            "3.b",
            newton::step(|inverse, u, f, dt| {
                let pull = inverse[1] * f[1] - inverse[0] * f[0];
                row(inverse, u, f, dt, dt * (u[1] - u[0] + pull))
            }),
        ),
        // The force is left out of b.
        ("3.b", newton::step(|inverse, u, f, dt| row(inverse, u, f, dt, u[1] - u[0]))),
        // The contact holds like a joint.
        (
            "3.b",
            newton::step(|inverse, u, f, dt| {
                let free = [0, 1].map(|k| u[k] + dt * inverse[k] * f[k]);
                let x = -(free[1] - free[0]) / (inverse[0] + inverse[1]);
                [free[0] - inverse[0] * x, free[1] + inverse[1] * x]
            }),
        ),
    ]
}

/// The step of 3.b with any b.
fn row(inverse: [f64; 2], u: [f64; 2], f: [f64; 2], dt: f64, b: f64) -> [f64; 2] {
    let x = f64::max(0.0, -b / (inverse[0] + inverse[1]));
    [u[0] + inverse[0] * (dt * f[0] - x), u[1] + inverse[1] * (dt * f[1] + x)]
}
