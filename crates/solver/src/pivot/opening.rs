//! Common checks of the pivoting methods before their first pivot.

use super::principal::Point;
use crate::{Event, Iterate, Observer, Settings, Status};
use lcplab_lcp::Lcp;
use lcplab_lcp::memory::Memory;

/// Maximum number of rows; with more, a dense factor or tableau takes too long.
const MAX_ROWS: usize = 8_000;

/// The status of a method that need not or cannot pivot at all, or would need too much memory.
pub(crate) fn at_once(
    lcp: &Lcp,
    x: &[f64],
    needs: Memory,
    settings: &Settings,
    observer: &mut dyn Observer,
) -> Option<Status> {
    let is_solved = || Point::at(lcp, x.to_vec()).is_solution(lcp, settings.tolerance);
    begin(lcp, x, needs, settings, observer).or_else(|| is_solved().then_some(Status::Solved))
}

/// Reports the start to the observer; returns the status of a method that cannot begin.
pub(crate) fn begin(
    lcp: &Lcp,
    x: &[f64],
    needs: Memory,
    settings: &Settings,
    observer: &mut dyn Observer,
) -> Option<Status> {
    if lcp.len() > MAX_ROWS {
        return Some(Status::OutsideClass { reason: "more than 8000 rows" });
    }
    if let Some(status) = settings.refusal(needs) {
        return Some(status);
    }
    let start = Iterate { iteration: 0, x, event: Event::Start };
    observer.observe(&start).is_break().then_some(Status::Stopped)
}
