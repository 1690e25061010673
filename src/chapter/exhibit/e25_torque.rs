//! E25: the angular velocity where the torque belongs, K&M (20).

use super::{Evidence, Exhibit, Finding, Measure, Severity};
use crate::error::Result;

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E25",
    title: "a body that turns itself",
    place: "K&M (20), first line",
    severity: Severity::Wrong,
    may_be_scan: true,
    printed: "ωₙ₊₁ = ωₙ + ωₙ I⁻¹ dt",
    holds: "ωₙ₊₁ = ωₙ + I⁻¹ (τ − ω × I ω) dt, the inverse inertia to the left of what it acts on.",
    why: "A torque τ changes ω. With ω in its place a body at rest cannot be turned, and a turning one winds \
          itself up like compound interest. Perhaps a τ was scanned as ω; the order of \
          the factors, and the gyroscopic term (E26), remain.",
    evidence: Evidence::Example(example),
};

const STEPS: usize = 100;
const DT: f64 = 0.01;

/// A wheel that is driven, and one that is left alone; about a fixed axis ω × I ω = 0.
fn example() -> Result<Finding> {
    let inertia = 2.0;
    let turned = |start: f64, push: &dyn Fn(f64) -> f64| {
        (0..STEPS).fold(start, |omega, _| omega + push(omega) / inertia * DT)
    };
    let itself = |omega: f64| omega;
    let driven =
        Measure::new("driven from rest", "rad/s", turned(0.0, &itself), turned(0.0, &|_| 3.0));
    let alone =
        Measure::new("left alone at 1 rad/s", "rad/s", turned(1.0, &itself), turned(1.0, &|_| 0.0));
    Ok(Finding::new(
        "A wheel with I = 2 kg m² about its axis, 100 steps of 0.01 s: once from rest with a torque of 3 N m, \
         once turning at 1 rad/s with none.",
    )
    .measure(driven.truth(&[1.5], "τ t / I", 1e-12))
    .measure(alone.truth(&[1.0], "momentum", 1e-12)))
}
