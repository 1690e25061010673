//! Projected Gauss-Seidel (K&M (2), (3)).

use super::{Matrix, Vector};

/// x after this many sweeps from 0: each row in turn makes its own w zero, as far as its bounds
/// allow.
pub fn gauss_seidel(A: &Matrix, b: &Vector, lo: &Vector, hi: &Vector, sweeps: usize) -> Vector {
    let n = b.len();
    let mut x = Vector::zeros(n);
    for _ in 0..sweeps {
        for i in 0..n {
            let w = A.row(i).transpose().dot(&x) + b[i]; // with the new x of this sweep
            x[i] = (x[i] - w / A[(i, i)]).clamp(lo[i], hi[i]);
        }
    }
    x
}
