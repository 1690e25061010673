//! Centering: at redundant contacts, x moves to the middle of the solution set.
//!
//! If row j depends on C, A d = 0 along its direction d, and x can move along d without changing
//! any w. A vertex of the solution set, for example three loaded corners of a box on four, becomes
//! infeasible as soon as the load moves slightly, and each corner that loses contact makes its
//! neighbor take the load: two pivots. In the middle all four carry load, and C does not change.
//! Therefore x moves to the middle of the feasible range along d, and row j becomes dependent,
//!
//! - if a row is processed for the first time with its x at a bound, w = 0, and depends on C;
//! - if an x of C reaches a bound and d leads away from it: row j is dependent, or at a bound with
//!   w = 0.
//!
//! *Correct.* Only x_j and x_C move. Their w are zero and A d = 0: neither w nor ½ xᵀA x + bᵀx
//! changes, no bound is crossed, and the driven row is unaffected. The move only selects among
//! solutions.
//!
//! *Finite.* A row is used only once while another is driven; after that, the x of C leaves C as in
//! the plain method. A drive therefore has at most n of these moves, and after the last one the
//! termination proof of the plain method applies.

use std::ops::ControlFlow;

use super::Side;
use super::blocking::Block;
use super::direction::Direction;
use super::run::Run;
use crate::tolerances::RELATIVE_ZERO;
use crate::{Centering, Status, StepDetail};

impl Run<'_> {
    /// Makes row i dependent, in the middle, if it is at a bound, depends on C, and its w is zero;
    /// returns whether it did.
    pub(super) fn is_made_dependent(&mut self, i: usize) -> bool {
        if !self.is_at_rest(i) {
            return false;
        }
        let ControlFlow::Continue(d) = self.direction(i) else { return false };
        let is_dependent = d.schur == 0.0 && self.slope(i, &d) == 0.0 && self.center(i, &d, None);
        self.scratch.directions.push(d);
        is_dependent
    }

    /// Whether row i has not been driven yet and is at a bound with w = 0.
    pub(super) fn is_at_rest(&self, i: usize) -> bool {
        let (lo, hi, x) = (self.lcp.lo()[i], self.lcp.hi()[i], self.state.x[i]);
        self.state.side[i] == Side::Unprocessed && !(lo < x && x < hi) && self.is_level(i)
    }

    /// Ends a move of x_i: either x moves off the bound that the blocking row of C reached, to the
    /// middle of the range that a dependent row leaves, or that row leaves C. `served` are the rows
    /// already used in this way.
    pub(super) fn center_or_leave(
        &mut self,
        i: usize,
        block: Block,
        direction: Box<Direction>,
        served: &mut Vec<usize>,
    ) -> ControlFlow<Status> {
        if !self.move_off_bound(block.row, served) {
            return self.exchange(i, block, direction);
        }
        self.scratch.directions.push(direction);
        ControlFlow::Continue(())
    }

    /// Moves x off the bound that `row` of C has reached; returns whether that was possible.
    fn move_off_bound(&mut self, row: usize, served: &mut Vec<usize>) -> bool {
        if self.state.side[row] != Side::Free {
            return false;
        }
        let is_spare = |&j: &usize| match self.state.side[j] {
            Side::Dependent => true,
            Side::Lower | Side::Upper => self.may_leave(j) && self.state.w[j] == 0.0,
            Side::Unprocessed | Side::Free => false,
        };
        let rows =
            (0..self.state.x.len()).filter(is_spare).filter(|j| !served.contains(j)).collect();
        for j in self.dependents(row, rows) {
            served.push(j);
            let ControlFlow::Continue(d) = self.direction(j) else { continue };
            let leads_away = d.schur == 0.0 && d.d[row] != 0.0;
            let moved = leads_away && self.center(j, &d, Some(row));
            self.scratch.directions.push(d);
            if moved {
                return true;
            }
        }
        false
    }

    /// Whether the recomputed w_i is no more than rounding, as [`Run::slope`] decides.
    pub(super) fn is_level(&self, i: usize) -> bool {
        let (w, b) = (self.state.w[i], self.lcp.b()[i]);
        w.abs() <= RELATIVE_ZERO * ((w - b).abs() + b.abs())
    }

    /// Moves x to the middle of its range along d, A d = 0: x_j by 1, x of the free rows by d. Row
    /// j is then dependent. False if the range is empty or unbounded.
    fn center(&mut self, j: usize, d: &Direction, keeps: Option<usize>) -> bool {
        let free = &self.basis.free;
        let reach = |sign: f64| {
            let of_free = free.iter().map(|&k| self.length_to_bound(k, sign * d.d[k]));
            of_free.fold(self.length_to_bound(j, sign), f64::min)
        };
        let (forward, back) = (reach(1.0), reach(-1.0));
        let length = forward + back;
        if !(length.is_finite() && length > 0.0) {
            return false;
        }
        if self.observer.wants_details() {
            let x = &self.state.x;
            let direction = &d.free[..free.len()];
            let own = Centering { row: j, keeps, x, free, direction, forward, back };
            self.observer.part(&StepDetail::Centering(own));
        }
        let t = (forward - back) / 2.0;
        self.state.x[j] += t;
        for &k in &self.basis.free {
            self.state.x[k] += t * d.d[k];
        }
        self.state.w[j] = 0.0;
        self.put(j, Side::Dependent);
        true
    }
}
