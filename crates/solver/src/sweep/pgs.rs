//! Projected Gauss-Seidel, and successive over-relaxation, which is the same method with another ω.
//!
//! ```text
//! x_i ← Π_i( x_i − ω w_i / a_ii ),   w_i = Σ_j a_ij x_j + b_i with the newest x,   i = 1 … n
//! ```
//!
//! ω = 1 is Gauss-Seidel (K&M (2) and (3)): row i is solved for x_i with the others fixed, then
//! clamped, *before* the next row is processed. (Code 6 clamps after the whole sweep and converges
//! to something else, E06.) 0 < ω < 1 takes shorter steps, 1 < ω < 2 longer ones. The rows may be
//! taken in any [`Order`]: forward and back gives *symmetric* SOR, color by color *red-black* SOR.
//!
//! For symmetric positive semidefinite A with positive diagonal and 0 < ω < 2 no update raises the
//! objective ½ xᵀAx + bᵀx, and x converges to a solution if one exists (Cryer 1971; Luo & Tseng
//! 1991). Neither the distance to it nor the residual needs to fall in each sweep (E67). While no
//! bound is active, each sweep reduces the error by the spectral radius of the [iteration
//! matrix](crate::theory); for a column of n bodies that is cos²(π/2n), so the number of sweeps
//! grows as n². A sweep costs one product A x, a symmetric sweep two.
//!
//! A row with a_ii ≤ 0 gives `ZeroDiagonal`; iterates that overflow give `Diverged`. A coupled row
//! is clamped to ±μ times the newest x of its normal row.

use std::ops::ControlFlow;

use crate::iterate::iterate_in_parts;
use crate::metric::Metric;
use crate::{Event, Observer, Order, RowUpdate, Settings, Solution, Solver, Start, StepDetail};
use lcplab_lcp::Lcp;

/// Projected Gauss-Seidel with relaxation.
#[derive(Debug, Clone)]
pub struct Pgs {
    /// The relaxation factor ω, above 0 and below 2; 1 is plain Gauss-Seidel.
    pub omega: f64,
    /// The order of the rows in a sweep.
    pub order: Order,
    /// The common settings; an iteration is a sweep over all rows.
    pub settings: Settings,
}

impl Default for Pgs {
    fn default() -> Self {
        Pgs { omega: 1.0, order: Order::Natural, settings: Settings::default() }
    }
}

impl Pgs {
    /// The name of projected Gauss-Seidel in the registry.
    pub const NAME: &'static str = "pgs";
    /// The name with ω ≠ 1: projected successive over-relaxation.
    pub const RELAXED: &'static str = "sor";
    /// The name with sweeps there and back.
    pub const SYMMETRIC: &'static str = "ssor";
    /// The name with sweeps color by color.
    pub const COLORED: &'static str = "red-black";
}

impl Solver for Pgs {
    fn name(&self) -> &str {
        match self.order {
            Order::Symmetric => Pgs::SYMMETRIC,
            Order::Colored => Pgs::COLORED,
            _ if self.omega == 1.0 => Pgs::NAME,
            _ => Pgs::RELAXED,
        }
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let metric = match Metric::of(lcp) {
            Ok(metric) => metric,
            Err(status) => return Solution::outside_class(lcp, x, status, 0, &self.settings),
        };
        let (order, omega) = (self.order.rows(lcp), self.omega);
        iterate_in_parts(lcp, x, 0, &self.settings, observer, |x, observer| {
            let wants_details = observer.wants_details();
            for &i in &order {
                let (w, diagonal, before) = (lcp.row_w(i, x), metric.diagonal[i], x[i]);
                let unclamped = before - omega * w / diagonal;
                // x_i ← Π_i(x_i − ω w_i / a_ii)
                x[i] = lcp.project(i, unclamped, x);
                if wants_details {
                    let after = x[i];
                    let row = RowUpdate { row: i, w, diagonal, omega, before, unclamped, after };
                    observer.part(&StepDetail::Row(row));
                }
            }
            ControlFlow::Continue(Event::Sweep)
        })
    }
}
