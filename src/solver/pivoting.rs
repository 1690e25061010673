//! What the pivoting methods have in common before their first pivot.

use super::{Event, Iterate, Observer, Settings, Status};
use crate::lcp::{Lcp, merit};

/// Above this many rows a dense factor or tableau would not fit.
pub(super) const MAX_ROWS: usize = 8_000;

/// The status of a method that need not, or cannot, pivot at all.
pub(super) fn at_once(
    lcp: &Lcp,
    x: &[f64],
    settings: &Settings,
    observer: &mut dyn Observer,
) -> Option<Status> {
    if lcp.len() > MAX_ROWS {
        return Some(Status::OutsideClass { reason: "more than 8000 rows" });
    }
    if observer.observe(&Iterate { iteration: 0, x, event: Event::Start }).is_break() {
        return Some(Status::Stopped);
    }
    merit::is_within(lcp, x, settings.tolerance, &mut 0).then_some(Status::Solved)
}
