//! E25: the angular velocity where the torque belongs, K&M (20).

use super::{Finding, Measure};
use crate::error::Result;

const STEPS: usize = 100;
const DT: f64 = 0.01;

/// A wheel with a torque, and one without; about a fixed axis ω × I ω = 0.
pub(super) fn example() -> Result<Finding> {
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
