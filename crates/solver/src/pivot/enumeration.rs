//! Enumeration: tries every active set, in exact arithmetic.
//!
//! Each row is at its lower bound, free, or at its upper bound: 2ⁿ sets for contacts, 3ⁿ for boxes;
//! coupled rows are at −μ x_k, free, or at +μ x_k. For each set the linear equations are solved in
//! rational arithmetic (every floating-point number is rational), and all bounds and signs are
//! decided exactly ([`exact`](lcplab_lcp::exact)). The answer is therefore proved: a solution,
//! or `NoSolution`. It works for any matrix. It is the reference for tests of the other methods,
//! and shows that the worst case of pivoting, 2ⁿ, is no worse than trying all sets.
//!
//! If the iteration limit ends the search, `SetsLeft` states how many of the sets were tried.
//! Exact elimination costs O(n³) per set, so the number of sets is limited: `OutsideClass` above
//! 65,536 (16 contacts, 10 boxes). Coupled problems are enumerated up to three contacts with two
//! tangents each; for more, the bounds are [`frozen`], which may give a solution but proves
//! nothing. Sets are counted with row 0 fastest. The start matters only for frozen bounds.

use super::active_set::claim;
use super::opening;
use crate::{Event, Iterate, Observer, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_lcp::exact::{Pieces, Point};
use lcplab_lcp::memory::Memory;
use lcplab_lcp::{Complementarity, Lcp};

/// Enumeration of all active sets; stops at the first solution.
#[derive(Debug, Clone, Default)]
pub struct Enumeration {
    /// The common settings; an iteration is an active set.
    pub settings: Settings,
}

impl Enumeration {
    /// Its name in the registry.
    pub const NAME: &'static str = "enumeration";
}

impl Solver for Enumeration {
    fn name(&self) -> &str {
        Enumeration::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        if let Some(status) = opening::begin(lcp, &x, Memory::numbers(0), &self.settings, observer)
        {
            return Solution::new(lcp, x, status, 0);
        }
        let solution = self.try_all(lcp, x.clone(), 0, observer);
        if lcp.is_frozen() || !matches!(solution.status, Status::OutsideClass { .. }) {
            return solution;
        }
        frozen::solve(lcp, x, &self.settings, |frozen, x, before| {
            let solution = self.try_all(frozen, x, before, observer);
            match solution.status {
                // other frozen bounds may have a solution
                Status::NoSolution => Solution { status: Status::Stalled, ..solution },
                _ => solution,
            }
        })
    }
}

impl Enumeration {
    fn try_all(
        &self,
        lcp: &Lcp,
        x: Vec<f64>,
        before: usize,
        observer: &mut dyn Observer,
    ) -> Solution {
        let Some(pieces) = Pieces::of(lcp) else {
            let reason = "more than 65,536 active sets";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, before);
        };
        for k in 0..pieces.count() {
            let count = before + k + 1;
            if count > self.settings.max_iterations {
                let status = Status::SetsLeft { tried: k, count: pieces.count() };
                return Solution::new(lcp, x, status, count - 1);
            }
            let found = pieces.solutions(&pieces.piece(k)).first().map(rounded);
            if !found.iter().flatten().all(|x| x.is_finite()) {
                // A number exceeds 1.8e308.
                return Solution::new(lcp, x, Status::NotFinite, count);
            }
            let iterate = found.as_deref().unwrap_or(&x);
            let iterate = Iterate { iteration: count, x: iterate, event: Event::Trial };
            if observer.observe(&iterate).is_break() {
                return Solution::new(lcp, x, Status::Stopped, count);
            }
            if let Some(x) = found {
                let status = claim(lcp, &x, &self.settings);
                return Solution::new(lcp, x, status, count);
            }
        }
        Solution::new(lcp, x, Status::NoSolution, before + pieces.count())
    }
}

fn rounded(x: &Point) -> Vec<f64> {
    x.entries().iter().map(|x| x.to_f64().value()).collect()
}
