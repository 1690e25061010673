//! E50: limits on matrix sizes that exclude the chapter's own tower, Codes 10 and 11.

use super::{Finding, Measure, Outcome};
use crate::chapter::code::code09_10_dense_matrix::{corrected, printed};
use crate::chapter::code::code11_map_matrix::printed::MapMatrix;
use crate::error::Result;

/// Increases the number of bodies until both listings reject it.
pub(super) fn example() -> Result<Finding> {
    let cubes = 700;
    let rows_of_s = match printed::DenseMatrix::new(7 * cubes, 6 * cubes, None) {
        Ok(s) => f64::from(s.num_rows()).into(),
        Err(_) => Outcome::Impossible("Code 10 stops".into()),
    };
    let s = corrected::DenseMatrix::zeros(7 * cubes as usize, 6 * cubes as usize);
    let dense =
        (1..).take_while(|&m| printed::DenseMatrix::new(7 * m, 6 * m, None).is_ok()).count();
    let sparse = (1..).take_while(|&m| MapMatrix::new(7 * m, 6 * m, None).is_ok()).count();
    let square = (1..).take_while(|&n| printed::DenseMatrix::new(n, n, None).is_ok()).count();
    let by_limit = |limit: i32| f64::from((limit - 1) / 7);

    let rows = Measure::new("rows of S, 700 cubes", "", rows_of_s, s.num_rows() as f64);
    let in_dense =
        Measure::new("bodies Code 10 holds", "", f64::from(cubes), by_limit(printed::LIMIT));
    let in_sparse = Measure::new("bodies Code 11 holds", "", f64::from(cubes), by_limit(1501));
    let largest = Measure::new("largest size, Code 10", "", 500.0, f64::from(printed::LIMIT - 1));
    Ok(Finding::new(
        "The matrix S turns 6 velocities of a body into 7 numbers of its state, so it is 7m × 6m. The printed \
         column has the chapter's words, by which 700 cubes and a size of 500 fit; the truth is found by \
         asking the listings for one body more, again and again, until they stop.",
    )
    .measure(rows.truth(&[f64::from(7 * cubes)], "7 a body", 0.0))
    .measure(in_dense.truth(&[dense as f64], "trial", 0.0))
    .measure(in_sparse.truth(&[sparse as f64], "trial", 0.0))
    .measure(largest.truth(&[square as f64], "trial", 0.0)))
}
