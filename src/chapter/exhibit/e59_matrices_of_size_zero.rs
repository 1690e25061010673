//! E59: matrices of size 0, Codes 7 and 10.

use super::common::{answer, contacts};
use super::setting::{DT, G};
use super::{Evidence, Exhibit, Finding, Measure, Outcome, Severity};
use crate::chapter::code::code09_10_dense_matrix::{corrected, printed};
use crate::error::Result;

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E59",
    title: "matrices of size zero",
    place: "K&M Codes 7 and 10 and text on Code 10",
    severity: Severity::Misleading,
    may_be_scan: false,
    printed: "An assertion stops arrays of size zero. The listing's own assertions accept 0 × 0, which other \
              listings return, and stop 0 × k.",
    holds: "Any size from 0 on is a matrix. J has as many rows as constraints are active: 0 × 6m if none is.",
    why: "Code 7 adds up the dimensions of its constraints. If all of them are inactive, contacts that do not \
          touch, the sum is 0, and building J stops the program at the very moment when there is nothing to \
          solve. Sums over no rows need no special case: A is 0 × 0, x is empty, and the step is free flight.",
    evidence: Evidence::Example(example),
};

/// Three bodies that touch nothing.
fn example() -> Result<Finding> {
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
