//! An interior-point method: along the central path x_i w_i = μ, μ → 0.

use super::{Matrix, Vector, ldlt, solve};

/// x after this many steps towards 0 ≤ x ⟂ A x + b ≥ 0, A symmetric and semidefinite; about thirty
/// steps give full precision.
pub fn interior_point(A: &Matrix, b: &Vector, steps: usize) -> Vector {
    let n = b.len();
    let (mut x, mut w) = (Vector::repeat(n, 1.0), Vector::repeat(n, 1.0));
    for _ in 0..steps {
        let mu = 0.1 * x.dot(&w) / n as f64; // a tenth of what it is now
        let miss = A * &x + b - &w;
        // Newton's step on w = A x + b and x_i w_i = μ, with dw eliminated: (A + diag(w/x))
        // dx = −(A x + b − w) − (w − μ/x)
        let diagonal = Matrix::from_diagonal(&w.component_div(&x));
        let (L, D) = ldlt(&(A + &diagonal));
        let dx = solve(&L, &D, &(-&miss - &w + mu * x.map(|x| 1.0 / x)));
        let dw = A * &dx + &miss;
        let length = farthest(&x, &dx).min(farthest(&w, &dw)).min(1.0);
        x += length * dx;
        w += length * dw;
    }
    x
}

/// The step length at which the first entry becomes 0, reduced by one percent.
fn farthest(v: &Vector, dv: &Vector) -> f64 {
    let ends = v.iter().zip(dv).filter(|(_, dv)| **dv < 0.0).map(|(v, dv)| -v / dv);
    0.99 * ends.fold(f64::INFINITY, f64::min)
}
