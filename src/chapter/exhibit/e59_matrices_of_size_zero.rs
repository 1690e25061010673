//! E59: matrices of size 0, Codes 7 and 10.

use super::common::{answer, contacts};
use super::setting::{DT, G};
use super::{Finding, Measure, Outcome};
use crate::chapter::code::code09_10_dense_matrix::{corrected, printed};
use crate::error::Result;

/// Three bodies that touch nothing.
pub(super) fn example() -> Result<Finding> {
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
    let x = answer("pgs", &contacts(&[], &vec![0.0; right.num_rows()])?)?;
    let falling = v + dt * g + x.iter().sum::<f64>();
    let flight = j.as_ref().map_or_else(|_| stopped(), |_| falling.into());

    let columns = Measure::new("columns of J", "", columns, right.num_cols() as f64);
    let step = Measure::new("velocity after the step", "m/s", flight, falling);
    let accepted = Measure::new("zero sizes accepted", "", 0.0, 1.0);
    Ok(Finding::new(
        "Three bodies fall at 1 m/s and touch nothing; g = 9.81 m/s², a step of 1/60 s. Code 7 asks for a J of \
         0 × 18. The last line counts which of 0 × 0, 0 × 18 and 18 × 0 Code 10 accepts; by the text, none.",
    )
    .measure(columns.truth(&[f64::from(6 * m)], "6 a body", 0.0))
    .measure(step.truth(&[-1.0 - 9.81 / 60.0], "free fall", 1e-12))
    .measure(accepted.truth(&[taken as f64], "trial", 0.0)))
}
