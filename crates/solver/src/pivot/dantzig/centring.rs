//! What redundant contacts leave open: x moves to the middle of it.
//!
//! Where row j depends on C, A d = 0 along its direction d, and x may move along d without any w
//! noticing. A vertex of what is possible, three corners of a box that stands on four, is left as
//! soon as the load moves a little, and each corner that lets go makes its neighbour take hold: two
//! pivots. From the middle all four carry, and C stays as it is. So x moves to the middle of what d
//! leaves open, and row j is idle then,
//!
//! - where a row is looked at for the first time and rests: its x is at a bound, its w zero, and it
//!   depends on C;
//! - where an x of C meets a bound, and d leads away from it: row j is idle, or at a bound with
//!   w = 0.
//!
//! *Right.* Only x_j and x_C move. Their w are zero and A d = 0: neither w nor ½ xᵀA x + bᵀx
//! changes, no bound is crossed, and the driven row is as far as it was. What is not unique is
//! chosen, nothing else.
//!
//! *Finite.* A row serves once while another is driven; then the x of C leaves as it does without
//! this file. So a drive has at most n of these moves, and after the last of them the plain
//! method's argument holds.

use std::ops::ControlFlow;

use super::Side;
use super::blocking::Block;
use super::direction::{Direction, RELATIVE_ZERO};
use super::run::Run;
use crate::{Centring, Part, Status};

impl Run<'_> {
    /// Makes row i idle, in the middle, if it is at a bound, depends on C, and its w is zero;
    /// returns whether it did.
    pub(super) fn settle_idle(&mut self, i: usize) -> bool {
        if !self.is_at_rest(i) {
            return false;
        }
        let ControlFlow::Continue(d) = self.direction(i) else { return false };
        let is_idle = d.schur == 0.0 && self.slope(i, &d) == 0.0 && self.centre(i, &d, None);
        self.scratch.directions.push(d);
        is_idle
    }

    /// Whether row i has not been driven yet and stands at a bound with w = 0.
    pub(super) fn is_at_rest(&self, i: usize) -> bool {
        let (lo, hi, x) = (self.lcp.lo()[i], self.lcp.hi()[i], self.state.x[i]);
        self.state.side[i] == Side::Waiting && !(lo < x && x < hi) && self.is_level(i)
    }

    /// Ends a move of x_i: x goes off the bound that the blocking row of C has met, to the middle
    /// of what an idle row leaves open, or else that row leaves C. `served` are the rows that have
    /// been used so already.
    pub(super) fn centre_or_leave(
        &mut self,
        i: usize,
        block: Block,
        direction: Direction,
        served: &mut Vec<usize>,
    ) -> ControlFlow<Status> {
        if !self.move_off_bound(block.row, served) {
            return self.exchange(i, block, direction);
        }
        self.scratch.directions.push(direction);
        ControlFlow::Continue(())
    }

    /// Moves x off the bound that `row` of C has met; returns whether it could.
    fn move_off_bound(&mut self, row: usize, served: &mut Vec<usize>) -> bool {
        let Some(k) = self.basis.free.iter().position(|&j| j == row) else { return false };
        let is_spare = |&j: &usize| match self.state.side[j] {
            Side::Idle => true,
            Side::Lower | Side::Upper => self.may_leave(j) && self.state.w[j] == 0.0,
            Side::Waiting | Side::Free => false,
        };
        let rows =
            (0..self.state.x.len()).filter(is_spare).filter(|j| !served.contains(j)).collect();
        for j in self.dependents(k, rows) {
            served.push(j);
            let ControlFlow::Continue(d) = self.direction(j) else { continue };
            let leads_away = d.schur == 0.0 && d.free[k] != 0.0;
            let moved = leads_away && self.centre(j, &d, Some(row));
            self.scratch.directions.push(d);
            if moved {
                return true;
            }
        }
        false
    }

    /// Whether w_i, just summed, is no more than rounding; [`Run::slope`] decides.
    pub(super) fn is_level(&self, i: usize) -> bool {
        let (w, b) = (self.state.w[i], self.lcp.b()[i]);
        w.abs() <= RELATIVE_ZERO * ((w - b).abs() + b.abs())
    }

    /// Moves x to the middle of where it may go along d, A d = 0: x_j by 1, x of the free rows by
    /// d. Then row j is idle. False if there is no way, or no end of it.
    fn centre(&mut self, j: usize, d: &Direction, keeps: Option<usize>) -> bool {
        let free = &self.basis.free;
        let reach = |sign: f64| {
            let of_free = free.iter().zip(&d.free);
            let of_free = of_free.map(|(&k, d)| self.end_at_bound(k, sign * d).length);
            of_free.fold(self.end_at_bound(j, sign).length, f64::min)
        };
        let (forward, back) = (reach(1.0), reach(-1.0));
        let length = forward + back;
        if !(length.is_finite() && length > 0.0) {
            return false;
        }
        if self.observer.asks_for_parts() {
            let x = &self.state.x;
            let own = Centring { row: j, keeps, x, free, direction: &d.free, forward, back };
            self.observer.part(&Part::Centring(own));
        }
        let t = (forward - back) / 2.0;
        self.state.x[j] += t;
        for (&k, d) in self.basis.free.iter().zip(&d.free) {
            self.state.x[k] += t * d;
        }
        self.state.w[j] = 0.0;
        self.put(j, Side::Idle);
        true
    }
}
