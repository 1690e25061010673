//! Murty's least-index principal pivoting: the simplest method that always terminates for a
//! P-matrix.
//!
//! ```text
//! repeat   x ← the point of the active set        (A_FF x_F = −(b_F + A_FB x_B))
//!          i ← the least row that is not satisfied
//!          move row i to its other side:  at a bound with a wrong sign of w → free,
//!                                         free and outside a bound           → at that bound
//! ```
//!
//! (Murty 1974; a Bard-type method with the least index.) For a P-matrix, whose principal minors
//! are all positive, no active set occurs twice. The proof is by induction on n: while row n keeps
//! its side, the other rows are a smaller problem of the same kind, which terminates. Along the
//! solutions of that problem, w_n grows with x_n, so row n can only go once from one bound to free
//! to the other. Hence there are at most 2ⁿ − 1 pivots for bounds 0 and ∞ and 3ⁿ − 1 in boxes.
//! Murty's own matrix needs all of them; random problems need about n. The start may be any active
//! set.
//!
//! Each pivot factorizes A_FF from scratch, O(f³) for f free rows, so rounding errors do not
//! accumulate. If A_FF is singular, and A therefore not a P-matrix, the method ends with
//! `Singular`; on other matrices it may cycle until the iteration limit. Coupled rows: see
//! [`frozen`](crate::frozen).

use std::ops::ControlFlow;

use super::active_set::ActiveSet;
use super::opening;
use super::principal::{self, Change, Point};
use crate::{Observer, Settings, Solution, Solver, Start, Status};
use lcplab_lcp::Lcp;

/// Murty's least-index principal pivoting.
#[derive(Debug, Clone, Default)]
pub struct Murty {
    /// The common settings; an iteration is a pivot.
    pub settings: Settings,
}

impl Murty {
    /// Its name in the registry.
    pub const NAME: &'static str = "murty";
}

impl Solver for Murty {
    fn name(&self) -> &str {
        Murty::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        start.with_cache(|left| {
            let needs = opening::dense_memory(lcp);
            principal::solve(
                lcp,
                start,
                &mut left.set,
                needs,
                &self.settings,
                observer,
                |lcp, search| {
                    let status =
                        match search.run(lcp, |set| point(lcp, set), |_| Change::Least, None) {
                            ControlFlow::Continue(()) => search.claim(lcp),
                            ControlFlow::Break(status) => status,
                        };
                    search.solution(lcp, status)
                },
            )
        })
    }
}

/// The point of an active set, with a fresh factorization of A_FF.
fn point(lcp: &Lcp, set: &ActiveSet) -> Result<Point, Status> {
    let x = set.point(lcp).map_err(|row| Status::Singular { row })?;
    if x.iter().all(|x| x.is_finite()) { Ok(Point::at(lcp, x)) } else { Err(Status::NotFinite) }
}
