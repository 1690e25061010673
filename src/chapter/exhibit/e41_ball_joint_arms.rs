//! E41: the arms of the ball joint are exchanged, K&M (33).

use nalgebra::Vector3;

use super::rate::{body, rates};
use super::{Evidence, Exhibit, Finding, Measure, Severity};
use crate::error::Result;

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E41",
    title: "the arms of the ball joint are exchanged",
    place: "K&M (33)",
    severity: Severity::Wrong,
    may_be_scan: true,
    printed: "J₀ = [I, r₁*] and J₁ = −[I, r₀*], with r* the skew matrix of the cross product.",
    holds: "Each body's block holds its own arm: J = [−I, [r₀]×, I, −[r₁]×] with [r]× y = r × y.",
    why: "The velocity of a body's anchor is v + ω × r with its own r, and ω × r = −[r]× ω. So the block of \
          body 0 can contain nothing of body 1. The next line, (34), has the arms in place; it shows that \
          its star is minus the usual skew matrix, and it has the opposite sign of (32) throughout, which \
          is harmless for an equation.",
    evidence: Evidence::Example(example),
};

/// Two bodies that spin about z at different rates, joined at points off their centres.
fn example() -> Result<Finding> {
    let (r0, r1) = (Vector3::x(), Vector3::new(0.0, 2.0, 0.0));
    let still = Vector3::zeros();
    let states = [body(still, still, Vector3::z()), body(still, still, 2.0 * Vector3::z())];
    let [w0, w1] = [states[0].omega, states[1].omega];

    // (33) with its sign turned to that of (32): [−I, −a*, I, b*] for arms a and b.
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
