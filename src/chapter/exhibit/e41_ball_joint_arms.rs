//! E41: the arms of the ball joint are exchanged, K&M (33).

use nalgebra::Vector3;

use super::rate::{body, rates};
use super::{Finding, Measure};
use crate::error::Result;

/// Two bodies that spin about z at different rates, joined at points away from their centers.
pub(super) fn example() -> Result<Finding> {
    let (r0, r1) = (Vector3::x(), Vector3::new(0.0, 2.0, 0.0));
    let still = Vector3::zeros();
    let states = [body(still, still, Vector3::z()), body(still, still, 2.0 * Vector3::z())];
    let [w0, w1] = [states[0].omega, states[1].omega];

    // (33) with its sign changed to that of (32): [−I, −a*, I, b*] for arms a and b.
    let with_star =
        |star: f64, a: &Vector3<f64>, b: &Vector3<f64>| star * (b.cross(&w1) - a.cross(&w0));
    let plane = |rate: Vector3<f64>| [rate.x, rate.y];
    let corrected = plane(r0.cross(&w0) - r1.cross(&w1));
    let truth = rates([&states[0], &states[1]], |[own, other]| {
        (other.point(&r1) - own.point(&r0)).as_slice().to_vec()
    });
    let measure = |quantity: &str, printed: Vector3<f64>| {
        let measure = Measure::new(quantity, "m/s", plane(printed), corrected);
        measure.truth(&truth[..2], "dual numbers", 1e-9)
    };
    Ok(Finding::new(
        "Both bodies have their centre at the origin; body 0 spins about z with 1 rad/s and has its anchor \
         at r₀ = (1, 0, 0) m, body 1 spins with 2 rad/s and has it at r₁ = (0, 2, 0) m. The rate (x, y) of \
         the gap between the anchors is ω₁ × r₁ − ω₀ × r₀. The printed rows are given the sign of (32).",
    )
    .measure(measure("(33), r* = −[r]×", with_star(-1.0, &r1, &r0)))
    .measure(measure("(33), r* = [r]×", with_star(1.0, &r1, &r0)))
    .measure(measure("(34)", with_star(-1.0, &r0, &r1)).agreeing()))
}
