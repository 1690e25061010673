//! Exercise 1.3: two rows, by trying the four cases.
//!
//! Find x ≥ 0 with w = A x + b ≥ 0 and x[i] w[i] = 0 for both rows. A is symmetric, positive
//! definite.

/// The answer of the two-row problem.
pub fn answer(a: [[f64; 2]; 2], b: [f64; 2]) -> [f64; 2] {
    let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    let both = [(a[0][1] * b[1] - a[1][1] * b[0]) / det, (a[1][0] * b[0] - a[0][0] * b[1]) / det];
    let cases = [[0.0, 0.0], [-b[0] / a[0][0], 0.0], [0.0, -b[1] / a[1][1]], both];
    let fits = |x: &[f64; 2]| {
        (0..2).all(|i| x[i] >= 0.0 && a[i][0] * x[0] + a[i][1] * x[1] + b[i] >= -1e-12)
    };
    cases.into_iter().find(fits).unwrap_or([f64::NAN; 2])
}
