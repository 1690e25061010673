//! Projected Jacobi with damping.

use super::{Matrix, Vector};

/// x after this many sweeps from 0: all rows at once make their own w zero, or move a fraction of
/// the distance.
pub fn jacobi(
    A: &Matrix,
    b: &Vector,
    lo: &Vector,
    hi: &Vector,
    damping: f64,
    sweeps: usize,
) -> Vector {
    let mut x = Vector::zeros(b.len());
    for _ in 0..sweeps {
        let w = A * &x + b; // with the x of the sweep before
        x = Vector::from_fn(b.len(), |i, _| {
            (x[i] - damping * w[i] / A[(i, i)]).clamp(lo[i], hi[i])
        });
    }
    x
}
