//! Lemke's complementary pivoting: follows a path of almost-solutions, for any square A.
//!
//! A covering variable z₀ makes every w big enough:
//!
//! ```text
//! w = A x + b + z₀ e,   x, w, z₀ ≥ 0,   x_i w_i = 0        e = (1, …, 1)
//! ```
//!
//! (Bounds are 0 and ∞ here: a boxed problem is first brought into this form, see
//! `standard_form.rs`. Where the units of the rows are far apart, e_i is that of
//! w_i.) At x = 0 the least z₀ that works has some w_r = 0. From there the partner of whatever has
//! just become zero is raised, until the next variable becomes zero: a *pivot*. The path never
//! forks, so it cannot return, and it ends in one of two ways:
//!
//! - z₀ becomes zero: x is a solution;
//! - nothing becomes zero: a *ray*, `Ray`. For copositive-plus A, which includes every positive
//!   semidefinite A, symmetric or not, this happens only if no x ≥ 0 has A x + b ≥ 0, hence if no
//!   solution exists. If A is symmetric too, the ray's x is a Farkas vector d, A d = 0 and bᵀd < 0,
//!   which the judge can check. For other A a ray says nothing about solvability.
//!
//! It also solves every problem whose A is a P-matrix and every problem with all bounds finite
//! (there z̃ = 0 on a ray, so a second ray does not exist). Ties in "which one becomes zero" are
//! broken lexicographically: c is perturbed by (ε, ε², …), which is read off the columns of the
//! first basis, so degenerate problems do not cycle; z₀ itself leaves whenever it can. The number
//! of pivots is about 2 n as a rule and 2ⁿ for Murty's matrix; each costs O(n²) on a condensed
//! tableau. Where A is symmetric the path can be followed by principal pivots, which are cheaper
//! and exacter (parametric.rs); if one of them cannot be trusted, or somebody wants to see the
//! tableaux, they are made. Rows without bounds that depend on others, as in redundant joints, stay
//! out of the tableau then.
//!
//! At the end x is computed afresh from the active set. Rounding piles up, and can even lead a path
//! back to where it was. Such a path, and one of more than 50 pivots or with a very small pivot
//! that ends at no solution, is followed once more, with a tableau that is made anew every 50
//! pivots; its pivots are counted on, and the solution says so ([`Fallback`]).
//!
//! Lemke 1965; Cottle, Pang & Stone 1992, algorithm 4.4.5. Coupled rows: see
//! [`frozen`].

mod end;
mod parametric;
mod path;

use std::ops::ControlFlow;

use self::parametric::{End, Parametric};
use self::path::Path;
use crate::pivot::standard_form::cover;
use crate::pivot::{opening, proximal};
use crate::{Fallback, Iterate, Observer, Part, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_problem::Lcp;
use lcplab_problem::memory::Memory;

/// A path of more pivots may be followed a second time; then the tableau is made anew after each so
/// many pivots.
const PIVOTS_TO_RENEWAL: usize = 50;

/// Lemke's method with lexicographic ties.
#[derive(Debug, Clone, Default)]
pub struct Lemke {
    /// The common settings; an iteration is a pivot, the entry of the covering variable included.
    pub settings: Settings,
}

impl Solver for Lemke {
    fn name(&self) -> &'static str {
        "lemke"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let by_principal_pivots = !observer.asks_for_parts() && lcp.matrix().is_nearly_symmetric();
        let open = match start.x {
            None if by_principal_pivots => opening::begin, // the path begins with the same look at x
            _ => opening::at_once,
        };
        if let Some(status) = open(lcp, &x, tableaux(lcp), &self.settings, observer) {
            return Solution::new(lcp, x, status, 0);
        }
        frozen::solve(lcp, x, &self.settings, |frozen, _, before| {
            frozen::tell(lcp, frozen, observer);
            let lcp = frozen;
            let mut seen = 0;
            if by_principal_pivots {
                let mut path = Parametric::new(lcp, cover(lcp), before);
                match path.solve(&self.settings, observer) {
                    Some(End::Point(point)) => return point.solution(Status::Solved, path.pivots),
                    Some(End::Status(status, x)) => {
                        let failed = Solution::new(lcp, x, status, path.pivots);
                        return proximal::after(lcp, failed, &self.settings);
                    }
                    None => seen = path.pivots - before,
                }
            }
            let solution = self.by_tables(lcp, before, &mut Later { seen, observer });
            match lcp.matrix().is_nearly_symmetric() {
                true => proximal::after(lcp, solution, &self.settings),
                false => solution,
            }
        })
    }
}

impl Lemke {
    /// Follows the path by Lemke's tables, after so many pivots on other problems; a second time
    /// where rounding may have led astray.
    fn by_tables(&self, lcp: &Lcp, before: usize, observer: &mut dyn Observer) -> Solution {
        let mut path = Path::new(lcp, before);
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
        let mut path = Path::new(lcp, path.pivots).with_renewals();
        let (x, status) = path.solve(&self.settings, observer);
        let solution = Solution::new(lcp, x, status, path.pivots);
        solution.with_fallback(Some(Fallback::SecondPath))
    }
}

/// An observer that has seen the first pivots already.
struct Later<'a> {
    seen: usize,
    observer: &'a mut dyn Observer,
}

impl Observer for Later<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        if self.seen > 0 {
            self.seen -= 1;
            return ControlFlow::Continue(());
        }
        self.observer.observe(iterate)
    }

    fn asks_for_parts(&self) -> bool {
        self.observer.asks_for_parts()
    }

    fn part(&mut self, part: &Part<'_>) {
        self.observer.part(part);
    }
}

/// Room for three tableaux: the first, the one that is pivoted, and one to make that anew.
fn tableaux(lcp: &Lcp) -> Memory {
    Memory::square(lcp.len() + 2).times(3)
}
