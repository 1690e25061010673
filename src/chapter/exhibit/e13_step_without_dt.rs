//! E13: the velocity equation lacks the time step, K&M's first velocity-level equation.

use super::common::{answer, contacts};
use super::setting::{DT, G};
use super::{Finding, Measure};
use crate::error::Result;

const V: f64 = -1.0;
const F: f64 = -G;

/// λ of a body of 1 kg: (a, b) of w = a λ + b ≥ 0, λ ≥ 0.
fn force(a: f64, b: f64) -> Result<f64> {
    Ok(answer("dantzig", &contacts(&[a], &[b])?)?[0])
}

/// A ball that hits the floor, with three steps.
pub(super) fn example() -> Result<Finding> {
    let mut finding = Finding::new(
        "A ball of 1 kg hits the floor at 1 m/s, g = 9.81 m/s². One row: printed A = 1, b = v − g; corrected \
         A = dt, b = v − g dt, in the sign of w = A x + b (here the chapter has the same). Either λ is put \
         into the integrator; the floor must leave no velocity.",
    );
    let velocity = |dt: f64, lambda: f64| V + dt * (F + lambda);
    for (name, dt) in [("1/60", 1.0 / 60.0), ("1/1000", 1e-3), ("1", 1.0)] {
        let printed = velocity(dt, force(1.0, V + F)?);
        let corrected = velocity(dt, force(dt, V + dt * F)?);
        let v = Measure::new(format!("v⁺, dt = {name} s"), "m/s", printed, corrected).truth(
            &[0.0],
            "the floor is rigid",
            1e-12,
        );
        finding = finding.measure(if dt == 1.0 { v.agreeing() } else { v });
    }
    let dt = DT;
    let lambda = Measure::new("λ, dt = 1/60 s", "N", force(1.0, V + F)?, force(dt, V + dt * F)?);
    Ok(finding.measure(lambda.truth(&[60.0 + 9.81], "m (v/dt + g)", 1e-9)))
}
