//! Lemke's complementary pivoting: follows a path of almost complementary points, for any square A.
//!
//! A covering variable z₀ makes every w nonnegative:
//!
//! ```text
//! w = A x + b + z₀ e,   x, w, z₀ ≥ 0,   x_i w_i = 0        e = (1, …, 1)
//! ```
//!
//! (Bounds are 0 and ∞ here; a boxed problem is first transformed, see `standard_form.rs`. If the
//! units of the rows are very different, e_i is the unit of w_i.) At x = 0 the least possible z₀
//! has some w_r = 0. From there the complement of the variable that has just become zero is
//! increased until the next variable becomes zero: a *pivot*. The path never branches, so it cannot
//! return, and it ends in one of two ways:
//!
//! - z₀ becomes zero: x is a solution;
//! - no variable becomes zero: a *ray*, `Ray`. For copositive-plus A, which includes every positive
//!   semidefinite A, symmetric or not, this happens only if no x ≥ 0 has A x + b ≥ 0, hence if no
//!   solution exists. If A is also symmetric, the ray's x is a Farkas vector d, A d = 0 and
//!   bᵀd < 0, which the judge can check. For other A a ray proves nothing about solvability.
//!
//! The method also solves every problem whose A is a P-matrix and every problem whose bounds are
//! all finite (there z̃ = 0 on a ray, so a second ray does not exist). Ties between variables that
//! become zero are broken lexicographically: c is perturbed by (ε, ε², …), which is read off the
//! columns of the first basis, so degenerate problems do not cycle; z₀ itself leaves whenever it
//! can. The number of pivots is usually about 2 n, and 2ⁿ for Murty's matrix; each costs O(n²) on a
//! condensed tableau. If A is symmetric, the path can be followed by principal pivots, which are
//! cheaper and more accurate (parametric.rs). The tableau is used if one of these pivots is
//! unreliable or an observer wants the tableaux. Rows without bounds that depend on others, as in
//! redundant joints, are then left out of the tableau.
//!
//! At the end x is computed afresh from the active set. Rounding errors accumulate and can even
//! lead a path back to an earlier basis. Such a path, and one with more than 50 pivots or a very
//! small pivot that does not end at a solution, is followed once more with a tableau that is
//! recomputed every 50 pivots. Its pivots are added to the count, and the solution reports it
//! ([`Fallback`]).
//!
//! Lemke 1965; Cottle, Pang & Stone 1992, algorithm 4.4.5. Coupled rows: see
//! [`frozen`].

mod end;
mod parametric;
mod path;

use self::parametric::{End, Parametric};
use self::path::Path;
use crate::pivot::standard_form::cover;
use crate::pivot::{opening, proximal};
use crate::{Fallback, Observer, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_lcp::Lcp;
use lcplab_lcp::memory::Memory;

/// A path with more pivots may be followed a second time, and then the tableau is recomputed after
/// each this many pivots.
const PIVOTS_TO_RENEWAL: usize = 50;

/// Lemke's method with the lexicographic rule for ties.
#[derive(Debug, Clone, Default)]
pub struct Lemke {
    /// The common settings; an iteration is a pivot, including the entry of the covering variable.
    pub settings: Settings,
}

impl Lemke {
    /// Its name in the registry.
    pub const NAME: &'static str = "lemke";
}

impl Solver for Lemke {
    fn name(&self) -> &str {
        Lemke::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let by_principal_pivots = !observer.wants_details() && lcp.matrix().is_nearly_symmetric();
        let open = match start.x {
            // The path begins with the same check of x.
            None if by_principal_pivots => opening::begin,
            _ => opening::at_once,
        };
        if let Some(status) = open(lcp, &x, tableaux(lcp), &self.settings, observer) {
            return Solution::new(lcp, x, status, 0);
        }
        frozen::solve(lcp, x, &self.settings, |frozen, _, before| {
            frozen::report(lcp, frozen, observer);
            let lcp = frozen;
            let mut reported = before;
            if by_principal_pivots {
                let mut path = Parametric::new(lcp, cover(lcp), before);
                match path.solve(&self.settings, observer) {
                    Some(End::Point(point)) => return point.solution(Status::Solved, path.pivots),
                    Some(End::Status(status, x)) => {
                        let failed = Solution::new(lcp, x, status, path.pivots);
                        return proximal::after(lcp, failed, &self.settings);
                    }
                    None => reported = path.pivots,
                }
            }
            let solution = self.by_tables(lcp, before, reported, observer);
            match lcp.matrix().is_nearly_symmetric() {
                true => proximal::after(lcp, solution, &self.settings),
                false => solution,
            }
        })
    }
}

impl Lemke {
    /// Follows the path with tableaux, after `before` pivots on other problems; a second time if
    /// rounding may have led to a wrong path. The observer already knows the pivots up to number
    /// `reported`, which were made without tableaux.
    fn by_tables(
        &self,
        lcp: &Lcp,
        before: usize,
        reported: usize,
        observer: &mut dyn Observer,
    ) -> Solution {
        let mut path = Path::new(lcp, before, reported);
        let (x, status) = path.solve(&self.settings, observer);
        let is_long = path.is_doubtful || path.pivots - before > PIVOTS_TO_RENEWAL;
        let is_led_astray = match status {
            Status::Ray { .. } | Status::NotFinite | Status::Inaccurate => is_long,
            Status::Stalled => true,
            _ => false,
        };
        if !is_led_astray {
            return Solution::new(lcp, x, status, path.pivots);
        }
        let mut path = Path::new(lcp, path.pivots, reported).with_renewals();
        let (x, status) = path.solve(&self.settings, observer);
        let solution = Solution::new(lcp, x, status, path.pivots);
        solution.with_fallback(Some(Fallback::SecondPath))
    }
}

/// The memory for three tableaux: the first, the current one, and one to recompute it.
fn tableaux(lcp: &Lcp) -> Memory {
    Memory::square(lcp.len() + 2).times(3)
}
