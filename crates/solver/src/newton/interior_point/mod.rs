//! A primal-dual interior-point method for the quadratic program over the box.
//!
//! Each finite bound k of a row i(k) gets a *slack* ρ_k > 0, the distance from x_i to it, and a
//! multiplier z_k > 0, the force away from it, with sign s_k = 1 at a lower bound and −1 at an
//! upper one. The product of slack and multiplier approaches zero along the *central path*, μ → 0:
//!
//! ```text
//! A x + b = Σ_k s_k z_k,   ρ_k z_k = μ
//! ```
//!
//! An iteration is a Newton step on these equations. Eliminating the changes of the multipliers
//! gives
//!
//! ```text
//! (A + Σ_k z_k/ρ_k) dx = −(A x + b − Σ_k s_k z_k) + Σ_k s_k r_k/ρ_k,   r_k = μ − ρ_k z_k
//! dz_k = (r_k − s_k z_k dx) / ρ_k
//! ```
//!
//! It is solved twice with one factorization (Mehrotra 1992): first for μ = 0 to see which value μ'
//! that would reach; then for (μ'/μ)³ μ, with the error dρ dz of the first step subtracted from r.
//! It takes ten to thirty iterations whatever the size and condition of A, for symmetric
//! semidefinite A. A singular A is no difficulty, because the bounds add to the diagonal (rows
//! without bounds get 10⁻¹² a_ii; without any bounds a single iteration is Cholesky's method). Each
//! iteration factorizes a matrix with the pattern of A: n³/6 products for a dense A, n b²/2 for
//! bandwidth b. If solutions are not unique, the method finds one in the middle of the solution
//! set.
//!
//! If A is not symmetric, each iteration factorizes A + D by LU (`general.rs`), and near the end of
//! the path the point of the suggested active set is tried, whose accuracy is that of the
//! factorization. This solves monotone problems, xᵀA x ≥ 0 for all x: convex quadratic programs
//! with constraints. Other problems may end in any status but `Solved` with a wrong x.
//!
//! Rows at a bound end at a distance of about μ/w_i from it: the answer is only as accurate as the
//! tolerance. A start is used only if it lies well inside the bounds. No Cholesky factor of a
//! symmetric A: `OutsideClass`; vanishing steps: `Stalled`. Coupled rows: see [`frozen`].

mod general;
mod path;
mod rows;
mod step;

use general::General;
use path::Path;
use rows::Rows;
use step::StepEquations;

use std::ops::ControlFlow;

use crate::iterate::iterate;
use crate::metric;
use crate::{Observer, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_lcp::memory::Memory;
use lcplab_lcp::{Lcp, merit};

/// Maximum number of entries of the factor; with more, a factorization takes too long.
const MAX_ENTRIES: usize = 32_000_000;

/// Mehrotra's predictor-corrector method.
#[derive(Debug, Clone, Default)]
pub struct InteriorPoint {
    /// The common settings; an iteration is a factorization and two solves.
    pub settings: Settings,
}

impl InteriorPoint {
    /// Its name in the registry.
    pub const NAME: &'static str = "interior-point";
}

impl Solver for InteriorPoint {
    fn name(&self) -> &str {
        InteriorPoint::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let solution = if lcp.matrix().is_nearly_symmetric() {
            metric::diagonal(lcp)
                .and_then(|diagonal| Rows::of(lcp, diagonal, |entries| self.fit(entries)))
                .map(|mut rows| self.follow(lcp, x.clone(), &mut rows, observer))
        } else {
            General::of(lcp, |entries| self.fit(entries))
                .map(|mut rows| self.follow(lcp, x.clone(), &mut rows, observer))
        };
        solution.unwrap_or_else(|status| Solution::outside_class(lcp, x, status, 0, &self.settings))
    }
}

impl InteriorPoint {
    /// Checks that factors may have this many entries.
    fn fit(&self, entries: usize) -> Result<(), Status> {
        match self.settings.refusal(Memory::numbers(entries)) {
            Some(status) => Err(status),
            None if entries > MAX_ENTRIES => {
                let reason = "a factor of more than 32 million entries";
                Err(Status::OutsideClass { reason })
            }
            None => Ok(()),
        }
    }

    /// Follows the central path from x, once for each set of frozen bounds.
    fn follow(
        &self,
        lcp: &Lcp,
        x: Vec<f64>,
        equations: &mut impl StepEquations,
        observer: &mut dyn Observer,
    ) -> Solution {
        frozen::solve(lcp, x, &self.settings, |lcp, x, first| {
            // A start that is a solution must not be moved inside.
            let mut path = None;
            iterate(lcp, x, first, &self.settings, observer, |x| {
                let path = path.get_or_insert_with(|| Path::from_inside(lcp, equations, x));
                let event = path.step(equations, x)?;
                match path.refined(equations, x) {
                    Some(refined)
                        if merit::scaled_residual(lcp, &refined) <= self.settings.tolerance =>
                    {
                        x.copy_from_slice(&refined);
                        // The path is left: the loop accepts this x or ends here.
                        ControlFlow::Break(Status::Stalled)
                    }
                    _ => ControlFlow::Continue(event),
                }
            })
        })
    }
}
