//! E53: two matrix classes read the same data in different orders, Codes 10 and 11.

use super::{Finding, Measure};
use crate::chapter::code::code09_10_dense_matrix::printed::DenseMatrix;
use crate::chapter::code::code11_map_matrix::{corrected, printed};
use crate::error::Result;

/// Row 0 of two arrays, through all three classes.
pub(super) fn example() -> Result<Finding> {
    let measure = |quantity: &str, rows: usize, cols: usize, data: &[f32]| -> Result<Measure> {
        let sparse = printed::MapMatrix::new(rows, cols, Some(data))?;
        let corrected = corrected::MapMatrix::new(rows, cols, data)?;
        let dense = DenseMatrix::new(rows as i32, cols as i32, Some(data))?;
        let row = |entry: &dyn Fn(usize) -> Result<f32>| -> Result<Vec<f64>> {
            (0..cols).map(|k| Ok(f64::from(entry(k)?))).collect()
        };
        let truth = row(&|k| dense.get(0, k as i32))?;
        let measure = Measure::new(
            quantity,
            "",
            row(&|k| sparse.get(0, k))?,
            row(&|k| Ok(corrected.get(0, k)))?,
        );
        Ok(measure.truth(&truth, "Code 10", 0.0))
    };
    Ok(Finding::new(
        "The numbers 1 to 6 as a matrix of 2 × 3, and 2, −1, −1, 2 as one of 2 × 2: what is in the first row?",
    )
    .measure(measure("row 0, 1 to 6", 2, 3, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])?)
    .measure(measure("row 0, symmetric", 2, 2, &[2.0, -1.0, -1.0, 2.0])?.agreeing()))
}
