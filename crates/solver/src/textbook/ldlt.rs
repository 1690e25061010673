//! The factors of a symmetric matrix.

use super::{Matrix, Vector};

/// A = L D Lᵀ: L with ones on its diagonal and nothing above, D diagonal.
pub fn ldlt(A: &Matrix) -> (Matrix, Vector) {
    let n = A.nrows();
    let (mut L, mut D) = (Matrix::identity(n, n), Vector::zeros(n));
    for j in 0..n {
        D[j] = A[(j, j)] - (0..j).map(|k| L[(j, k)] * D[k] * L[(j, k)]).sum::<f64>();
        for i in j + 1..n {
            let sum: f64 = (0..j).map(|k| L[(i, k)] * D[k] * L[(j, k)]).sum();
            L[(i, j)] = (A[(i, j)] - sum) / D[j];
        }
    }
    (L, D)
}

/// The solution x of L D Lᵀ x = r.
pub fn solve(L: &Matrix, D: &Vector, r: &Vector) -> Vector {
    let mut x = r.clone();
    for i in 0..x.len() {
        x[i] -= (0..i).map(|k| L[(i, k)] * x[k]).sum::<f64>(); // down: L y = r
    }
    x.component_div_assign(D);
    for i in (0..x.len()).rev() {
        x[i] -= (i + 1..x.len()).map(|k| L[(k, i)] * x[k]).sum::<f64>(); // up: Lᵀ x = D⁻¹ y
    }
    x
}
