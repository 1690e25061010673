//! E19: what the rows of J describe, and what their number counts.

use nalgebra::{DMatrix, Vector3};

use super::common::{jacobian, rank};
use super::{Finding, Measure};
use crate::body::State;
use crate::constraint::Coincidence;
use crate::error::Result;

/// One nail in a body, then two.
pub(super) fn example() -> Result<Finding> {
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
