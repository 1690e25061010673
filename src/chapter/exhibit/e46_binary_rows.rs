//! E46: a binary constraint is not a mirrored unary one, note on unary and binary constraints.

use nalgebra::Vector3;

use super::rate::{body, rates};
use super::{Finding, Measure};
use crate::error::Result;

/// A ball joint with arms of different length, and with the same arm.
pub(super) fn example() -> Result<Finding> {
    let still = Vector3::zeros();
    let [w0, w1] = [Vector3::z(), 2.0 * Vector3::z()];
    let right = Vector3::x();
    let measure = |quantity: &str, r0: Vector3<f64>, r1: Vector3<f64>| {
        let states = [body(right, still, w0), body(-right, still, w1)];
        // J₁ = [I, −[r₁]×] and J₀ = −J₁, compared with J₀ with its own arm.
        let mirrored = w1.cross(&r1).y - w0.cross(&r1).y;
        let corrected = w1.cross(&r1).y - w0.cross(&r0).y;
        let truth = rates([&states[0], &states[1]], |[one, other]| {
            vec![(other.point(&r1) - one.point(&r0)).y]
        });
        Measure::new(quantity, "m/s", mirrored, corrected).truth(&truth, "dual numbers", 1e-9)
    };
    Ok(Finding::new(
        "Two bodies, centres at (1, 0, 0) m and (−1, 0, 0) m, spin about z with 1 and 2 rad/s. How fast do \
         their anchors part along y? First the anchors meet at the origin, r₀ = (−1, 0, 0) m and \
         r₁ = (1, 0, 0) m; then both arms are (1, 0, 0) m.",
    )
    .measure(measure("r₀ = −r₁", -right, right))
    .measure(measure("r₀ = r₁", right, right).agreeing()))
}
