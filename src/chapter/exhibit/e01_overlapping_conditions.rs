//! E01: the three conditions of the boxed problem overlap, K&M (1).

use super::common::enumerated;
use super::{Finding, Measure};
use crate::error::Result;
use crate::lcp::{Lcp, Matrix};

const LOWER: f64 = 0.0;
const UPPER: f64 = 10.0;

/// One reading of (1): whether it accepts x with its y.
type Reading = fn(f64, f64) -> bool;

fn implies(condition: bool, consequence: bool) -> bool {
    !condition || consequence
}

fn printed(x: f64, y: f64) -> bool {
    implies(y >= 0.0, x == LOWER)
        && implies(y <= 0.0, x == UPPER)
        && implies(y == 0.0, LOWER < x && x < UPPER)
}

fn with_strict_signs(x: f64, y: f64) -> bool {
    implies(y > 0.0, x == LOWER)
        && implies(y < 0.0, x == UPPER)
        && implies(y == 0.0, LOWER < x && x < UPPER)
}

fn corrected(x: f64, y: f64) -> bool {
    (LOWER..=UPPER).contains(&x)
        && implies(x == LOWER && x < UPPER, y >= 0.0)
        && implies(x == UPPER && LOWER < x, y <= 0.0)
        && implies(LOWER < x && x < UPPER, y == 0.0)
}

/// One row inside its limits, one degenerate, one at its upper limit.
pub(super) fn example() -> Result<Finding> {
    let rows: [(&str, Reading, f64, bool); 4] = [
        ("solutions of y = 2x − 4", printed, -4.0, false),
        ("solutions of y = 2x", printed, 0.0, false),
        ("the same, strict signs", with_strict_signs, 0.0, false),
        ("solutions of y = 2x − 30", printed, -30.0, true),
    ];
    let mut finding = Finding::new(
        "One unknown between 0 and 10. We try x = 0, 0.01, …, 10 and count how many of these 1001 numbers \
         each reading accepts. The answers are x = 2 for y = 2x − 4, x = 0 for y = 2x and, at the upper \
         limit, x = 10 for y = 2x − 30.",
    );
    for (name, reading, b, agrees) in rows {
        let count = |accepts: Reading| {
            let x = (0..=1000).map(|k| f64::from(k) / 100.0);
            x.filter(|&x| accepts(x, 2.0 * x + b)).count() as f64
        };
        let lcp = Lcp::new(Matrix::dense(1, &[2.0]), vec![b], vec![LOWER], vec![UPPER])?;
        let truth = enumerated(&lcp).len() as f64;
        let measure = Measure::new(name, "", count(reading), count(corrected)).truth(
            &[truth],
            "enumeration",
            0.0,
        );
        finding = finding.measure(Measure { agrees, ..measure });
    }
    Ok(finding)
}
