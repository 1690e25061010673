//! E44: the sign of the contact's Jacobian, K&M (44).

use nalgebra::Vector3;

use super::common::{answer, contacts};
use super::rate::{body, rates};
use super::{Finding, Measure};
use crate::body::State;
use crate::error::Result;

/// A unit mass that lands on the floor.
pub(super) fn example() -> Result<Finding> {
    let n = Vector3::y();
    let still = Vector3::zeros();
    let ball = body(still, -Vector3::y(), still);
    let truth = rates([&State::WORLD, &ball], |[floor, ball]| vec![(ball.p - floor.p).y]);
    // The floor, body 0, has no columns: it does not move.
    let step = |j: Vector3<f64>| -> Result<(f64, f64, f64)> {
        let lcp = contacts(&[j.dot(&j)], &[j.dot(&ball.v)])?;
        let x = answer("pgs", &lcp)?[0];
        Ok((j.dot(&ball.v), x, (ball.v + j * x).y))
    };
    let (printed, x_printed, v_printed) = step(-n)?;
    let (corrected, x_corrected, v_corrected) = step(n)?;
    let rate = Measure::new("rate of the gap J u", "m/s", printed, corrected);
    let after = Measure::new("velocity after the step", "m/s", v_printed, v_corrected);
    let right = contacts(&[1.0], &truth)?;
    Ok(Finding::new(
        "A ball of 1 kg reaches the floor at 1 m/s, no gravity. With either J the same steps are taken: \
         w = J Jᵀ x + J u ≥ 0, x ≥ 0, then v⁺ = v + Jᵀ x. The judge sees both x on the problem w = x − 1.",
    )
    .measure(rate.truth(&truth, "dual numbers", 1e-12))
    .measure(after.truth(&[0.0], "the floor stops it", 1e-9))
    .judged("one contact, closing at 1 m/s", &right, &[x_printed], &[x_corrected]))
}
