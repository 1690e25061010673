//! E19: what the rows of J describe, and what their number counts.

use nalgebra::{DMatrix, Vector3};

use super::common::{jacobian, rank};
use super::{Evidence, Exhibit, Finding, Measure, Severity};
use crate::body::State;
use crate::constraint::Coincidence;
use crate::error::Result;

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E19",
    title: "rows are not freedoms",
    place: "K&M, section on the Jacobian",
    severity: Severity::Misleading,
    may_be_scan: false,
    printed: "J describes how objects are allowed to move; later, which motions are not allowed. The number \
              of its rows is the number of degrees of freedom removed.",
    holds: "The rows span the forbidden motions, the null space of J holds the allowed ones. Removed is \
            rank J, the number of rows only where they are independent.",
    why: "A second nail says once more that the body must not stretch along the line between the nails, \
          which a rigid body does not do anyway. The row is there, and it removes nothing; A = J M⁻¹ Jᵀ \
          becomes singular by it (E10).",
    evidence: Evidence::Example(example),
};

/// One nail in a body, then two.
fn example() -> Result<Finding> {
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
