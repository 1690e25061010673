//! A stone in free flight.

use super::measure::{Case, Known, Method, ROUNDING, after};
use super::{Row, Size};
use crate::error::Result;
use crate::scene::catalogue::fall::Fall;

/// Velocities are exact with every method; the parabola with those of second order and above.
pub(super) fn fall(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("free-fall", "free_fall", size)?;
    let (start, time) = (case.scene.states[0], 1.0);
    let fall = Fall { height: start.pose.p.z, speed: start.v.z, gravity: -case.scene.gravity.z };
    let [velocity, height] = ["v_0 - g\\,t", "z_0 + v_0 t - \\tfrac12 g\\,t^2"];
    let mut rows = Vec::new();
    for (method, order) in [
        (Method::Velocity, Some(1.0)),
        (Method::Acceleration, Some(1.0)),
        (Method::Midpoint, None),
        (Method::Rk4, None),
    ] {
        let (z, what) = (fall.height_after(time), "height after 1 s");
        let place = match order {
            Some(order) => Known::order(order, what, height, "m", z),
            None => Known::exact(ROUNDING, what, height, "m", z),
        };
        let speed = fall.speed_after(time);
        let known =
            vec![Known::exact(ROUNDING, "velocity after 1 s", velocity, "m/s", speed), place];
        rows.extend(case.rows(method, known, |scene| {
            let state = after(scene, time)?[0];
            Some(vec![state.v.z, state.pose.p.z])
        }));
    }
    Ok(rows)
}
