//! The sizes the matrix classes of Codes 10 and 11 accept.

use super::common::{answer, contacts};
use super::setting::{DT, G};
use super::{Finding, Measure, Outcome};
use crate::chapter::code::code09_10_dense_matrix::{corrected, printed};
use crate::chapter::code::code11_map_matrix::printed::MapMatrix;
use crate::error::Result;
use crate::solver::Pgs;

/// E50: limits on matrix sizes that exclude the chapter's own tower, Codes 10 and 11.
///
/// Increases the number of bodies until both listings reject it.
pub(super) fn size_limits() -> Result<Finding> {
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

/// E59: matrices of size 0, Codes 7 and 10.
///
/// Three bodies that touch nothing.
pub(super) fn matrices_of_size_zero() -> Result<Finding> {
    let (m, dt) = (3, DT);
    let stopped = || Outcome::Impossible("Code 10 stops".into());
    let j = printed::DenseMatrix::new(0, 6 * m, None);
    let columns = j.as_ref().map_or_else(|_| stopped(), |j| f64::from(j.num_cols()).into());
    let right = corrected::DenseMatrix::zeros(0, 6 * m as usize);
    let taken = [(0, 0), (0, 6 * m), (6 * m, 0)]
        .into_iter()
        .filter(|&(rows, cols)| printed::DenseMatrix::new(rows, cols, None).is_ok())
        .count();

    let (v, g) = (-1.0, -G);
    let x = answer(Pgs::NAME, &contacts(&[], &vec![0.0; right.num_rows()])?)?;
    let falling = v + dt * g + x.iter().sum::<f64>();
    let flight = j.as_ref().map_or_else(|_| stopped(), |_| falling.into());

    let columns = Measure::new("columns of J", "", columns, right.num_cols() as f64);
    let step = Measure::new("velocity after the step", "m/s", flight, falling);
    let accepted = Measure::new("zero sizes accepted", "", 0.0, 1.0);
    Ok(Finding::new(
        "Three bodies fall at 1 m/s and touch nothing; g = 9.81 m/s², a step of 1/60 s. Code 7 requests a J of \
         0 × 18. The last line counts which of 0 × 0, 0 × 18 and 18 × 0 Code 10 accepts; by the text, none.",
    )
    .measure(columns.truth(&[f64::from(6 * m)], "6 a body", 0.0))
    .measure(step.truth(&[-1.0 - 9.81 / 60.0], "free fall", 1e-12))
    .measure(accepted.truth(&[taken as f64], "trial", 0.0)))
}
