//! The semismooth Newton method on x = Π(x − w/s), s_i = a_ii (Qi & Sun 1993).

use super::{Matrix, Real, Vector, point};

/// The x of lo ≤ x ≤ hi with w > 0 only where x = lo and w < 0 only where x = hi, after at most
/// this number of steps; A symmetric and definite. The method can cycle; then x is wrong.
///
/// With z = x − w/s, the equations x = Π(z) are linear while no z_i passes a bound: w_i = 0 where
/// lo_i < z_i < hi_i, elsewhere x_i = Π(z_i). A step solves them; if z is on the same sides as
/// before, x is the solution.
pub fn newton<T: Real>(
    A: &Matrix<T>,
    b: &Vector<T>,
    lo: &Vector<T>,
    hi: &Vector<T>,
    steps: usize,
) -> Vector<T> {
    newton_with(A, b, lo, hi, steps, point).expect("A_FF is regular")
}

/// The same, with a function that solves A_FF x_F = −b_F, say in another precision; `None` if it
/// returns `None`.
pub fn newton_with<T: Real>(
    A: &Matrix<T>,
    b: &Vector<T>,
    lo: &Vector<T>,
    hi: &Vector<T>,
    steps: usize,
    point: impl Fn(&Matrix<T>, &Vector<T>, &[bool]) -> Option<Vector<T>>,
) -> Option<Vector<T>> {
    let (n, zero) = (b.len(), T::zero());
    let mut x = Vector::from_fn(n, |i, _| zero.clamp(lo[i], hi[i]));
    let mut before = None;
    for _ in 0..steps {
        let w = A * &x + b;
        let z = Vector::from_fn(n, |i, _| x[i] - w[i] / A[(i, i)]);
        let free: Vec<bool> = (0..n).map(|i| lo[i] < z[i] && z[i] < hi[i]).collect();
        let fixed =
            Vector::from_fn(n, |i, _| if free[i] { zero } else { z[i].clamp(lo[i], hi[i]) });
        let sides = Some((free.clone(), fixed.clone()));
        if sides == before {
            break;
        }
        x = &fixed + point(A, &(A * &fixed + b), &free)?; // A_FF x_F = −(A x_B + b)_F
        before = sides;
    }
    Some(x)
}
