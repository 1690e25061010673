//! E65: a distance constraint glues, text on Figure 11.

use super::common::{answer, contacts, equations};
use super::setting::DT;
use super::{Finding, Measure};
use crate::error::Result;
use crate::lcp::Lcp;
use crate::solver::Pgs;

/// Velocities and gap after half a second.
struct Motion {
    relative_velocity: f64,
    gap: f64,
    first_impulse: f64,
}

/// A sphere and a point of the net, 1 kg each, step by step, with the row from `pose`.
fn moved(pose: impl Fn(f64) -> Result<Lcp>) -> Result<Motion> {
    let dt = DT;
    let (mut u, mut gap, mut first) = ([0.0, 2.0], 0.0, None);
    for _ in 0..30 {
        // A gap may close within the step, and no faster.
        let x = answer(Pgs::NAME, &pose(u[1] - u[0] + gap / dt)?)?[0];
        u = [u[0] - x, u[1] + x];
        gap += dt * (u[1] - u[0]);
        first = first.or(Some(x));
    }
    Ok(Motion { relative_velocity: u[1] - u[0], gap, first_impulse: first.unwrap_or(0.0) })
}

pub(super) fn example() -> Result<Finding> {
    let equality = moved(|b| equations(&[2.0], &[b]))?;
    let inequality = moved(|b| contacts(&[2.0], &[b]))?;
    let speed = Measure::new(
        "relative velocity",
        "m/s",
        equality.relative_velocity,
        inequality.relative_velocity,
    );
    let gap = Measure::new("gap", "m", equality.gap, inequality.gap);
    Ok(Finding::new(
        "A sphere of 1 kg touches a point of the net, 1 kg too and at rest, and leaves it at 2 m/s; no gravity, \
         0.5 s in steps of 1/60 s. The judge sees both impulses of the first step on w = 2 x + 2 ≥ 0, x ≥ 0.",
    )
    .measure(speed.truth(&[2.0], "free flight", 1e-9))
    .measure(gap.truth(&[1.0], "free flight", 1e-9))
    .judged(
        "the sphere leaves",
        &contacts(&[2.0], &[2.0])?,
        &[equality.first_impulse],
        &[inequality.first_impulse],
    ))
}
