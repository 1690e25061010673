//! Projected Gauss-Seidel, and successive over-relaxation, which is the same with another ω.
//!
//! ```text
//! x_i ← Π_i( x_i − ω w_i / a_ii ),   w_i = Σ_j a_ij x_j + b_i with the newest x,   i = 1 … n
//! ```
//!
//! ω = 1 is Gauss-Seidel (K&M (2) and (3)): row i is solved for x_i while the others wait, then
//! clamped, *before* the next row is looked at. (Code 6 clamps after the whole sweep and converges
//! to something else, E06.) 0 < ω < 1 takes shorter steps, 1 < ω < 2 longer ones.
//!
//! For symmetric positive semidefinite A with positive diagonal and 0 < ω < 2 no update raises the
//! objective ½ xᵀAx + bᵀx, and x converges to a solution if there is one (Cryer 1971; Luo & Tseng
//! 1991). Where no bound is active the error shrinks by the spectral radius of the iteration matrix
//! in each sweep; for a column of n bodies that is cos²(π/2n), so the sweeps needed grow as n².
//! A sweep costs one product A x.
//!
//! A row with a_ii ≤ 0 ends it with `ZeroDiagonal`; iterates that overflow with `Diverged`.
//! A coupled row is clamped to ±μ times the newest x of its normal row.

use super::{Event, Iterate, Observer, Settings, Solution, Solver, Start, Status};
use crate::lcp::{Lcp, merit};

/// Projected Gauss-Seidel with relaxation.
#[derive(Debug, Clone)]
pub struct Pgs {
    /// The relaxation factor ω, above 0 and below 2; 1 is plain Gauss-Seidel.
    pub omega: f64,
    /// The common settings; an iteration is a sweep over all rows.
    pub settings: Settings,
}

impl Solver for Pgs {
    fn name(&self) -> &'static str {
        if self.omega == 1.0 { "pgs" } else { "sor" }
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let Settings { tolerance, max_iterations, check_every } = self.settings;
        let mut x = start.point(lcp);
        if let Some(row) = (0..lcp.len()).find(|&i| !is_solvable(lcp, i)) {
            return Solution::new(lcp, x, Status::ZeroDiagonal { row }, 0);
        }
        if observer.observe(&Iterate { iteration: 0, x: &x, event: Event::Start }).is_break() {
            return Solution::new(lcp, x, Status::Stopped, 0);
        }
        let mut last_finite = x.clone();
        for iteration in 1..=max_iterations {
            sweep(lcp, self.omega, &mut x);
            let event = Event::Sweep;
            if observer.observe(&Iterate { iteration, x: &x, event }).is_break() {
                return Solution::new(lcp, x, Status::Stopped, iteration);
            }
            if iteration % check_every == 0 || iteration == max_iterations {
                if x.iter().any(|x| !x.is_finite()) {
                    return Solution::new(lcp, last_finite, Status::Diverged, iteration);
                }
                if merit::scaled_residual(lcp, &x) <= tolerance {
                    return Solution::new(lcp, x, Status::Solved, iteration);
                }
                last_finite.copy_from_slice(&x);
            }
        }
        let status = if merit::scaled_residual(lcp, &x) <= tolerance {
            Status::Solved
        } else {
            Status::IterationLimit
        };
        Solution::new(lcp, x, status, max_iterations)
    }
}

/// One sweep over all rows.
fn sweep(lcp: &Lcp, omega: f64, x: &mut [f64]) {
    for i in 0..x.len() {
        if lcp.lo()[i] == lcp.hi()[i] {
            continue;
        }
        let step = omega * lcp.row_w(i, x) / lcp.matrix().diagonal(i);
        x[i] = lcp.project(i, x[i] - step, x); // x_i ← Π_i(x_i − ω w_i / a_ii)
    }
}

/// Whether row i can be solved for x_i, or is pinned and need not be.
fn is_solvable(lcp: &Lcp, i: usize) -> bool {
    lcp.matrix().diagonal(i) > 0.0 || lcp.lo()[i] == lcp.hi()[i]
}
