//! E20: how many equations and state variables a system has.

use nalgebra::Vector3;

use super::common::{jacobian, rank};
use super::{Finding, Measure};
use crate::body::State;
use crate::constraint::{Coincidence, Hinge, Perpendicular};
use crate::error::Result;

/// One body on a hinge.
pub(super) fn example() -> Result<Finding> {
    let bodies = [None, Some(0)];
    let across = |direction| Perpendicular { bodies, directions: [direction, Vector3::z()] };
    let point = Coincidence { bodies, anchors: [Vector3::new(0.5, 0.0, 0.0); 2] };
    let hinge: Hinge = (point, [across(Vector3::x()), across(Vector3::y())]);
    let j = jacobian(&hinge, &State::WORLD)?;
    let remaining = 1.0; // the angle about the axis
    let State { pose, v, omega } = State::WORLD;
    let numbers = pose.p.len() + pose.q.coords.len() + v.len() + omega.len();
    let equations = Measure::new("equations", "", 6.0 - j.nrows() as f64, 6.0 - remaining);
    let state = Measure::new("numbers in the state", "", 6.0, numbers as f64);
    Ok(Finding::new(
        "One body (m = 1) on a hinge with the world: its constraint has five rows, one angle remains. \
         Printed takes n = 5, corrected n = 1; the truth is the rank of this library's hinge.",
    )
    .measure(equations.truth(&[rank(&j)], "rank of J", 0.0))
    .measure(state.truth(&[7.0 + 6.0], "7m + 6m", 0.0)))
}
