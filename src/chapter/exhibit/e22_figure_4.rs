//! E22: the derivation of the constraint equation, K&M Figure 4.

use nalgebra::DMatrix;

use super::common::{answer, equations, product};
use super::setting::{DT, G};
use super::{Evidence, Exhibit, Finding, Measure, Severity};
use crate::error::Result;

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E22",
    title: "the derivation loses a sign",
    place: "K&M Figure 4",
    severity: Severity::Wrong,
    may_be_scan: true,
    printed: "F = J λ; result: J M⁻¹ Jᵀ λ dt = J (v + M⁻¹ F dt) ≥ 0",
    holds: "F = Jᵀ λ; J M⁻¹ Jᵀ λ dt = −J (v + M⁻¹ F dt) for an equality; for a contact \
            J (v + M⁻¹ F dt) + J M⁻¹ Jᵀ λ dt ≥ 0, λ ≥ 0, and one of the two is 0.",
    why: "J has a row a constraint, so it takes velocities, and its transpose takes λ. What is moved to the \
          other side of an equation changes its sign: with the printed one the constraint doubles what it \
          is to cancel. The plus would fit F = −Jᵀ λ, as Code 7 has it; but the figure does not.",
    evidence: Evidence::Example(example),
};

/// Two bodies that are pressed apart, and a ball on the floor.
fn example() -> Result<Finding> {
    let (j, lambda) =
        (DMatrix::from_row_slice(1, 2, &[-1.0, 1.0]), DMatrix::from_element(1, 1, 3.0));
    let forces =
        Measure::new("forces", "N", product(&j, &lambda), product(&j.transpose(), &lambda));
    let unconstrained = -1.0 - G * DT;
    // w = A x + b = 0 with A = 1; the printed line is A x = J u*, so its b is −J u*.
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
