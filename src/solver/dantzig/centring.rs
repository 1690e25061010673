//! What redundant contacts leave open: x moves to the middle of it.
//!
//! Where row j depends on C, A d = 0 along its direction d, and x may move along d without any w
//! noticing. A vertex of what is possible, three corners of a box that stands on four, is left as soon as
//! the load moves a little, and each corner that lets go makes its neighbour take hold: two pivots. From the
//! middle all four carry, and C stays as it is.
//!
//! So where an x of C meets a bound, and a row depends on C through it that is idle or at a bound with
//! w = 0, x first moves to the middle of the direction of that row, which is idle then. Once for each row
//! while another is driven: where the middle is on the way to a bound itself, the x of C leaves.

use std::ops::ControlFlow;

use super::direction::{Direction, RELATIVE_ZERO};
use super::{Run, Side};
use crate::solver::Status;

impl Run<'_> {
    /// Makes row i idle, in the middle, if it depends on C and its w is zero.
    pub(super) fn rests(&mut self, i: usize) -> ControlFlow<Status, bool> {
        if self.side[i] != Side::Waiting || !self.is_level(i) {
            return ControlFlow::Continue(false);
        }
        let d = self.direction(i)?;
        let rests = d.schur == 0.0 && self.slope(i, &d) == 0.0 && self.centre(i, &d);
        self.spare.push(d);
        ControlFlow::Continue(rests)
    }

    /// Moves x off the bound that `row` of C has met; `centred` are the rows that have served already.
    pub(super) fn gives_way(
        &mut self,
        row: usize,
        centred: &mut Vec<usize>,
    ) -> ControlFlow<Status, bool> {
        let Some(k) = self.free.iter().position(|&j| j == row) else {
            return ControlFlow::Continue(false);
        };
        let is_spare = |&j: &usize| match self.side[j] {
            Side::Idle => true,
            Side::Lower | Side::Upper => self.away[j] != 0.0 && self.w[j] == 0.0,
            Side::Waiting | Side::Free => false,
        };
        let rows = (0..self.x.len()).filter(is_spare).filter(|j| !centred.contains(j)).collect();
        for j in self.dependents(k, rows) {
            centred.push(j);
            let d = self.direction(j)?;
            let moved = d.schur == 0.0 && self.centre(j, &d) && self.is_inside(row);
            self.spare.push(d);
            if moved {
                return ControlFlow::Continue(true);
            }
        }
        ControlFlow::Continue(false)
    }

    /// Whether w_i, just summed, is no more than rounding; [`Run::slope`] decides.
    fn is_level(&self, i: usize) -> bool {
        let (w, b) = (self.w[i], self.lcp.b()[i]);
        w.abs() <= RELATIVE_ZERO * ((w - b).abs() + b.abs())
    }

    fn is_inside(&self, row: usize) -> bool {
        self.lcp.lo()[row] < self.x[row] && self.x[row] < self.lcp.hi()[row]
    }

    /// Moves x to the middle of where it may go along d, A d = 0, and makes row j idle; false if there is no
    /// way, or no end of it.
    fn centre(&mut self, j: usize, d: &Direction) -> bool {
        let reach = |sign: f64| {
            let free = self.free.iter().zip(&d.free);
            let of_free = free.map(|(&k, d)| self.distance_to_bound(k, sign * d).0.max(0.0));
            of_free.fold(self.distance_to_bound(j, sign).0.max(0.0), f64::min)
        };
        let (forward, back) = (reach(1.0), reach(-1.0));
        let length = forward + back;
        if !(length.is_finite() && length > 0.0) {
            return false;
        }
        let t = (forward - back) / 2.0;
        self.x[j] += t;
        for (&k, d) in self.free.iter().zip(&d.free) {
            self.x[k] += t * d;
        }
        self.w[j] = 0.0;
        self.put(j, Side::Idle);
        true
    }
}
