//! E24: the quaternion's rate as a function of itself, K&M (18).

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{Finding, Measure};
use crate::body::State;
use crate::error::Result;

const STEPS: usize = 1000;
const DT: f64 = 1e-3;

/// A body that rotates at a constant rate for a second.
pub(super) fn example() -> Result<Finding> {
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
