//! E53: two matrix classes read the same data in different orders, Codes 10 and 11.

use super::{Evidence, Exhibit, Finding, Measure, Severity};
use crate::chapter::code::code09_10_dense_matrix::printed::DenseMatrix;
use crate::chapter::code::code11_map_matrix::{corrected, printed};
use crate::error::Result;

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E53",
    title: "the sparse matrix reads its data column by column",
    place: "K&M Code 11",
    severity: Severity::Wrong,
    may_be_scan: false,
    printed: "Entry (i, k) of the data is data[i + k · numRows].",
    holds: "It is data[k + i · numCols], the order of Code 10, whose place the class is to take.",
    why: "The chapter's dense matrix lies in memory row after row. A class to be swapped in for it must read \
          the same array the same way; this one takes it for columns. A square block comes out transposed, \
          others scrambled, and blocks that are symmetric, as many are in this business, show nothing.",
    evidence: Evidence::Example(example),
};

/// Row 0 of two arrays, through all three classes.
fn example() -> Result<Finding> {
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
