//! Forces and impulses: where the time step belongs.

use super::common::{answer, contacts};
use super::setting::{DT, G, one, single};
use super::{Finding, Measure};
use crate::chapter::code::code01_unconstrained_step::Blocks;
use crate::chapter::code::{code02_constrained_step as code02, code04_drift_correction as code04};
use crate::document::notation::plain;
use crate::error::Result;
use crate::solver::{Dantzig, Pgs};

const V: f64 = -1.0;
const F: f64 = -G;

/// λ of a body of 1 kg: (a, b) of w = a λ + b ≥ 0, λ ≥ 0.
fn force(a: f64, b: f64) -> Result<f64> {
    Ok(answer(Dantzig::NAME, &contacts(&[a], &[b])?)?[0])
}

/// E13: the velocity equation lacks the time step, K&M's first velocity-level equation.
///
/// A ball that hits the floor, with three steps.
pub(super) fn step_without_dt() -> Result<Finding> {
    let mut finding = Finding::new(
        "A ball of 1 kg hits the floor at 1 m/s, g = 9.81 m/s². One row: printed A = 1, b = v − g; corrected \
         A = dt, b = v − g dt, in the sign of w = A x + b (here the chapter has the same). Either λ is put \
         into the integrator; the floor must leave no velocity.",
    );
    let velocity = |dt: f64, lambda: f64| V + dt * (F + lambda);
    for (name, dt) in [("1/60", 1.0 / 60.0), ("1/1000", 1e-3), ("1", 1.0)] {
        let printed = velocity(dt, force(1.0, V + F)?);
        let corrected = velocity(dt, force(dt, V + dt * F)?);
        let v = Measure::new(format!("v⁺ on the floor, dt = {name} s"), "m/s", printed, corrected)
            .truth(&[0.0], "the floor is rigid", 1e-12);
        finding = finding.measure(if dt == 1.0 { v.agreeing() } else { v });
    }
    let dt = DT;
    let lambda = Measure::new("λ, dt = 1/60 s", "N", force(1.0, V + F)?, force(dt, V + dt * F)?);
    Ok(finding.measure(lambda.truth(&[60.0 + 9.81], "m (v/dt + g)", 1e-9)))
}

/// E28: an impulse where the equation has a force, K&M (23) and Code 2.
///
/// A ball that hits the ground, with both readings of x.
pub(super) fn impulse_or_force() -> Result<Finding> {
    let (blocks, jacobian, none) =
        (Blocks::on_a_line(&[-1.0], &[1.0], &[-G]), one(1.0), single(0.0));
    let taken = code04::printed(&blocks, &jacobian, &none, DT, 1)?;
    let added = code04::corrected(&blocks, &jacobian, &none, DT, 1)?;
    let right = code02::corrected(&blocks, &jacobian, &added, DT).0;
    let force = &taken / DT;
    let by_equation = |x| code02::equation(&blocks, &jacobian, x, DT).0;
    let by_listing = |x| code02::printed(&blocks, &jacobian, x, DT).0;
    let finding = Finding::new(format!(
        "A ball of 1 kg touches the ground and moves down at 1 m/s; g = 9.81 m/s², dt = 1/60 s, so \
         u* = {free} m/s. Code 4 solves A x = J u*, here x = {free} N s; as a force x/dt that is {force} N. \
         The ground stops the ball: u⁺ = 0. Corrected is w = A x + b with b = J u* = {free} m/s, \
         x = {added} N s and u⁺ = u* + M⁻¹ Jᵀ x.",
        free = plain(taken[0]),
        force = plain(force[0]),
        added = plain(added[0]),
    ));
    let speed = |quantity: &str, printed: f64| {
        let measure = Measure::new(quantity, "m/s", printed, right[0]);
        measure.truth(&[0.0], "the ground holds", 1e-12)
    };
    Ok(finding
        .measure(speed("u⁺, the impulse x in (23)", by_equation(&taken)[0]))
        .measure(speed("u⁺, the force x/dt in Code 2", by_listing(&force)[0]))
        .measure(speed("u⁺, the impulse x in Code 2", by_listing(&taken)[0]).agreeing())
        .measure(speed("u⁺, the force x/dt in (23)", by_equation(&force)[0]).agreeing()))
}

/// E63: λ is a force, note on λ.
///
/// λ of a ball of 1 kg at rest on the floor, with these units of length (m), time (s) and mass
/// (kg).
fn load(length: f64, time: f64, mass: f64) -> Result<f64> {
    let (m, g, dt) = (1.0 / mass, G / length * time * time, DT / time);
    let x = answer(Pgs::NAME, &contacts(&[1.0 / m], &[-g * dt])?)?;
    Ok(x[0] / dt)
}

pub(super) fn force_not_strain() -> Result<Finding> {
    let si = load(1.0, 1.0, 1.0)?;
    let measure = |quantity: &str, length: f64, time: f64, mass: f64| -> Result<Measure> {
        // 1 N = 1 kg m s⁻² in the new units.
        let newton = time * time / (mass * length);
        let measure = Measure::new(quantity, "", 1.0, newton);
        Ok(measure.truth(&[load(length, time, mass)? / si], "solved in both", 1e-6 * newton))
    };
    Ok(Finding::new(
        "A ball of 1 kg rests on the floor, g = 9.81 m/s², a step of 1/60 s; λ = x/dt. The same problem is set up \
         and solved in other units: by what factor does the number λ change? A strain would keep its number.",
    )
    .measure(measure("mm instead of m", 1e-3, 1.0, 1.0)?)
    .measure(measure("ms instead of s", 1.0, 1e-3, 1.0)?)
    .measure(measure("g instead of kg", 1.0, 1.0, 1e-3)?))
}
