//! The loop of the principal pivoting methods: from one active set to the next.

use super::active_set::{ActiveSet, Side, claim};
use super::{
    Event, Fallback, Iterate, Observer, Settings, Solution, Start, Status, frozen, pivoting,
};
use crate::lcp::Lcp;
use crate::memory::Memory;

/// Which of the rows that are not satisfied change sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Change {
    /// The one of least index.
    Least,
    /// All of them.
    All,
}

/// Changes sides until all rows are satisfied. `rule` is told how many are not, and chooses; if it
/// takes to the least row, the solution says so by `safeguard`.
pub(super) fn solve<R: FnMut(usize) -> Change>(
    lcp: &Lcp,
    start: &Start<'_>,
    settings: &Settings,
    observer: &mut dyn Observer,
    safeguard: Option<Fallback>,
    rule: impl Fn() -> R,
) -> Solution {
    let x = start.point(lcp);
    if let Some(status) = pivoting::at_once(lcp, &x, Memory::square(lcp.len()), settings, observer)
    {
        return Solution::new(lcp, x, status, 0);
    }
    let is_pinned = |i: usize| lcp.lo()[i] == lcp.hi()[i];
    if (0..lcp.len()).any(|i| !is_pinned(i) && !(lcp.matrix().diagonal(i) > 0.0)) {
        let reason = "A is no P-matrix: a diagonal entry is not positive";
        return Solution::new(lcp, x, Status::OutsideClass { reason }, 0);
    }
    frozen::solve(lcp, x, settings, |lcp, x, count| {
        let set = ActiveSet::initial(lcp, start, &x);
        let (mut rule, mut fallback) = (rule(), None);
        let watched = |wrong| {
            let change = rule(wrong);
            fallback = if change == Change::Least { safeguard } else { fallback };
            change
        };
        let solution = exchange(lcp, set, x, count, settings, observer, watched);
        solution.with_fallback(fallback)
    })
}

fn exchange(
    lcp: &Lcp,
    mut set: ActiveSet,
    mut x: Vec<f64>,
    mut count: usize,
    settings: &Settings,
    observer: &mut dyn Observer,
    mut rule: impl FnMut(usize) -> Change,
) -> Solution {
    let mut last = None;
    loop {
        match set.point(lcp) {
            Ok(point) if point.iter().all(|x| x.is_finite()) => x = point,
            Ok(_) => return Solution::new(lcp, x, Status::NotFinite, count),
            Err(row) => return Solution::new(lcp, x, Status::Singular { row }, count),
        }
        if let Some(event) = last
            && observer.observe(&Iterate { iteration: count, x: &x, event }).is_break()
        {
            return Solution::new(lcp, x, Status::Stopped, count);
        }
        let wrong: Vec<(usize, Side)> =
            (0..lcp.len()).filter_map(|i| Some((i, set.better_side(lcp, i, &x)?))).collect();
        let Some(&(least, _)) = wrong.first() else {
            let status = claim(lcp, &x, settings);
            return Solution::new(lcp, x, status, count);
        };
        if count >= settings.max_iterations {
            return Solution::new(lcp, x, Status::IterationLimit, count);
        }
        let (rows, event) = match rule(wrong.len()) {
            Change::Least => (1, Event::Pivot { driven: least, blocking: least }),
            Change::All => (wrong.len(), Event::Exchange { rows: wrong.len() }),
        };
        for &(row, side) in &wrong[..rows] {
            set.0[row] = side;
        }
        (count, last) = (count + 1, Some(event));
    }
}
