//! Find the bug 4.b: sweeps over contacts.
//!
//! The program should solve w = A x + b ≥ 0, x ≥ 0, x w = 0 by projected Gauss-Seidel; A is
//! symmetric, positive definite. Its users say: "As long as all contacts push it is right. When one
//! of them leaves, its neighbor goes on closing or is thrown off, however many sweeps we allow.
//! With a box on three contacts the impulses grew without end." There is exactly one mistake.

/// x after so many sweeps.
pub fn answer(a: &[Vec<f64>], b: &[f64], sweeps: usize) -> Vec<f64> {
    let n = b.len();
    let mut x = vec![0.0; n];
    for _sweep in 0..sweeps {
        // Gauss-Seidel: with the newest x, each row makes its own w zero.
        for i in 0..n {
            let w = b[i] + (0..n).map(|j| a[i][j] * x[j]).sum::<f64>();
            x[i] -= w / a[i][i];
        }
        // No contact pulls.
        for i in 0..n {
            x[i] = f64::max(0.0, x[i]);
        }
    }
    x
}
