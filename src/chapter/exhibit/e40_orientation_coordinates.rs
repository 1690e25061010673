//! E40: angles are not integrals of angular velocity, K&M (26), (27).

use nalgebra::{UnitQuaternion, Vector3};

use super::rate::{body, rates};
use super::{Finding, Measure};
use crate::body::State;
use crate::error::Result;

/// A body that rotates about x with 1 rad/s, at three orientations.
pub(super) fn example() -> Result<Finding> {
    let omega = Vector3::x();
    let turned = |q| {
        let mut state = body(Vector3::zeros(), Vector3::zeros(), omega);
        state.pose.q = q;
        state
    };
    let angles = |state: &State| {
        rates([&State::WORLD, state], |[_, own]| <[_; 3]>::from(own.q.euler_angles()).to_vec())
    };
    let steep = 60_f64.to_radians();
    let tilted = angles(&turned(UnitQuaternion::from_euler_angles(0.0, steep, 0.0)));
    let level = angles(&turned(UnitQuaternion::identity()));

    let away = turned(UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 1.0));
    let quaternion =
        rates([&State::WORLD, &away], |[_, own]| own.q.imag().map(|e| e + e).as_slice().to_vec());
    let e = away.pose.q.into_inner();
    let corrected = e.w * omega - e.imag().cross(&omega);

    let measure = |quantity: &str, printed: f64, corrected: f64, truth: f64| {
        Measure::new(quantity, "rad/s", printed, corrected).truth(&[truth], "dual numbers", 1e-9)
    };
    Ok(Finding::new(
        "A body turns about the world's x axis, ω = (1, 0, 0) rad/s. Its roll, pitch and yaw change as \
         ω_x / cos(pitch), ω_y and ω_z + ω_x tan(pitch) while yaw is 0; the printed form has ω itself. \
         The last two lines are c = 2 vec(q q_ref*) of a body turned by 1 rad about y.",
    )
    .measure(measure("roll rate, pitch 0", omega.x, omega.x, level[0]).agreeing())
    .measure(measure("roll rate, pitch 60°", omega.x, omega.x / steep.cos(), tilted[0]))
    .measure(measure("yaw rate, pitch 60°", omega.z, omega.z + omega.x * steep.tan(), tilted[2]))
    .measure(measure("x rate of c", omega.x, corrected.x, quaternion[0]))
    .measure(measure("z rate of c", omega.z, corrected.z, quaternion[2])))
}
