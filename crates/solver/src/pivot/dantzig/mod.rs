//! Dantzig's pivoting method for boxed LCPs with symmetric positive semidefinite A.
//!
//! Rows are satisfied one after another (Cottle & Dantzig 1968; Baraff 1994 for contacts). To drive
//! w_i to zero, x_i moves and the *free* rows C move along so that their w stays zero:
//!
//! ```text
//! d_C = −A_CC⁻¹ A_Ci,   d_i = 1,   Δw = A d,   Δw_i = s = a_ii − A_iC A_CC⁻¹ A_Ci ≥ 0
//! ```
//!
//! until w_i = 0 (i becomes free), x_i meets a bound, some x_j of C meets a bound (j leaves C), or
//! some w_j at a bound reaches zero (j enters C). The directions are solved for with a factor
//! A_CC = L D Lᵀ that each pivot brings up to date.
//!
//! Redundant contacts make A singular. Then s = 0 for a row that depends on C, and since A is
//! semidefinite A d = 0: moving along d changes no w at all, and w_i is dᵀw. If that is zero the
//! row is *idle*: C keeps its w at zero, and when a row leaves C an idle one takes its place. What
//! x may move along d without harm is shared: x goes to the middle of it, so that few rows need
//! leave C (centring.rs). If dᵀw is not zero x moves until a bound stops it and that row leaves C.
//! If nothing stops it, a dᵀw within the tolerance is what the data of redundant joints are rounded
//! to, and the row is idle too; a larger one, bᵀd < 0 with A d = 0, proves that no solution exists
//! (`Ray`).
//!
//! Whether s is zero is decided without units, and by what rounding can do. A itself is rounded,
//! each a_jk by up to ε √(a_jj a_kk), which moves s = dᵀA d by up to ε (Σ √a_jj |d_j|)²: an s below
//! some ten times that is none. run.rs has the method, direction.rs the direction and this
//! decision, blocking.rs what ends a move and the rule for ties, exchange.rs the pivot, polish.rs
//! the end; [`textbook`](crate::textbook) has it on one page, for definite A and without regard to
//! rounding.
//!
//! Ends with the exact active set but for rounding, after at most a few n pivots on contact
//! problems (2ⁿ in the worst case); a pivot costs O(c² + c n) for c free rows. Then x is refined
//! with accurate w, if need be with C chosen anew by the largest pivot, and rows that rounding has
//! left unsatisfied are driven once more. With mass ratios of 10⁶ rounding remains in the light
//! bodies' rows; Gauss-Seidel sweeps remove it. Rows of joints that have drifted apart may depend
//! on each other so nearly that no pivot can tell; then proximal steps (proximal.rs) have a try.
//! The solution names either ([`Fallback`](crate::Fallback)). Not symmetric or not semidefinite A:
//! `OutsideClass`. Coupled rows: see [`frozen`].

mod blocking;
mod centring;
mod direction;
mod exchange;
mod polish;
mod run;

use self::run::Run;
use super::proximal;
use crate::{Event, Iterate, Observer, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_problem::Lcp;
use lcplab_problem::memory::Memory;

/// Above this many rows a dense factor takes too long.
const MAX_ROWS: usize = 8_000;

/// Dantzig's pivoting method with an updated L D Lᵀ factorization.
#[derive(Debug, Clone, Default)]
pub struct Dantzig {
    /// The common settings; an iteration is a move of x, most of them pivots.
    pub settings: Settings,
}

impl Solver for Dantzig {
    fn name(&self) -> &'static str {
        "dantzig"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        if lcp.len() > MAX_ROWS {
            let reason = "a dense factor of more than 8000 rows";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
        }
        if let Some(status) = self.settings.refusal(Memory::square(lcp.len())) {
            return Solution::new(lcp, x, status, 0); // two triangles: a factor, and one made anew
        }
        if !lcp.matrix().is_nearly_symmetric() {
            let reason = "A is not symmetric";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
        }
        if observer.observe(&Iterate { iteration: 0, x: &x, event: Event::Start }).is_break() {
            return Solution::new(lcp, x, Status::Stopped, 0);
        }
        frozen::solve(lcp, x, &self.settings, |frozen, start, pivots| {
            frozen::tell(lcp, frozen, observer);
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
                Err(status) => Solution::new(lcp, run.state.x, status, pivots),
            };
            let solution = solution.with_fallback(fallback);
            proximal::after(lcp, solution, &self.settings)
        })
    }
}

/// Whether a row has no bounds. Where such a row depends on others no x changes its w, and all that
/// can be asked of it is the tolerance.
fn is_unbounded(lcp: &Lcp, i: usize) -> bool {
    lcp.lo()[i].is_infinite() && lcp.hi()[i].is_infinite() && !lcp.is_coupled(i)
}

/// Where a row of Dantzig's method stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Not looked at yet: nothing is asked of its w.
    Waiting,
    /// In C: w = 0 is kept by moving x.
    Free,
    /// Its w is a combination of those of C, and zero with them, or within the tolerance.
    Idle,
    /// At its lower bound, w ≥ 0.
    Lower,
    /// At its upper bound, w ≤ 0.
    Upper,
}
