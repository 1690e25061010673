//! Murty's rule.

use super::{Matrix, Vector, point};

/// The x of 0 ≤ x ⟂ A x + b ≥ 0, A a P-matrix.
pub fn murty(A: &Matrix, b: &Vector) -> Vector {
    let mut free = vec![false; b.len()];
    loop {
        let x = point(A, b, &free).expect("A_FF is regular"); // A_FF x_F = −b_F, x_B = 0
        let w = A * &x + b;
        let wrong = (0..b.len()).find(|&i| if free[i] { x[i] < 0.0 } else { w[i] < 0.0 });
        let Some(i) = wrong else { return x };
        free[i] = !free[i]; // the first wrong row changes sides
    }
}
