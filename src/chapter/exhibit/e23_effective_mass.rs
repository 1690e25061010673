//! E23: K = J M⁻¹ Jᵀ called the effective mass.

use nalgebra::{DMatrix, DVector};

use super::{Finding, Measure};
use crate::error::Result;

/// One body, and two in a line.
pub(super) fn example() -> Result<Finding> {
    let k = |j: &[f64], masses: &[f64]| {
        let j = DMatrix::from_row_slice(1, j.len(), j);
        let inverse = DVector::from_iterator(masses.len(), masses.iter().map(|m| 1.0 / m));
        (&j * DMatrix::from_diagonal(&inverse) * j.transpose())[0]
    };
    let (one, two) = (k(&[1.0], &[2.0]), k(&[-1.0, 1.0], &[1.0, 3.0]));
    let alone = Measure::new("one body", "kg", one, 1.0 / one);
    let pair = Measure::new("two bodies", "kg", two, 1.0 / two);
    Ok(Finding::new(
        "The effective mass of a body of 2 kg against a push along its way, J = 1; then of two bodies of 1 \
         and 3 kg against a push between them, J = (−1, 1).",
    )
    .measure(alone.truth(&[2.0], "m", 1e-12))
    .measure(pair.truth(&[0.75], "m₁m₂ / (m₁ + m₂)", 1e-12)))
}
