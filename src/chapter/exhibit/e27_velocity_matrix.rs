//! E27: the velocities as a diagonal matrix, K&M Figure 5, Code 8.

use nalgebra::DMatrix;

use super::common::product;
use super::{Finding, Measure};
use crate::error::Result;

/// The distance of one body from the ground, with each of the shapes.
pub(super) fn example() -> Result<Finding> {
    let j = DMatrix::from_row_slice(1, 6, &[0.0, 0.0, 1.0, 0.0, 0.5, 0.0]);
    let u = [0.0, 0.0, 2.0, 0.0, 3.0, 0.0];
    let column = DMatrix::from_column_slice(6, 1, &u);
    let row = DMatrix::from_row_slice(1, 6, &u);
    let diagonal = DMatrix::from_diagonal(&column.column(0).into_owned());
    let as_scanned = diagonal.clone().insert_row(4, 0.0); // seven rows: ω_x stands twice
    let rate = product(&j, &column);
    let measure = |name: &str, shape: &DMatrix<f64>| {
        let rate = Measure::new(name, "m/s", product(&j, shape), rate.clone());
        rate.truth(&[2.0 + 0.5 * 3.0], "v_z + ½ ω_y", 1e-12)
    };
    Ok(Finding::new(
        "One row, J = (0, 0, 1, 0, ½, 0), the rate of the height of a point of a body that moves at \
         u = (0, 0, 2, 0, 3, 0). J u, with u in each printed shape; corrected is the column.",
    )
    .measure(measure("Figure 5, as read", &as_scanned))
    .measure(measure("diagonal, 6 × 6", &diagonal))
    .measure(measure("Code 8, a row a body", &row)))
}
