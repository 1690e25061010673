//! The factors of a symmetric matrix.

use super::{Matrix, Real, Vector};

/// A = L D Lᵀ: L with ones on its diagonal and nothing above, D diagonal.
pub fn ldlt<T: Real>(A: &Matrix<T>) -> (Matrix<T>, Vector<T>) {
    let n = A.nrows();
    let (mut L, mut D) = (Matrix::identity(n, n), Vector::zeros(n));
    for j in 0..n {
        D[j] = A[(j, j)] - (0..j).map(|k| L[(j, k)] * D[k] * L[(j, k)]).sum::<T>();
        for i in j + 1..n {
            let sum: T = (0..j).map(|k| L[(i, k)] * D[k] * L[(j, k)]).sum();
            L[(i, j)] = (A[(i, j)] - sum) / D[j];
        }
    }
    (L, D)
}

/// The solution x of L D Lᵀ x = r.
pub fn solve<T: Real>(L: &Matrix<T>, D: &Vector<T>, r: &Vector<T>) -> Vector<T> {
    let mut x = r.clone();
    for i in 0..x.len() {
        let sum: T = (0..i).map(|k| L[(i, k)] * x[k]).sum(); // down: L y = r
        x[i] -= sum;
    }
    x.component_div_assign(D);
    for i in (0..x.len()).rev() {
        let sum: T = (i + 1..x.len()).map(|k| L[(k, i)] * x[k]).sum(); // up: Lᵀ x = D⁻¹ y
        x[i] -= sum;
    }
    x
}
