//! The alternating direction method of multipliers (ADMM) for the quadratic program over the box.
//!
//! The program min ½ xᵀAx + bᵀx, lo ≤ x ≤ hi, is split into two easy parts: x minimizes, z
//! satisfies the bounds, and a multiplier R y drives them together:
//!
//! ```text
//! (A + R) x = R (z − y) − b      one factorization A + R = L Lᵀ for all iterations
//! x̂ = 1.6 x + (1 − 1.6) z        over-relaxation
//! z ← Π(x̂ + y)
//! y ← y + x̂ − z                  at the solution R y = −w
//! ```
//!
//! as in OSQP (Stellato, Banjac, Goulart, Bemporad & Boyd 2020). Converges for every symmetric
//! semidefinite A and R > 0, even if A is singular, since A + R is definite. The rate depends on R:
//! a small R suits rows that stay free, a large R suits rows at a bound. R = r diag(A) with one r
//! for all bounded rows; rows without bounds need no multiplier and get r/1000. The reported
//! iterate is z, which always satisfies the bounds. Costs n³/3 once and 2 n² per iteration.
//!
//! A not symmetric, or no Cholesky factor: `OutsideClass`. A row with a_ii ≤ 0: `ZeroDiagonal`.
//! Coupled rows: see [`frozen`]; freezing keeps the factor.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};

use crate::iterate::iterate;
use crate::metric::Metric;
use crate::tolerances::{OVER_RELAXATION, WEIGHT_WITHOUT_BOUNDS};
use crate::{Event, Observer, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_lcp::Lcp;
use lcplab_lcp::memory::Memory;

/// Maximum number of rows; with more, a dense factorization takes too long.
const MAX_ROWS: usize = 8_000;

/// The alternating direction method of multipliers.
#[derive(Debug, Clone)]
pub struct Admm {
    /// r: the weight of the multipliers relative to the diagonal of A, above 0.
    pub weight: f64,
    /// The common settings; an iteration is one triangular solve and one projection.
    pub settings: Settings,
}

impl Default for Admm {
    fn default() -> Self {
        Admm { weight: 0.3, settings: Settings::default() }
    }
}

impl Admm {
    /// Its name in the registry.
    pub const NAME: &'static str = "admm";
}

impl Solver for Admm {
    fn name(&self) -> &str {
        Admm::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let z = start.point(lcp);
        if lcp.len() > MAX_ROWS {
            let reason = "a dense factor of more than 8000 rows";
            return Solution::new(lcp, z, Status::OutsideClass { reason }, 0);
        }
        if let Some(status) = self.settings.refusal(Memory::square(lcp.len()).times(2)) {
            // Memory: A and R as dense matrices, summed in place.
            return Solution::new(lcp, z, status, 0);
        }
        let metric = match Metric::of_symmetric(lcp) {
            Ok(metric) => metric,
            Err(status) => return Solution::outside_class(lcp, z, status, 0, &self.settings),
        };
        let weight = self.weights(lcp, &metric);
        let regularized = lcp.matrix().to_dense() + DMatrix::from_diagonal(&weight);
        let Some(factor) = regularized.cholesky() else {
            let status = Status::OutsideClass { reason: "A is not positive semidefinite" };
            return Solution::outside_class(lcp, z, status, 0, &self.settings);
        };
        frozen::solve(lcp, z, &self.settings, |lcp, z, first| {
            // R y = −w
            let mut y = DVector::from_vec(lcp.w(&z)).component_div(&-&weight);
            iterate(lcp, z, first, &self.settings, observer, |z| {
                let pull = |i: usize| weight[i] * (z[i] - y[i]) - lcp.b()[i];
                let x = factor.solve(&DVector::from_fn(z.len(), |i, _| pull(i)));
                for i in 0..z.len() {
                    let relaxed = OVER_RELAXATION * x[i] + (1.0 - OVER_RELAXATION) * z[i];
                    z[i] = lcp.project(i, relaxed + y[i], &[]);
                    y[i] += relaxed - z[i];
                }
                ControlFlow::Continue(Event::Step)
            })
        })
    }
}

impl Admm {
    /// The diagonal of R.
    fn weights(&self, lcp: &Lcp, metric: &Metric) -> DVector<f64> {
        DVector::from_fn(lcp.len(), |i, _| {
            let bounded = lcp.lo()[i].is_finite()
                || lcp.hi()[i].is_finite()
                || lcp.coupling().is_some_and(|coupling| coupling.index(i).is_some());
            self.weight * metric.diagonal[i] * if bounded { 1.0 } else { WEIGHT_WITHOUT_BOUNDS }
        })
    }
}
