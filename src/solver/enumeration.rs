//! Enumeration: tries every active set, in exact arithmetic.
//!
//! Each row is at its lower bound, free, or at its upper bound: 2ⁿ sets for contacts, 3ⁿ for boxes, and
//! coupled rows at −μ x_k, free, or at +μ x_k. For each set the linear equations are solved over the
//! rationals (every floating-point number is one) and all bounds and signs are decided exactly
//! ([`exact`](crate::lcp::exact)). So the answer is the truth: a solution, or `NoSolution`. It knows no
//! class of matrices; it is the reference that the other methods are tested against, and the proof
//! that the worst case of pivoting, 2ⁿ, is no worse than trying everything.
//!
//! Exact elimination costs O(n³) a set, so the number of sets is limited: `OutsideClass` above 65536
//! (16 contacts, 10 boxes). Sets are counted with row 0 fastest. The start makes no difference.

use super::active_set::claim;
use super::{Event, Iterate, Observer, Settings, Solution, Solver, Start, Status, pivoting};
use crate::lcp::Lcp;
use crate::lcp::exact::{Pieces, Point};
use crate::memory::Memory;

/// Enumeration of all active sets; stops at the first solution.
#[derive(Debug, Clone, Default)]
pub struct Enumeration {
    /// The common settings; an iteration is an active set.
    pub settings: Settings,
}

impl Solver for Enumeration {
    fn name(&self) -> &'static str {
        "enumeration"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        if let Some(status) =
            pivoting::begin(lcp, &x, Memory::numbers(0), &self.settings, observer)
        {
            return Solution::new(lcp, x, status, 0);
        }
        let Some(pieces) = Pieces::of(lcp) else {
            let reason = "more than 65536 active sets";
            return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
        };
        for k in 0..pieces.count() {
            if k >= self.settings.max_iterations {
                return Solution::new(lcp, x, Status::IterationLimit, k);
            }
            let count = k + 1;
            let found = pieces.solutions(&pieces.piece(k)).first().map(rounded);
            if !found.iter().flatten().all(|x| x.is_finite()) {
                return Solution::new(lcp, x, Status::NotFinite, count); // beyond 1.8e308
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
        Solution::new(lcp, x, Status::NoSolution, pieces.count())
    }
}

fn rounded(x: &Point) -> Vec<f64> {
    x.entries().iter().map(|x| x.to_f64().value()).collect()
}
