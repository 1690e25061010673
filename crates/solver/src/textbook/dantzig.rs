//! Dantzig's method in Baraff's formulation: row after row joins the satisfied ones.

use super::{Matrix, Vector, point};

/// The x of lo ≤ x ≤ hi with w > 0 only where x = lo and w < 0 only where x = hi; A symmetric and
/// definite.
///
/// Rows 0 … k − 1 are satisfied and stay so while row k moves: free rows keep w = 0, the others
/// keep their x.
pub fn dantzig(A: &Matrix, b: &Vector, lo: &Vector, hi: &Vector) -> Vector {
    let n = b.len();
    let mut x = Vector::from_fn(n, |i, _| 0.0_f64.clamp(lo[i], hi[i]));
    let mut w = A * &x + b;
    let mut free = vec![false; n];
    for k in 0..n {
        loop {
            let bound = if w[k] > 0.0 { lo[k] } else { hi[k] };
            if w[k] == 0.0 || x[k] == bound {
                free[k] = lo[k] < x[k] && x[k] < hi[k];
                break; // row k is satisfied
            }
            let d = direction(A, &free, k, (bound - x[k]).signum());
            let v = A * &d; // how fast w changes along d
            // How far until w_k is 0, or x_k is at its bound, or an earlier row reaches the end of
            // its side?
            let mut first = (-w[k] / v[k], k, true);
            let mut ends_at = |length: f64, i: usize, becomes_free: bool| {
                if length < first.0 {
                    first = (length, i, becomes_free);
                }
            };
            ends_at((bound - x[k]) / d[k], k, false);
            for i in 0..k {
                let leaves_bound = if x[i] == lo[i] { v[i] < 0.0 } else { v[i] > 0.0 };
                if free[i] && d[i] != 0.0 {
                    ends_at((if d[i] > 0.0 { hi[i] } else { lo[i] } - x[i]) / d[i], i, false);
                } else if !free[i] && lo[i] < hi[i] && leaves_bound {
                    ends_at(-w[i] / v[i], i, true);
                }
            }
            let (length, i, becomes_free) = first;
            x += length * &d;
            w += length * &v;
            free[i] = becomes_free;
            match becomes_free {
                true => w[i] = 0.0,
                false => x[i] = if d[i] > 0.0 { hi[i] } else { lo[i] },
            }
        }
    }
    x
}

/// The direction in which x_k changes by one unit, up or down by the sign, while free rows keep
/// their w and the others keep their x.
fn direction(A: &Matrix, free: &[bool], k: usize, sign: f64) -> Vector {
    let mut d = point(A, &(sign * A.column(k)), free); // A_FF d_F = −A_Fk d_k
    d[k] = sign;
    d
}
