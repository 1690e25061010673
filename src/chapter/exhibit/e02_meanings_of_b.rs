//! E02: one letter b for three things, K&M (1), (2), (4), (13) to (15).

use super::common::{answer, contacts, enumerated, last};
use super::{Finding, Measure};
use crate::error::Result;

/// The b of (1) given to a solver of A x = b, unchanged and with the opposite sign.
pub(super) fn example() -> Result<Finding> {
    let (a, b) = ([2.0, -1.0, -1.0, 2.0], [-1.0, 2.0]);
    let negated = b.map(|b| -b);
    // The chapter's solver of A x = b finds the x with w = A x − b.
    let solve_ax_equals = |b: [f64; 2]| answer("pgs", &contacts(&a, &b.map(|b| -b))?);
    let (printed, corrected) = (solve_ax_equals(b)?, solve_ax_equals(negated)?);
    let lcp = contacts(&a, &b)?;
    let truth = last(enumerated(&lcp));
    let x = Measure::new("x", "", printed.clone(), corrected.clone());
    Ok(Finding::new(
        "A = [2 −1; −1 2], w = A x + b ≥ 0, x ≥ 0 with b = (−1, 2), the sign of (1) and of this library. \
         Printed: the solver of A x = b is given this b. Corrected: it is given −b.",
    )
    .measure(x.truth(&truth, "enumeration", 1e-12))
    .judged("A = [2 −1; −1 2], b = (−1, 2)", &lcp, &printed, &corrected))
}
