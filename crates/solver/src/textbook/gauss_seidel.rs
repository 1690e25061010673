//! Projected Gauss-Seidel (K&M (2), (3)).

use super::{Matrix, Real, Vector};

/// x after this many sweeps from 0: each row in turn makes its own w zero, as far as its bounds
/// allow.
pub fn gauss_seidel<T: Real>(
    A: &Matrix<T>,
    b: &Vector<T>,
    lo: &Vector<T>,
    hi: &Vector<T>,
    sweeps: usize,
) -> Vector<T> {
    let n = b.len();
    let mut x = Vector::zeros(n);
    for _ in 0..sweeps {
        for i in 0..n {
            let sum: T = (0..n).map(|j| A[(i, j)] * x[j]).sum(); // with the new x of this sweep
            let w = sum + b[i];
            x[i] = (x[i] - w / A[(i, i)]).clamp(lo[i], hi[i]);
        }
    }
    x
}
