use lcplab::lesson::exercise::{Verdict, lesson03};

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // The force as if it were an impulse.
        ("3.1", lesson03::offset(|j, u, f, inverse, _| dot(j, u) + inverse * dot(j, f))),
        // The other side of the equation.
        ("3.1", lesson03::offset(|j, u, f, inverse, dt| -dot(j, u) - dt * inverse * dot(j, f))),
        // Masses are left out.
        (
            "3.2",
            lesson03::delassus(|j, _| {
                std::array::from_fn(|i| std::array::from_fn(|k| dot(j[i], j[k])))
            }),
        ),
        // Jᵀ M⁻¹ J.
        (
            "3.2",
            lesson03::delassus(|j, inverse| {
                let entry =
                    |i: usize, k: usize| (0..3).map(|r| j[r][i] * inverse[r] * j[r][k]).sum();
                std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k)))
            }),
        ),
        // The impulse is taken to bend the path too.
        (
            "3.3",
            lesson03::two_levels(|m, l, g, phi, omega, dt| {
                let force = -m * (g * phi.cos() + l * omega * omega);
                [dt * force, force]
            }),
        ),
        // A pull counted as a push.
        (
            "3.3",
            lesson03::two_levels(|m, l, g, phi, omega, dt| {
                let weight = m * g * phi.cos();
                [dt * weight, weight + m * l * omega * omega]
            }),
        ),
    ]
}
