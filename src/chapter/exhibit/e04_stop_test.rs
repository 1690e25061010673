//! E04: a stop test that never fires at an active bound, K&M (4).

use super::common::{contacts, spaced, sweeps};
use super::{Finding, Measure, Outcome};
use crate::error::Result;
use crate::lcp::{Lcp, merit};
use crate::plot::{Axis, Lines, Series};
use crate::solver::Pgs;

const SWEEPS: usize = 10_000;
const SMALL: f64 = 1e-3;

/// A problem that the first sweep solves, and b = 0.
pub(super) fn example() -> Result<Finding> {
    let lcp = contacts(&[2.0, -1.0, -1.0, 2.0], &[-1.0, 3.0])?;
    let iterates = sweeps(Pgs::NAME, &lcp, &[0.0; 2], SWEEPS)?;
    let sweeps_to =
        |merit: fn(&Lcp, &[f64]) -> f64| match iterates.iter().position(|x| merit(&lcp, x) < SMALL)
        {
            Some(k) => Outcome::from(k as f64),
            None => Outcome::Impossible(format!("never in {SWEEPS}")),
        };
    let (printed, corrected) = (merit::km4, merit::natural_residual);
    let (solution, zero) = ([0.5, 0.0], lcp.homogeneous());
    let ratio = match printed(&zero, &[0.0; 2]) {
        value if value.is_nan() => Outcome::Impossible("0/0".into()),
        value => Outcome::from(value),
    };
    let at_solution = Measure::new(
        "value at x = (½, 0)",
        "",
        printed(&lcp, &solution),
        corrected(&lcp, &solution),
    );
    let at_zero = Measure::new("value at x = 0, b = 0", "", ratio, corrected(&zero, &[0.0; 2]));
    let count = Measure::new("sweeps to reach 10⁻³", "", sweeps_to(printed), sweeps_to(corrected));
    Ok(Finding::new(
        "A = [2 −1; −1 2], w = A x + b ≥ 0, x ≥ 0 with b = (−1, 3); K&M write A x = b with −b. The solution \
         is x = (½, 0) with w = (0, 2.5): the second contact opens. Projected Gauss-Seidel is there after \
         one sweep. At a solution a test must be 0.",
    )
    .measure(count.truth(&[1.0], "by hand", 0.0))
    .measure(at_solution.truth(&[0.0], "by definition", 0.0))
    .measure(at_zero.truth(&[0.0], "by definition", 0.0))
    .plot(&both_merits()?))
}

/// Both tests after each sweep, for a solution x = (3, 2, 0) that is approached by the factor ½ per
/// sweep.
fn both_merits() -> Result<Lines> {
    let a = [1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0];
    let lcp = contacts(&a, &[-1.0, -1.0, 3.0])?;
    let iterates = sweeps(Pgs::NAME, &lcp, &[0.0; 3], 30)?;
    let values = |merit: fn(&Lcp, &[f64]) -> f64| {
        spaced(&iterates.iter().map(|x| merit(&lcp, x)).collect::<Vec<_>>(), 1.0)
    };
    let halves = (1..=30).map(|k| (f64::from(k), 0.5_f64.powi(k - 1)));
    let stays = 1.0 / 11.0_f64.sqrt();
    let series = vec![
        Series::measured("K&M (4)", values(merit::km4)),
        Series::measured("natural residual", values(merit::natural_residual)),
        Series::theory("(½)ᵏ⁻¹", halves.collect()),
        Series::reference("1/√11", vec![(0.0, stays), (30.0, stays)]),
    ];
    Ok(Lines::new(
        "two_stop_tests",
        "Two stop tests on one problem",
        "Three stacked bodies, the top one leaving. From the first on the natural residual halves with each sweep; the \
             printed test stays at 1/√11, whatever is done.",
        Axis::linear("sweep", ""),
        Axis::log("value of the test", ""),
        series,
    ))
}
