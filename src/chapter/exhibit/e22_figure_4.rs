//! E22: the derivation of the constraint equation, K&M Figure 4.

use nalgebra::DMatrix;

use super::common::{answer, equations, product};
use super::setting::{DT, G};
use super::{Finding, Measure};
use crate::error::Result;

/// Two bodies that are pushed apart, and a ball on the floor.
pub(super) fn example() -> Result<Finding> {
    let (j, lambda) =
        (DMatrix::from_row_slice(1, 2, &[-1.0, 1.0]), DMatrix::from_element(1, 1, 3.0));
    let forces =
        Measure::new("forces", "N", product(&j, &lambda), product(&j.transpose(), &lambda));
    let unconstrained = -1.0 - G * DT;
    // w = A x + b = 0 with A = 1; the printed equation is A x = J u*, so its b is −J u*.
    let next = |b: f64| -> Result<f64> {
        Ok(unconstrained + answer("dantzig", &equations(&[1.0], &[b])?)?[0])
    };
    let velocity = Measure::new("v⁺", "m/s", next(-unconstrained)?, next(unconstrained)?);
    Ok(Finding::new(
        "Two bodies in a line, J = (−1, 1), pushed apart with λ = 3 N: the forces on both. Then a ball of \
         1 kg that comes to the floor at 1 m/s, J = 1, dt = 1/60 s: v + dt F/m = −1.1635 m/s. In the sign of \
         w = A x + b, corrected has b = −1.1635, printed b = 1.1635.",
    )
    .measure(forces.truth(&[-3.0, 3.0], "Newton's third law", 1e-12))
    .measure(velocity.truth(&[0.0], "the floor is rigid", 1e-12)))
}
