//! An interior-point method: along the central path x_i w_i = μ, μ → 0.

use super::{Matrix, Real, Vector, ldlt, solve};

/// x after this many steps towards 0 ≤ x ⟂ A x + b ≥ 0, A symmetric and semidefinite; about thirty
/// steps give full precision.
pub fn interior_point<T: Real>(A: &Matrix<T>, b: &Vector<T>, steps: usize) -> Vector<T> {
    interior_point_with(A, b, steps, |A, r| {
        let (L, D) = ldlt(A);
        solve(&L, &D, r)
    })
}

/// The same, with a function that solves A x = r, say in another precision.
pub fn interior_point_with<T: Real>(
    A: &Matrix<T>,
    b: &Vector<T>,
    steps: usize,
    solve: impl Fn(&Matrix<T>, &Vector<T>) -> Vector<T>,
) -> Vector<T> {
    let n = b.len();
    let (mut x, mut w) = (Vector::repeat(n, T::one()), Vector::repeat(n, T::one()));
    for _ in 0..steps {
        let mu = T::nearest(0.1) * x.dot(&w) / T::nearest(n as f64); // a tenth of what it is now
        let miss = A * &x + b - &w;
        // Newton's step on w = A x + b and x_i w_i = μ, with dw eliminated: (A + diag(w/x))
        // dx = −(A x + b − w) − (w − μ/x)
        let diagonal = Matrix::from_diagonal(&w.component_div(&x));
        let dx = solve(&(A + &diagonal), &(-&miss - &w + x.map(|x| mu / x)));
        let dw = A * &dx + &miss;
        let length = farthest(&x, &dx).min(farthest(&w, &dw)).min(T::one());
        x += dx * length;
        w += dw * length;
    }
    x
}

/// The step length at which the first entry becomes 0, reduced by one percent.
fn farthest<T: Real>(v: &Vector<T>, dv: &Vector<T>) -> T {
    let ends = v.iter().zip(dv).filter(|(_, dv)| **dv < T::zero()).map(|(v, dv)| -*v / *dv);
    T::nearest(0.99) * ends.fold(T::nearest(f64::INFINITY), T::min)
}
