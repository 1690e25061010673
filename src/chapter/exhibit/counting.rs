//! Rows, equations and degrees of freedom, counted.

use nalgebra::{DMatrix, Vector3};

use super::common::{jacobian, rank};
use super::{Finding, Measure};
use crate::body::State;
use crate::constraint::{Coincidence, Hinge, Perpendicular};
use crate::error::Result;

/// E19: what the rows of J describe, and what their number counts.
///
/// One nail in a body, then two.
pub(super) fn rows_and_degrees_of_freedom() -> Result<Finding> {
    let places = [Vector3::new(0.5, 0.2, 0.0), Vector3::new(-0.4, 0.1, 0.3)];
    let [one, other] =
        places.map(|place| Coincidence { bodies: [None, Some(0)], anchors: [place; 2] });
    let single = jacobian(&one, &State::WORLD)?;
    let pair = jacobian(&(one, other), &State::WORLD)?;
    let rows = |j: &DMatrix<f64>| j.nrows() as f64;
    let left = 6.0 - rank(&pair);
    let removed = |name, j: &DMatrix<f64>| Measure::new(name, "", rows(j), rank(j));
    Ok(Finding::new(
        "A free body has 6 degrees of freedom. A nail holds a point of it where it is, three rows: the body \
         can still turn about the point in three ways. A second nail, three more rows: it can still turn \
         about the line through both.",
    )
    .measure(removed("removed by one nail", &single).truth(&[3.0], "6 − 3 turns", 0.0).agreeing())
    .measure(removed("removed by two nails", &pair).truth(&[5.0], "6 − 1 turn", 0.0))
    .measure(
        Measure::new("allowed with two nails", "", rank(&pair), left)
            .truth(&[1.0], "a turn about a line", 0.0),
    ))
}

/// E20: how many equations and state variables a system has.
///
/// One body on a hinge.
pub(super) fn equations_and_state() -> Result<Finding> {
    let bodies = [None, Some(0)];
    let across = |direction| Perpendicular { bodies, directions: [direction, Vector3::z()] };
    let point = Coincidence { bodies, anchors: [Vector3::new(0.5, 0.0, 0.0); 2] };
    let hinge: Hinge = (point, [across(Vector3::x()), across(Vector3::y())]);
    let j = jacobian(&hinge, &State::WORLD)?;
    // The angle about the axis.
    let remaining = 1.0;
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
