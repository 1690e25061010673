//! Exercise 14.1: a sweep without A.
//!
//! Bodies move along one line. Contact i lies between rows[i] = [first, second], its gap opens at
//! the velocity of the second minus that of the first; `None` is the ground, which does not move.
//! Do one sweep of projected Gauss-Seidel on w = A x + b ≥ 0, x ≥ 0, x w = 0, from the given x, the
//! rows in their order. Do not write A down: keep u = M⁻¹ Jᵀ x, a velocity for each body, and
//! change only those of the two bodies of a row.

/// x after one sweep.
pub fn answer(
    rows: &[[Option<usize>; 2]],
    inverse_mass: &[f64],
    b: &[f64],
    mut x: Vec<f64>,
) -> Vec<f64> {
    let mut u = vec![0.0; inverse_mass.len()];
    let give = |u: &mut [f64], i: usize, impulse: f64| {
        for (body, sign) in rows[i].into_iter().zip([-1.0, 1.0]) {
            if let Some(k) = body {
                u[k] += sign * inverse_mass[k] * impulse;
            }
        }
    };
    for i in 0..rows.len() {
        give(&mut u, i, x[i]); // what the old x has done
    }
    for i in 0..rows.len() {
        let of = |values: &[f64]| rows[i].map(|body| body.map_or(0.0, |k| values[k]));
        let ([v0, v1], [m0, m1]) = (of(&u), of(inverse_mass));
        let new = f64::max(0.0, x[i] - (v1 - v0 + b[i]) / (m0 + m1));
        give(&mut u, i, new - x[i]);
        x[i] = new;
    }
    x
}
