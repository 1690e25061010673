//! Block principal pivoting: all wrong rows change sides at once, with Murty's rule as a safeguard.
//!
//! ```text
//! start    the active set of a guess, or of a few Gauss-Seidel sweeps from x = 0
//! repeat   x ← the point of the active set
//!          H ← the rows that are not satisfied
//!          |H| is the least so far:    all of H change sides; `patience` is full again
//!          otherwise, patience left:   all of H change sides; patience shrinks by 1
//!          patience used up:           the least row of H changes sides, until |H| is a new least
//! ```
//!
//! (Kostreva 1978 without, Júdice & Pires 1994 with the safeguard.) A block exchange is a Newton
//! step on the equations min(x − lo, max(x − hi, w)) = 0 and finds the active set of most contact
//! problems within ten exchanges, whatever n is; but it may cycle. Murty's rule never cycles on a
//! P-matrix (see [`Murty`](crate::Murty)), and each new least |H| is below the last, so the
//! combination always terminates there, though possibly after very many single exchanges.
//! Therefore, if A is symmetric and block exchanges do not converge, proximal steps (proximal.rs)
//! take over; they also handle a singular A_FF, as caused by redundant contacts. If A is not
//! symmetric, a singular A_FF ends the method with `Singular`.
//!
//! An exchange factorizes A_FF by the method that suits A (free_rows.rs), at most O(f³). The same
//! free rows need no new factor, and [`Warm`](crate::Warm) passes it to the next solve. Observers
//! receive `Exchange` for a block, `Pivot` for a single row and `Step` for a proximal step; the
//! solution names any fallback ([`Fallback`]). Coupled rows: see [`frozen`](crate::frozen).

use std::ops::ControlFlow;

use super::active_set::ActiveSet;
use super::free_rows::FreeRows;
use super::principal::{self, Change, Search};
use super::proximal;
use crate::{Fallback, Observer, Settings, Solution, Solver, Start, Status};
use lcplab_lcp::Lcp;

/// Block principal pivoting with Júdice and Pires' safeguard.
#[derive(Debug, Clone)]
pub struct BlockPivoting {
    /// Number of Gauss-Seidel sweeps from x = 0 that choose the first active set if there is no
    /// guess. The signs of b only show where the load enters; each sweep passes it on from contact
    /// to contact.
    pub sweeps: usize,
    /// Number of block exchanges without a new least |H| before the safeguard takes over.
    pub patience: usize,
    /// The common settings; an iteration is an exchange, of a block or of one row.
    pub settings: Settings,
}

impl Default for BlockPivoting {
    fn default() -> Self {
        BlockPivoting { sweeps: 3, patience: 10, settings: Settings::default() }
    }
}

impl BlockPivoting {
    /// Its name in the registry.
    pub const NAME: &'static str = "block-pivoting";
}

impl Solver for BlockPivoting {
    fn name(&self) -> &str {
        BlockPivoting::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        start.with_cache(|left| {
            let needs = FreeRows::memory(lcp);
            if start.x.is_none() && left.set.is_none() {
                left.set = ActiveSet::after_sweeps(lcp, self.sweeps);
            }
            principal::solve(
                lcp,
                start,
                &mut left.set,
                needs,
                &self.settings,
                observer,
                |lcp, search| self.search(lcp, search, FreeRows::kept(&mut left.equations, lcp)),
            )
        })
    }
}

impl BlockPivoting {
    fn search(&self, lcp: &Lcp, search: &mut Search<'_>, equations: &mut FreeRows) -> Solution {
        search.safeguard = Some(Fallback::LeastIndex);
        let then = if equations.are_symmetric() { Change::None } else { Change::Least };
        let rule = rule(self.patience, then);
        let status = match search.run(lcp, |set| equations.point(lcp, set), rule, None) {
            ControlFlow::Continue(()) => search.claim(lcp),
            ControlFlow::Break(status) => status,
        };
        match status {
            Status::Solved | Status::Stopped | Status::IterationLimit => {
                search.solution(lcp, status)
            }
            _ if equations.are_symmetric() => proximal::solve(lcp, search),
            _ => search.solution(lcp, status),
        }
    }
}

/// Exchanges all rows while that makes progress, and for `patience` exchanges without progress;
/// then uses `then` until there is progress again.
pub(crate) fn rule(patience: usize, then: Change) -> impl FnMut(usize) -> Change {
    let (mut least, mut left) = (usize::MAX, patience);
    move |wrong| {
        if wrong < least {
            (least, left) = (wrong, patience);
            return Change::All;
        }
        if left == 0 {
            return then;
        }
        left -= 1;
        Change::All
    }
}
