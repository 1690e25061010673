//! Lemke's method, which follows a path without branches.

use super::{Matrix, Vector};

/// The x of 0 ≤ x ⟂ A x + b ≥ 0, or `None` if the path ends on a ray.
///
/// The tableau represents w = A x + z₀ e + b. Variable i is w_i, n + i is x_i, 2n is the artificial
/// variable z₀; those in `basis` are on the left, the others are 0.
pub fn lemke(A: &Matrix, b: &Vector) -> Option<Vector> {
    let n = b.len();
    let mut T = Matrix::zeros(n, 2 * n + 2); // [I | −A | −e | b]: I w − A x − e z₀ = b
    T.view_mut((0, 0), (n, n)).fill_with_identity();
    T.view_mut((0, n), (n, n)).copy_from(&-A);
    T.column_mut(2 * n).fill(-1.0);
    T.column_mut(2 * n + 1).copy_from(b);
    let mut basis: Vec<usize> = (0..n).collect();
    if b.iter().all(|&b| b >= 0.0) {
        return Some(Vector::zeros(n)); // nothing to cover
    }
    let mut row = b.imin(); // z₀ enters with the least value that covers all
    let mut entering = 2 * n;
    loop {
        pivot(&mut T, row, entering);
        let leaving = std::mem::replace(&mut basis[row], entering);
        if leaving == 2 * n {
            break; // z₀ is gone
        }
        entering = if leaving < n { leaving + n } else { leaving - n }; // the partner
        let falls = (0..n).filter(|&i| T[(i, entering)] > 0.0);
        let ratio = |i: &usize| T[(*i, 2 * n + 1)] / T[(*i, entering)];
        row = falls.min_by(|i, j| ratio(i).total_cmp(&ratio(j)))?; // `None`: a ray
    }
    let mut x = Vector::zeros(n);
    for (i, &variable) in basis.iter().enumerate().filter(|(_, variable)| **variable >= n) {
        x[variable - n] = T[(i, 2 * n + 1)];
    }
    Some(x)
}

/// Solves equation `row` for the variable `entering` and substitutes it into the others.
fn pivot(T: &mut Matrix, row: usize, entering: usize) {
    let own = T.row(row) / T[(row, entering)];
    for i in 0..T.nrows() {
        let other = T.row(i) - T[(i, entering)] * &own;
        T.set_row(i, if i == row { &own } else { &other });
    }
}
