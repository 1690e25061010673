//! E16: the blocks of the Jacobian and what they multiply, K&M (7), (8).

use nalgebra::{DMatrix, Vector3};
use num_dual::{Dual64, DualNum};

use super::common::product;
use super::{Finding, Measure};
use crate::error::Result;

/// The height of a point on a body that rises and rotates.
pub(super) fn example() -> Result<Finding> {
    let (r, n) = (Vector3::new(0.0, 0.5, 0.2), Vector3::z());
    let (v, omega) = (Vector3::new(0.0, 0.0, 0.3), Vector3::new(2.0, 0.0, 0.0));
    let row = |v: Vector3<f64>| DMatrix::from_row_slice(1, 3, v.as_slice());
    let (j_v, j_omega) = (row(n), row(r.cross(&n)));
    let u = DMatrix::from_column_slice(6, 1, &[v.as_slice(), omega.as_slice()].concat());
    let corrected = (&j_v * v + &j_omega * omega)[0];
    // t = 0 + ε: the exact derivative of the height along the motion.
    let t = Dual64::new(0.0, 1.0);
    let angle = t * omega.x;
    let height = t * v.z + angle.sin() * r.y + angle.cos() * r.z;
    let rate = Measure::new("rate of the height", "m/s", product(&j_v, &u), corrected);
    Ok(Finding::new(
        "A body rises at v = (0, 0, 0.3) m/s and turns at ω = (2, 0, 0) rad/s; c is the height of its point \
         at r = (0, 0.5, 0.2) m. J_v = (0, 0, 1), J_ω = r × (0, 0, 1).",
    )
    .measure(rate.truth(&[height.eps], "dual numbers", 1e-15)))
}
