//! The motion error that single precision must be expected to cause.
//!
//! Rounding leaves the rows of the equations w = 0 with residuals r. They change x by δx with A_FF
//! δx = r and the motion by δu = M⁻¹Jᵀδx, so |δu|²_M = rᵀA_FF⁻¹r.
//!
//! - Direct methods: each term of w_i = Σ_j a_ij x_j + b_i is rounded once, in one or the other
//!   stage, by [`ROUNDING`] of itself in the root mean square. For independent errors the mean of
//!   |δu|²_M is Σ (A_FF⁻¹)_ii r_i² with r_i² = ROUNDING² (Σ_j (a_ij x_j)² + b_i²).
//! - Sweeps: row i stops when w_i/a_ii is less than half the spacing of numbers at x_i. As x comes
//!   from 0, the residuals r_i = a_ii spacing(x_i)/2 all have the sign of x_i, and add up.
//!
//! To this the rounding of u*, of M⁻¹Jᵀx and of their sum u is added. An interior-point method has
//! no such prediction: its matrix A + diag(w/x) is worse conditioned than A_FF without limit.

use lcplab_solver::textbook::{Matrix, Real, Vector};

use super::TextbookSolver;

/// 2⁻²⁴/√(8 ln 2): the error is evenly distributed within half the spacing, and the
/// logarithm of the number within a power of two.
const ROUNDING: f64 = 0.424_660_900_144_009_5 / 16_777_216.0;
/// Smaller eigenvalues, of A scaled to the diagonal 1, belong to redundant rows.
const REDUNDANT: f64 = 1e-10;

/// The expected |δu|_M if rounding moves x, with these rows free.
pub(super) fn from_forces(
    solver: TextbookSolver,
    a: &Matrix,
    b: &Vector,
    free: &[usize],
    x: &Vector,
) -> f64 {
    if free.is_empty() {
        return 0.0;
    }
    let size = |i: usize| a[(i, i)].sqrt();
    let scaled = Matrix::from_fn(free.len(), free.len(), |r, c| {
        let (i, j) = (free[r], free[c]);
        a[(i, j)] / (size(i) * size(j))
    });
    let residuals = free.iter().map(|&i| match solver {
        TextbookSolver::Pgs => a[(i, i)] * half_spacing(x[i]) * x[i].signum() / size(i),
        _ => {
            let squares = (0..x.len()).map(|j| (a[(i, j)] * x[j]).powi(2)).sum::<f64>();
            ROUNDING * (squares + b[i].powi(2)).sqrt() / size(i)
        }
    });
    let residuals = Vector::from_iterator(free.len(), residuals);
    let eigen = scaled.symmetric_eigen();
    let square = |(value, direction): (&f64, Vector)| match solver {
        _ if *value < REDUNDANT => 0.0,
        TextbookSolver::Pgs => direction.dot(&residuals).powi(2) / value,
        _ => direction.component_mul(&residuals).norm_squared() / value,
    };
    let directions = eigen.eigenvectors.column_iter().map(|column| column.into_owned());
    eigen.eigenvalues.iter().zip(directions).map(square).sum::<f64>().sqrt()
}

/// The expected |δu|_M if rounding moves the velocities.
pub(super) fn from_velocities(mass: &Matrix, target: &Vector, u: &Vector) -> f64 {
    let square = |(k, (target, u)): (usize, (&f64, &f64))| {
        mass[(k, k)] * (target * target + (u - target).powi(2) + u * u)
    };
    ROUNDING * target.iter().zip(u).enumerate().map(square).sum::<f64>().sqrt()
}

/// Half the distance between numbers of single precision at x.
fn half_spacing(x: f64) -> f64 {
    let near = f32::nearest(x.abs());
    0.5 * (near.next_up() - near).double()
}
