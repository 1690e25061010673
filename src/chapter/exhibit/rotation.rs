//! Rates of change of orientation and angular velocity.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{Finding, Measure};
use crate::body::State;
use crate::error::Result;

/// E24: the quaternion's rate as a function of itself, K&M (18).
///
/// A body that rotates at a constant rate for a second.
pub(super) fn quaternion_rate() -> Result<Finding> {
    const STEPS: usize = 1000;
    const DT: f64 = 1e-3;
    let omega = Vector3::new(0.3, -1.1, 0.7);
    let (mut q, mut rate) = (Quaternion::identity(), Quaternion::from_imag(Vector3::zeros()));
    let mut state = State { omega, ..State::WORLD };
    for _ in 0..STEPS {
        rate = Quaternion::from_imag(omega) * rate * 0.5;
        q += rate * DT;
        state = state.advanced(DT);
    }
    let exact = UnitQuaternion::from_scaled_axis(omega);
    let (printed, corrected) = (UnitQuaternion::new_normalize(q), state.pose.q);
    let angle = Measure::new("angle turned", "rad", printed.angle(), corrected.angle());
    let miss = |q: UnitQuaternion<f64>| q.angle_to(&exact);
    let off = Measure::new("off the exact pose by", "rad", miss(printed), miss(corrected));
    Ok(Finding::new(
        "A body starts unturned and turns at ω = (0.3, −1.1, 0.7) rad/s for 1 s, in 1000 steps. The printed \
         rate starts at 0, corrected is this library's step.",
    )
    .measure(angle.truth(&[omega.norm()], "|ω| t", 1e-6))
    .measure(off.truth(&[0.0], "rotation by ω t", 1e-6)))
}

/// E25: the angular velocity where the torque belongs, K&M (20).
///
/// A wheel with a torque, and one without; about a fixed axis ω × I ω = 0.
pub(super) fn torque() -> Result<Finding> {
    const STEPS: usize = 100;
    const DT: f64 = 0.01;
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
