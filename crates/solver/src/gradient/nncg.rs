//! Nonsmooth nonlinear conjugate gradients around projected Gauss-Seidel.
//!
//! One sweep of [`Pgs`](crate::Pgs) is a map x → P(x) whose fixed points are the solutions. The
//! method treats its step as the negative gradient of an unknown function and runs Fletcher-Reeves
//! conjugate gradients on it (Silcowitz, Niebe & Erleben 2010):
//!
//! ```text
//! g⁺ = x − P(x),   β = |g⁺|² / |g|²
//! β ≤ 1:   p ← β p − g⁺,   x ← Π(x + p)        (that is P(x) + β p)
//! β > 1:   p ← 0,          x ← P(x)            (the sweep alone)
//! ```
//!
//! Gauss-Seidel is slow because its smoothest error component shrinks by only ρ ≈ 1 in each sweep;
//! the direction p accumulates these many small, nearly equal steps. On contact stacks this reduces
//! n² sweeps to about n, at nearly the same cost per sweep. There is no convergence proof: neither
//! the objective nor the residual decreases monotonically. Two safeguards: if the sweeps do not
//! shrink (β > 1), the method does one plain Gauss-Seidel step; and x is projected, whereas the
//! original method lets x leave the bounds until the next sweep. Lengths are measured by
//! D = diag(A).
//!
//! A row with a_ii ≤ 0 gives `ZeroDiagonal`; iterates that overflow give `Diverged`. A coupled row
//! is clamped to ±μ times the newest x of its normal row.

use std::ops::ControlFlow;

use crate::iterate::iterate;
use crate::metric::Metric;
use crate::{Event, Observer, Settings, Solution, Solver, Start};
use lcplab_lcp::Lcp;

/// Nonsmooth nonlinear conjugate gradients.
#[derive(Debug, Clone, Default)]
pub struct Nncg {
    /// The common settings; an iteration is a sweep followed by a conjugate step.
    pub settings: Settings,
}

impl Nncg {
    /// Its name in the registry.
    pub const NAME: &'static str = "nncg";
}

impl Solver for Nncg {
    fn name(&self) -> &str {
        Nncg::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let metric = match Metric::of(lcp) {
            Ok(metric) => metric,
            Err(status) => return Solution::outside_class(lcp, x, status, 0, &self.settings),
        };
        let mut p = vec![0.0; lcp.len()];
        // |g|² of the previous sweep; 0 makes the first β > 1.
        let mut last_square = 0.0;
        iterate(lcp, x, 0, &self.settings, observer, |x| {
            let before = x.to_vec();
            for i in 0..x.len() {
                x[i] = lcp.project(i, x[i] - lcp.row_w(i, x) / metric.diagonal[i], x);
            }
            let g: Vec<f64> = before.iter().zip(x.iter()).map(|(old, new)| old - new).collect();
            let square = metric.inner(&g, &g);
            if square <= last_square {
                let beta = square / last_square;
                for i in 0..x.len() {
                    x[i] += beta * p[i];
                    p[i] = beta * p[i] - g[i];
                }
                lcp.project_all(x);
            } else {
                p.fill(0.0);
            }
            last_square = square;
            ControlFlow::Continue(Event::Sweep)
        })
    }
}
