//! E63: λ is a force, note on λ.

use super::common::{answer, contacts};
use super::setting::{DT, G};
use super::{Finding, Measure};
use crate::error::Result;

/// λ of a ball of 1 kg at rest on the floor, with these units of length (m), time (s) and mass
/// (kg).
fn load(length: f64, time: f64, mass: f64) -> Result<f64> {
    let (m, g, dt) = (1.0 / mass, G / length * time * time, DT / time);
    let x = answer("pgs", &contacts(&[1.0 / m], &[-g * dt])?)?;
    Ok(x[0] / dt)
}

pub(super) fn example() -> Result<Finding> {
    let si = load(1.0, 1.0, 1.0)?;
    let measure = |quantity: &str, length: f64, time: f64, mass: f64| -> Result<Measure> {
        let newton = time * time / (mass * length); // kg m s⁻² in the new units
        let measure = Measure::new(quantity, "", 1.0, newton);
        Ok(measure.truth(&[load(length, time, mass)? / si], "solved in both", 1e-6 * newton))
    };
    Ok(Finding::new(
        "A ball of 1 kg rests on the floor, g = 9.81 m/s², a step of 1/60 s; λ = x/dt. The same problem is set up \
         and solved in other units: by what factor does the number λ change? A strain would keep its number.",
    )
    .measure(measure("mm in place of m", 1e-3, 1.0, 1.0)?)
    .measure(measure("ms in place of s", 1.0, 1e-3, 1.0)?)
    .measure(measure("g in place of kg", 1.0, 1.0, 1e-3)?))
}
