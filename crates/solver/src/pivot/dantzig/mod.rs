//! Dantzig's pivoting method for boxed LCPs with symmetric positive semidefinite A.
//!
//! Rows are satisfied one after another (Cottle & Dantzig 1968; Baraff 1994 for contacts). To drive
//! w_i to zero, x_i moves, and the *free* rows C move with it so that their w stays zero:
//!
//! ```text
//! d_C = −A_CC⁻¹ A_Ci,   d_i = 1,   Δw = A d,   Δw_i = s = a_ii − A_iC A_CC⁻¹ A_Ci ≥ 0
//! ```
//!
//! until w_i = 0 (i becomes free), x_i reaches a bound, some x_j of C reaches a bound (j leaves C),
//! or some w_j at a bound reaches zero (j enters C). The direction is computed with a factor
//! A_CC = L D Lᵀ that each pivot updates.
//!
//! Redundant contacts make A singular. Then s = 0 for a row that depends on C, and since A is
//! semidefinite, A d = 0: moving along d changes no w, and w_i is dᵀw. If that is zero, the row is
//! *dependent* (`Dependent`): C keeps its w at zero, and when a row leaves C, a dependent one
//! replaces it. x moves to the middle of its feasible range along d, so that few rows need to leave
//! C (centering.rs). If dᵀw is not zero, x moves until it reaches a bound, and that row leaves C.
//! If there is no such bound, a dᵀw within the tolerance is attributed to rounding in the data of
//! redundant joints, and the row is dependent; a larger one, bᵀd < 0 with A d = 0, proves that no
//! solution exists (`Ray`).
//!
//! The test whether s is zero is independent of units and based on rounding. A itself is rounded,
//! each a_jk by up to ε √(a_jj a_kk), which changes s = dᵀA d by up to ε (Σ √a_jj |d_j|)²; an s
//! below about ten times that counts as zero. run.rs has the method, direction.rs the direction and
//! this test, blocking.rs the end of a move and the rule for ties, exchange.rs the pivot, refine.rs
//! the final refinement. [`textbook`](crate::textbook) has a one-page version for definite A
//! without regard to rounding.
//!
//! The result is the exact active set up to rounding, after at most a few n pivots on contact
//! problems (2ⁿ in the worst case); a pivot costs O(c² + c n) for c free rows. Then x is refined
//! with an accurate w, if necessary with C chosen again by largest pivots, and rows that are not
//! satisfied because of rounding are driven once more. With mass ratios of 10⁶ rounding errors
//! remain in the rows of the light bodies; Gauss-Seidel sweeps remove them. Rows of joints that
//! have drifted apart may be so nearly dependent that no pivot can decide; then proximal steps
//! (proximal.rs) are tried. The solution names either fallback ([`Fallback`](crate::Fallback)). A
//! not symmetric or not semidefinite: `OutsideClass`. Coupled rows: see [`frozen`].

mod blocking;
mod centering;
mod direction;
mod exchange;
mod refine;
mod run;

use self::run::Run;
use super::{opening, proximal};
use crate::{Observer, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_lcp::Lcp;
use lcplab_lcp::memory::Memory;

/// Dantzig's pivoting method with an updated L D Lᵀ factorization.
#[derive(Debug, Clone, Default)]
pub struct Dantzig {
    /// The common settings; an iteration is a move of x, usually a pivot.
    pub settings: Settings,
}

impl Dantzig {
    /// Its name in the registry.
    pub const NAME: &'static str = "dantzig";
}

impl Solver for Dantzig {
    fn name(&self) -> &str {
        Dantzig::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        if !lcp.matrix().is_nearly_symmetric() {
            let status = Status::OutsideClass { reason: "A is not symmetric" };
            return Solution::outside_class(lcp, x, status, 0, &self.settings);
        }
        // Memory: two triangles, the factor and its recomputation, and the rows of A.
        let needs = Memory::square(lcp.len()).times(2);
        if let Some(status) = opening::begin(lcp, &x, needs, &self.settings, observer) {
            return Solution::new(lcp, x, status, 0);
        }
        frozen::solve(lcp, x, &self.settings, |frozen, start, pivots| {
            frozen::report(lcp, frozen, observer);
            let lcp = frozen;
            let mut run = Run::new(lcp, start.clone(), pivots, &self.settings, observer);
            let end = run.solve();
            let (pivots, fallback) = (run.pivots, run.fallback);
            let x = end.as_ref().map_or(&run.state.x, |point| &point.x);
            if x.iter().any(|x| !x.is_finite()) {
                return Solution::new(lcp, start, Status::NotFinite, pivots);
            }
            let solution = match end {
                Ok(point) => {
                    let status = point.claim(lcp, self.settings.tolerance);
                    point.solution(status, pivots)
                }
                Err(status @ Status::OutsideClass { .. }) => {
                    Solution::outside_class(lcp, run.state.x, status, pivots, &self.settings)
                }
                Err(status) => Solution::new(lcp, run.state.x, status, pivots),
            };
            let solution = solution.with_fallback(fallback);
            proximal::after(lcp, solution, &self.settings)
        })
    }
}

/// Whether a row has no bounds. If such a row depends on others, no x changes its w, and it only
/// has to meet the tolerance.
fn is_unbounded(lcp: &Lcp, i: usize) -> bool {
    lcp.lo()[i].is_infinite() && lcp.hi()[i].is_infinite() && !lcp.is_coupled(i)
}

/// The side of a row in Dantzig's method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Not processed yet: no requirement on its w.
    Unprocessed,
    /// In C: x moves to keep w = 0.
    Free,
    /// Its w is a combination of those of C, and zero like them, or within the tolerance.
    Dependent,
    /// At its lower bound, w ≥ 0.
    Lower,
    /// At its upper bound, w ≤ 0.
    Upper,
}
