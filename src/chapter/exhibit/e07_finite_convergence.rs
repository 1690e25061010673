//! E07: "converge finitely", in at most hundreds of sweeps.

use dashu_ratio::RBig;

use super::common::{bounded, spaced, sweeps, tridiagonal};
use super::{Finding, Measure, Outcome};
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};
use crate::solver::Pgs;
use crate::solver::theory::sweeps_to;

const RODS: usize = 50;
/// The number of sweeps after which only the slowest error component is left.
const SETTLED: usize = 1000;

/// Two rows in fractions, a chain of fifty in sweeps.
pub(super) fn example() -> Result<Finding> {
    let errors = chain_errors()?;
    let end = errors.iter().skip(SETTLED).position(|e| *e <= 1e-6 * errors[SETTLED]);
    let counted = end.map_or(Outcome::Impossible("not reached".into()), |k| (k as f64).into());
    let predicted = sweeps_to(1e-6, rho()).ceil();
    let error = Measure::new("error after 40 sweeps", "", 0.0, exact_error(40));
    let count = Measure::new("sweeps to 10⁻⁶, n = 50", "", 999.0, counted);
    Ok(Finding::new(
        "w = A x + b = 0 (b = −1 in every row; the chapter's A x = b has b = 1). First A = [2 −1; −1 2], \
         started at 0, in exact fractions: the error of x₂ is ¼, 1/16, 1/64, …. Printed is what the claim \
         says: 0 from some sweep on. Then a chain, tridiag(−1, 2, −1) with 50 rows: the sweeps in which the \
         error falls to a millionth, counted from sweep 1000 on. Printed is the most that can be called \
         hundreds.",
    )
    .measure(error.truth(&[0.25_f64.powi(40)], "(¼)⁴⁰", 1e-40))
    .measure(count.truth(&[predicted], "ln 10⁻⁶ / ln ρ", 1.0))
    .plot(&errors_by_sweep(&errors)))
}

/// ρ of Gauss-Seidel on the chain, in closed form.
fn rho() -> f64 {
    (std::f64::consts::PI / (RODS + 1) as f64).cos().powi(2)
}

/// 1 − x₂ after this number of sweeps of x₁ ← (1 + x₂)/2, x₂ ← (1 + x₁)/2, in exact arithmetic.
fn exact_error(sweeps: usize) -> f64 {
    let mut x = RBig::ZERO;
    for _ in 0..2 * sweeps {
        x = (RBig::ONE + x) / RBig::from(2);
    }
    (RBig::ONE - x).to_f64().value()
}

/// The largest error of the chain after each sweep, with the solution from A⁻¹ in closed form.
fn chain_errors() -> Result<Vec<f64>> {
    let lcp = bounded(tridiagonal(RODS, 2.0), &[-1.0; RODS], f64::NEG_INFINITY)?;
    let solution: Vec<f64> = (1..=RODS).map(|i| (i * (RODS + 1 - i)) as f64 / 2.0).collect();
    let error = |x: &Vec<f64>| {
        x.iter().zip(&solution).map(|(x, exact)| (x - exact).abs()).fold(0.0, f64::max)
    };
    Ok(sweeps(Pgs::NAME, &lcp, &[0.0; RODS], 4700)?.iter().map(error).collect())
}

fn errors_by_sweep(errors: &[f64]) -> Lines {
    let from = (SETTLED as f64, errors[SETTLED]);
    let line = [0.0, 4700.0].map(|k| (k, from.1 * rho().powf(k - from.0)));
    Lines::new(
        "error_by_sweep",
        "A chain of 50 rods, sweep after sweep",
        "A straight line down on this scale: a constant factor a sweep, and no end. Pale band: \
             the slope of ρ = cos²(π/51) = 0.99621.",
        Axis::linear("sweep", ""),
        Axis::log("largest error of x", ""),
        vec![
            Series::points("pgs", spaced(errors, 1.0).into_iter().step_by(200).collect()),
            Series::theory("theory ρᵏ", line.to_vec()),
        ],
    )
}
