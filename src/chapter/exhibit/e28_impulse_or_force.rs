//! E28: an impulse where the equation has a force, K&M (23) and Code 2.

use super::setting::{DT, G, one, single};
use super::{Finding, Measure};
use crate::chapter::code::code01_unconstrained_step::Blocks;
use crate::chapter::code::{code02_constrained_step as code02, code04_drift_correction as code04};
use crate::document::notation::plain;
use crate::error::Result;

/// A ball that hits the ground, with both readings of x.
pub(super) fn example() -> Result<Finding> {
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
