//! E05: two inequalities without complementarity, K&M (15).

use super::common::{contacts, enumerated, last};
use super::{Finding, Measure};
use crate::error::Result;
use crate::lcp::Lcp;
use crate::plot::{Axis, Lines, Series};

/// (15) as printed: w ≥ 0 and x ≥ 0, w = A x + b in this library's sign.
fn printed(lcp: &Lcp, x: &[f64]) -> bool {
    x.iter().chain(&lcp.w(x)).all(|&value| value >= 0.0)
}

fn corrected(lcp: &Lcp, x: &[f64]) -> bool {
    printed(lcp, x) && x.iter().zip(lcp.w(x)).all(|(x, w)| x * w == 0.0)
}

fn count(lcp: &Lcp, tried: &[Vec<f64>], accepts: fn(&Lcp, &[f64]) -> bool) -> f64 {
    tried.iter().filter(|x| accepts(lcp, x)).count() as f64
}

/// One row and two; the solution is among the x that are tried.
pub(super) fn example() -> Result<Finding> {
    let one = contacts(&[2.0], &[-4.0])?;
    let two = contacts(&[2.0, -1.0, -1.0, 2.0], &[-1.0, 3.0])?;
    let line: Vec<Vec<f64>> = [2.0, 3.0, 100.0].map(|x| vec![x]).into();
    let mut finding = Finding::new(
        "One row: A = 2, w = 2x − 4 (b = −4 in this library's sign, b = 4 in the chapter's), tried at \
         x = 2, 3 and 100. Two rows: A = [2 −1; −1 2], w = A x + b with b = (−1, 3), tried at the 81 points \
         x = (0, ¼, …, 2)².",
    );
    for (name, lcp, tried) in [("accepted, n = 1", &one, line), ("accepted, n = 2", &two, grid())] {
        let truth = enumerated(lcp).len() as f64;
        let accepted = Measure::new(
            name,
            "points",
            count(lcp, &tried, printed),
            count(lcp, &tried, corrected),
        );
        finding = finding.measure(accepted.truth(&[truth], "enumeration", 0.0));
    }
    Ok(finding.judged("n = 1: x = 3 and x = 2", &one, &[3.0], &[2.0]).plot(&feasible_set(&two)))
}

/// (0, ¼, …, 2)².
fn grid() -> Vec<Vec<f64>> {
    (0..81).map(|k| vec![0.25 * f64::from(k % 9), 0.25 * f64::from(k / 9)]).collect()
}

fn feasible_set(lcp: &Lcp) -> Lines {
    let point = |x: &Vec<f64>| (x[0], x[1]);
    let feasible = grid().iter().filter(|x| printed(lcp, x)).map(point).collect();
    let solution = point(&last(enumerated(lcp)));
    Lines::new(
        "feasible_set",
        "What two inequalities leave",
        "Every dot satisfies A x + b ≥ 0 and x ≥ 0, as (15) asks; only one, on the axis where the \
             second contact is open, is the answer.",
        Axis::linear("x₁", ""),
        Axis::linear("x₂", ""),
        vec![
            Series::points("allowed by (15)", feasible),
            Series::points("the solution", vec![solution]),
            Series::reference("w₁ = 0", vec![(0.5, 0.0), (1.5, 2.0)]),
        ],
    )
}
