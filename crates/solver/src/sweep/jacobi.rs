//! Projected Jacobi with damping.
//!
//! ```text
//! x ← Π( x − θ D⁻¹ w ),   D = diag(A),   w = A x + b
//! ```
//!
//! All rows are updated from the same w; Gauss-Seidel ([`Pgs`](crate::Pgs)) uses the newest x
//! instead. The rows can therefore be processed in parallel, and their order does not matter:
//! permuting the rows permutes the iterates. It is the projected gradient method with step θ, with
//! lengths measured by D.
//!
//! For symmetric positive semidefinite A the method converges, and the objective ½ xᵀAx + bᵀx falls
//! in each sweep, if 0 < θ < 2/λ with λ the largest eigenvalue of D⁻¹A. Plain Jacobi, θ = 1,
//! therefore does *not* converge for every positive definite A: with ones on the diagonal and 0.9
//! elsewhere (n = 3), λ = 2.8 (E09). Two rows always have λ ≤ 2; k rows that are all coupled may
//! have λ close to k. [`Damping::Safe`] sets 1/θ to an upper bound on λ. A sweep costs one product
//! A x.
//!
//! A row with a_ii ≤ 0 gives `ZeroDiagonal`; iterates that overflow give `Diverged`. Coupled rows
//! are clamped to ±μ times the new x of their normal rows.

use std::ops::ControlFlow;

use crate::iterate::iterate;
use crate::metric::Metric;
use crate::{Event, Observer, Settings, Solution, Solver, Start};
use lcplab_lcp::Lcp;

/// Projected Jacobi.
#[derive(Debug, Clone, Default)]
pub struct Jacobi {
    /// The step length.
    pub damping: Damping,
    /// The common settings; an iteration is a sweep over all rows.
    pub settings: Settings,
}

/// The damping factor θ.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Damping {
    /// 1 / max_i Σ_j |a_ij| / √(a_ii a_jj), which converges for every semidefinite A.
    #[default]
    Safe,
    /// This θ; 1 is plain Jacobi.
    Factor(f64),
}

impl Damping {
    /// θ for a problem with this metric.
    pub(crate) fn factor(self, metric: &Metric) -> f64 {
        match self {
            Damping::Safe => 1.0 / metric.eigenvalue,
            Damping::Factor(theta) => theta,
        }
    }
}

impl Jacobi {
    /// Its name in the registry.
    pub const NAME: &'static str = "jacobi";
}

impl Solver for Jacobi {
    fn name(&self) -> &str {
        Jacobi::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let metric = match Metric::of(lcp) {
            Ok(metric) => metric,
            Err(status) => return Solution::outside_class(lcp, x, status, 0, &self.settings),
        };
        let theta = self.damping.factor(&metric);
        iterate(lcp, x, 0, &self.settings, observer, |x| {
            let gradient = metric.gradient(lcp, x);
            for (x, g) in x.iter_mut().zip(&gradient) {
                *x -= theta * g;
            }
            lcp.project_all(x);
            ControlFlow::Continue(Event::Sweep)
        })
    }
}
