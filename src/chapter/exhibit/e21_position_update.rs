//! E21: the position update forgets the position, K&M (16).

use super::setting::G;
use super::{Evidence, Exhibit, Finding, Measure, Severity};
use crate::error::Result;

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E21",
    title: "the position update forgets the position",
    place: "K&M (16)",
    severity: Severity::Wrong,
    may_be_scan: false,
    printed: "xₙ₊₁ = vₙ₊₁ + a dt",
    holds: "xₙ₊₁ = xₙ + vₙ₊₁ dt, as in (19)",
    why: "The right side of the printed line is a velocity: it has the unit m/s and no trace of where the \
          body was. The listings integrate correctly, so only a reader who follows the equation is led astray.",
    evidence: Evidence::Example(example),
};

/// One step of a falling body.
fn example() -> Result<Finding> {
    let (x, v, a, dt) = (100.0, 2.0, -G, 0.01);
    let v_next = v + a * dt;
    let printed = v_next + a * dt;
    let corrected = x + v_next * dt;
    let truth = x + v * dt + 0.5 * a * dt * dt;
    let height = Measure::new("height after the step", "m", printed, corrected);
    Ok(Finding::new(
        "A body at 100 m rises at 2 m/s; g = 9.81 m/s², one step of 0.01 s. The corrected step misses free \
         fall by ½ g dt² = 0.49 mm: that is the error of the method, and shrinks with dt.",
    )
    .measure(height.truth(&[truth], "closed form", 5e-4)))
}
