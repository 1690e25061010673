//! Common checks of the pivoting methods before their first pivot.

use super::principal::Point;
use crate::{Event, Iterate, Observer, Settings, Status};
use lcplab_lcp::Lcp;
use lcplab_lcp::memory::Memory;

/// Maximum number of rows; with more, a dense factor or tableau takes too long.
const MAX_ROWS: usize = 8_000;
/// The status of a method that does not begin because of them.
pub(crate) const TOO_LARGE: Status = Status::OutsideClass { reason: "more than 8000 rows" };

/// The status of a method that need not or cannot pivot at all, or would need too much memory.
pub(crate) fn at_once(
    lcp: &Lcp,
    x: &[f64],
    needs: Memory,
    settings: &Settings,
    observer: &mut dyn Observer,
) -> Option<Status> {
    begin(lcp, x, needs, settings, observer).or_else(|| is_solved(lcp, x, settings))
}

/// Reports the start to the observer; returns the status of a method that cannot begin.
pub(crate) fn begin(
    lcp: &Lcp,
    x: &[f64],
    needs: Memory,
    settings: &Settings,
    observer: &mut dyn Observer,
) -> Option<Status> {
    let too_large = (lcp.len() > MAX_ROWS).then_some(TOO_LARGE);
    too_large.or_else(|| start(x, needs, settings, observer))
}

/// The memory of a dense factor of all rows; `None` if it would take too long.
pub(crate) fn dense_memory(lcp: &Lcp) -> Option<Memory> {
    (lcp.len() <= MAX_ROWS).then(|| Memory::square(lcp.len()))
}

/// As [`begin`] for a problem of any size.
pub(crate) fn start(
    x: &[f64],
    needs: Memory,
    settings: &Settings,
    observer: &mut dyn Observer,
) -> Option<Status> {
    if let Some(status) = settings.refusal(needs) {
        return Some(status);
    }
    let start = Iterate { iteration: 0, x, event: Event::Start };
    observer.observe(&start).is_break().then_some(Status::Stopped)
}

/// `Solved` if x is a solution.
pub(crate) fn is_solved(lcp: &Lcp, x: &[f64], settings: &Settings) -> Option<Status> {
    Point::at(lcp, x.to_vec()).is_solution(lcp, settings.tolerance).then_some(Status::Solved)
}
