use lcplab::lesson::exercise::{Verdict, lesson04};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Jacobi: every row sees the old x.
        (
            "4.1",
            lesson04::sweep(|a, b, lo, hi, x| {
                let w = |i: usize| b[i] + (0..3).map(|j| a[i][j] * x[j]).sum::<f64>();
                (0..3).map(|i| (x[i] - w(i) / a[i][i]).clamp(lo[i], hi[i])).collect()
            }),
        ),
        // Code 6: the clamp after the sweep.
        (
            "4.1",
            lesson04::sweep(|a, b, lo, hi, mut x| {
                for i in 0..3 {
                    let w = b[i] + (0..3).map(|j| a[i][j] * x[j]).sum::<f64>();
                    x[i] -= w / a[i][i];
                }
                (0..3).map(|i| x[i].clamp(lo[i], hi[i])).collect()
            }),
        ),
        // The increment is clamped, not the sum.
        (
            "4.2",
            lesson04::impulse(|v, inverse_mass, total| {
                let push = f64::max(0.0, -v / inverse_mass);
                (v + push * inverse_mass, total + push)
            }),
        ),
        // An equality: the contact pulls.
        ("4.2", lesson04::impulse(|v, inverse_mass, total| (0.0, total - v / inverse_mass))),
        // The root is forgotten.
        ("4.3", lesson04::omega(|jacobi| 2.0 / (1.0 + (1.0 - jacobi * jacobi)))),
        // Gauss-Seidel's radius in place of Jacobi's.
        ("4.3", lesson04::omega(|jacobi| 2.0 / (1.0 + (1.0 - jacobi.powi(4)).sqrt()))),
    ]
}
