//! E42: a row of three entries for six velocities, K&M (40).

use nalgebra::{DMatrix, Vector3};

use super::common::product;
use super::rate::{body, rates};
use super::{Finding, Measure, Outcome};
use crate::error::Result;

/// Two points 5 m apart.
pub(super) fn example() -> Result<Finding> {
    let still = Vector3::zeros();
    let left = body(still, Vector3::x(), still);
    let right = body(Vector3::new(3.0, 4.0, 0.0), 2.0 * Vector3::y(), still);
    let n = right.pose.p.normalize();
    let q_rate = DMatrix::from_iterator(6, 1, left.v.iter().chain(&right.v).copied());

    let short = DMatrix::from_row_slice(1, 3, n.as_slice());
    let full = DMatrix::from_iterator(1, 6, (-n).iter().chain(&n).copied());
    let difference = DMatrix::from_column_slice(3, 1, (right.v - left.v).as_slice());
    let truth = rates([&left, &right], |[one, other]| vec![(other.p - one.p).norm()]);
    let measure = |quantity: &str, printed: Outcome| {
        let measure = Measure::new(quantity, "m/s", printed, product(&full, &q_rate));
        measure.truth(&truth, "dual numbers", 1e-9)
    };
    Ok(Finding::new(
        "One point lies at the origin and moves with (1, 0, 0) m/s, the other at (3, 4, 0) m and moves with \
         (0, 2, 0) m/s; n = (0.6, 0.8, 0). How fast does their distance grow?",
    )
    .measure(measure("ċ with q' = [v₀; v₁]", product(&short, &q_rate)))
    .measure(measure("ċ with q' = v₁ − v₀", product(&short, &difference)).agreeing()))
}
