//! Dantzig's method in Baraff's formulation: row after row joins the satisfied ones.

use super::{Matrix, Real, Vector, point};

/// The x of lo ≤ x ≤ hi with w > 0 only where x = lo and w < 0 only where x = hi; A symmetric and
/// definite.
///
/// Rows 0 … k − 1 are satisfied and stay so while row k moves: free rows keep w = 0, the others
/// keep their x.
pub fn dantzig<T: Real>(A: &Matrix<T>, b: &Vector<T>, lo: &Vector<T>, hi: &Vector<T>) -> Vector<T> {
    dantzig_with(A, b, lo, hi, point).expect("A_FF is regular")
}

/// The same, with a function that solves A_FF x_F = −b_F, say in another precision; `None` if it
/// returns `None`.
pub fn dantzig_with<T: Real>(
    A: &Matrix<T>,
    b: &Vector<T>,
    lo: &Vector<T>,
    hi: &Vector<T>,
    point: impl Fn(&Matrix<T>, &Vector<T>, &[bool]) -> Option<Vector<T>>,
) -> Option<Vector<T>> {
    let (n, zero) = (b.len(), T::zero());
    let mut x = Vector::from_fn(n, |i, _| zero.clamp(lo[i], hi[i]));
    let mut w = A * &x + b;
    let mut free = vec![false; n];
    for k in 0..n {
        loop {
            let bound = if w[k] > zero { lo[k] } else { hi[k] };
            if w[k] == zero || x[k] == bound {
                free[k] = lo[k] < x[k] && x[k] < hi[k];
                break; // row k is satisfied
            }
            let sign = (bound - x[k]).signum();
            // x_k changes by one unit, free rows keep their w, the others keep their x.
            let mut d = point(A, &(A.column(k) * sign), &free)?; // A_FF d_F = −A_Fk d_k
            d[k] = sign;
            let v = A * &d; // how fast w changes along d
            // How far until w_k is 0, or x_k is at its bound, or an earlier row reaches the end of
            // its side?
            let mut first = (-w[k] / v[k], k, true);
            let mut ends_at = |length: T, i: usize, becomes_free: bool| {
                if length < first.0 {
                    first = (length, i, becomes_free);
                }
            };
            ends_at((bound - x[k]) / d[k], k, false);
            for i in 0..k {
                let leaves_bound = if x[i] == lo[i] { v[i] < zero } else { v[i] > zero };
                if free[i] && d[i] != zero {
                    ends_at((if d[i] > zero { hi[i] } else { lo[i] } - x[i]) / d[i], i, false);
                } else if !free[i] && lo[i] < hi[i] && leaves_bound {
                    ends_at(-w[i] / v[i], i, true);
                }
            }
            let (length, i, becomes_free) = first;
            x += &d * length;
            w += &v * length;
            free[i] = becomes_free;
            match becomes_free {
                true => w[i] = zero,
                false => x[i] = if d[i] > zero { hi[i] } else { lo[i] },
            }
        }
    }
    Some(x)
}
