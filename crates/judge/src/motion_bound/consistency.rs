//! Whether the A and b of a file are those of its bodies.
//!
//! The motion error is about M, J, bias, γ and u*. If A and b were made from other numbers, an
//! exact solution of the file has a motion error, too, for which no solver is to blame.

use super::mass::Mass;
use lcplab_lcp::{Gauss, Lcp};

/// Smaller differences, relative to the terms of a row, may be rounding, also in 32 bits.
const NOTABLE: f64 = 1e-4;
/// Smaller terms of a row, relative to those of the largest row, are rounding.
const DUST: f64 = 1e-9;

/// The row in which A x + b differs most from J u(x) + bias + γ x, where u(x) = u* + M⁻¹Jᵀx, and
/// the difference relative to the terms of the row; `None` if it may be rounding.
///
/// ```
/// use lcplab_judge::motion_bound::inconsistent_row;
/// use lcplab_lcp::{Gauss, Lcp, Matrix};
///
/// // 2 kg fall at 3 m/s on one contact of compliance ½ s/kg: A = 1/2 + 1/2, b = −3.
/// let gauss = Gauss {
///     mass: vec![(0, 0, 2.0)],
///     jacobian: vec![vec![(0, 1.0)]],
///     bias: vec![0.0],
///     compliance: vec![0.5],
///     target: vec![-3.0],
///     lo: vec![0.0],
///     hi: vec![f64::INFINITY],
///     level: None,
/// };
/// let lcp = Lcp::new(Matrix::from([[1.0]]), vec![-3.0], vec![0.0], vec![f64::INFINITY])?;
/// assert_eq!(inconsistent_row(&gauss, &lcp, &[3.0]), None);
/// let other = lcp.with_b(vec![-2.0])?; // as if it fell at 2 m/s
/// assert!(matches!(inconsistent_row(&gauss, &other, &[3.0]), Some((0, _))));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn inconsistent_row(gauss: &Gauss, lcp: &Lcp, x: &[f64]) -> Option<(usize, f64)> {
    let mass = Mass::new(&gauss.mass, gauss.target.len()).ok()?;
    let mut force = vec![0.0; gauss.target.len()];
    for (row, x) in gauss.jacobian.iter().zip(x) {
        row.iter().for_each(|&(j, value)| force[j] += mass.scales[j] * value * x);
    }
    let change = mass.solve(&force);
    let motion = |j: usize| gauss.target[j] + mass.scales[j] * change[j];
    let difference = |i: usize| {
        let own = gauss.jacobian[i].iter().map(|&(j, value)| value * motion(j));
        let own = own.chain([gauss.bias[i], gauss.compliance[i] * x[i]]);
        let (w, terms) = own.fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
        let given = lcp.matrix().row(i).iter().map(|(j, a)| (a * x[j]).abs()).sum::<f64>();
        (f64::abs(lcp.row_w(i, x) - w), terms + given + lcp.b()[i].abs())
    };
    let rows: Vec<(f64, f64)> = (0..x.len()).map(difference).collect();
    let least = DUST * rows.iter().map(|row| row.1).fold(0.0, f64::max);
    let relative = rows.iter().map(|(difference, terms)| difference / terms.max(least)).enumerate();
    relative.filter(|(_, part)| *part > NOTABLE).max_by(|a, b| a.1.total_cmp(&b.1))
}
