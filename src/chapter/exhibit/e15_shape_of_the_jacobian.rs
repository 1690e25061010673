//! E15: the Jacobian's shape.

use nalgebra::{DMatrix, DVector};

use super::common::product;
use super::{Finding, Measure};
use crate::error::Result;

const BODIES: usize = 3;

/// Three bodies in a line and the gaps between them.
pub(super) fn example() -> Result<Finding> {
    let gap = |i: usize, k: usize| f64::from(k == 6 * (i + 1)) - f64::from(k == 6 * i);
    let j = DMatrix::from_fn(BODIES - 1, 6 * BODIES, gap);
    let (places, speeds) = ([0.0, 2.0, 5.0], [1.0, 3.0, 6.0]);
    let u = DVector::from_fn(6 * BODIES, |k, _| if k % 6 == 0 { speeds[k / 6] } else { 0.0 });
    let u = DMatrix::from_columns(&[u]);
    // The gaps before and after half a second.
    let after = |k: usize| places[k] + 0.5 * speeds[k];
    let rate = |i: usize| ((after(i + 1) - after(i)) - (places[i + 1] - places[i])) / 0.5;
    let rates =
        Measure::new("rates of the gaps", "m/s", product(&j.transpose(), &u), product(&j, &u));
    Ok(Finding::new(
        "Three bodies at 0, 2 and 5 m along x move along it at 1, 3 and 6 m/s: 6m = 18 velocities. Two \
         constraints, the gaps between neighbours: n = 2. We multiply J by the velocities u.",
    )
    .measure(rates.truth(&[rate(0), rate(1)], "gaps after ½ s", 1e-12)))
}
