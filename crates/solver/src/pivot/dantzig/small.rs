//! Problems of few rows: the method in a tableau.
//!
//! The same rows are driven, the same moves end for the same reasons; only what a pivot needs is read from a row of S
//! instead of being solved for. A tableau forgets nothing, rounding included. So a pivot must keep clear of it; where one
//! does not, as at redundant contacts, the factor of A_CC takes over from the row that is being driven, and it does so at
//! the end if x does not become exact.

use std::ops::ControlFlow;

use super::Side;
use super::basic::{Basic, TIE};
use super::polish::EXACT;
use super::run::Run;
use super::tableau::Tableau;
use crate::kernel::Width;
use crate::pivot::principal::Point;
use crate::{Move, Part, Status};
use lcplab_problem::accurate;
use lcplab_problem::merit::RowTerms;

/// dᵀA d = s is trusted above this part of (Σ √a_jj |d_j|)²: five digits of it are right then.
const TRUSTED: f64 = 1e-11;
/// Steps of refinement; all but the first with an accurate w.
const REFINEMENTS: usize = 3;

/// What the tableau adds to a run.
struct Small<'a, 'b> {
    run: &'a mut Run<'b>,
    tableau: Tableau,
    basic: Basic,
    /// C, in the order in which they came there.
    free: Vec<usize>,
    /// Rows of the tableau: of the row that is driven, and of one that enters or leaves.
    driven: Vec<f64>,
    other: Vec<f64>,
    /// So many rows have left C since the tableau was made.
    left: usize,
}

/// What ends a move.
struct Block {
    length: f64,
    row: usize,
    /// Where the row goes.
    side: Side,
}

impl Run<'_> {
    /// Drives these rows in a tableau and refines x. Goes on with the rows that are left to the factor.
    pub(super) fn solve_in_tableau(&mut self, rows: &[usize]) -> ControlFlow<Status, Vec<usize>> {
        let width = Width::widest();
        let tableau = Tableau::of(self.lcp.matrix(), width);
        let basic = Basic::of(self.lcp.len(), width);
        let (driven, other, free) = (tableau.room(), tableau.room(), Vec::new());
        let mut small = Small { run: self, tableau, basic, free, driven, other, left: 0 };
        for (k, &i) in rows.iter().enumerate() {
            if !small.drive(i)? {
                small.hand_over()?;
                return ControlFlow::Continue(rows[k..].to_vec());
            }
        }
        if let Some(point) = small.refined() {
            return ControlFlow::Break(self.claim(point));
        }
        small.hand_over()?;
        ControlFlow::Continue(Vec::new())
    }
}

impl Small<'_, '_> {
    /// Moves x_i until row i is satisfied; false if a pivot could not be trusted.
    fn drive(&mut self, i: usize) -> ControlFlow<Status, bool> {
        self.run.state.w[i] = self.run.lcp.row_w(i, &self.run.state.x);
        self.tableau.read(i, &mut self.driven);
        if self.run.is_level(i) && self.trusted(i, &self.driven).is_none() {
            return ControlFlow::Continue(false);
        }
        let pivots = self.run.pivots;
        loop {
            if let Some(side) = self.run.satisfied(i) {
                self.run.tell_satisfied(i, side, pivots);
                if side != Side::Free {
                    self.put(i, side);
                }
                return ControlFlow::Continue(true);
            }
            if self.run.pivots >= self.run.settings.max_iterations {
                return ControlFlow::Break(Status::IterationLimit);
            }
            let sign = -self.run.state.w[i].signum();
            let Some(block) = self.blocking(i, sign) else { return ControlFlow::Continue(false) };
            self.tell(i, sign, &block);
            self.advance(i, sign, block.length);
            self.exchange(i, &block);
            self.run.moved(i, block.row)?;
        }
    }

    /// The first thing that ends a move of x_i; none if nothing does or the pivot is not trusted.
    fn blocking(&mut self, i: usize, sign: f64) -> Option<Block> {
        let size = self.trusted(i, &self.driven)?;
        let zero = self.run.state.w[i].abs() / self.driven[i];
        let own = self.run.end_at_bound(i, sign);
        let others = self.basic.reach(&self.driven, sign, size);
        let least = zero.min(own.length).min(others);
        let together = least * (1.0 + TIE);
        if !least.is_finite() {
            None
        } else if zero <= together {
            Some(Block { length: zero, row: i, side: Side::Free })
        } else if own.length <= together {
            Some(Block { length: own.length, row: i, side: own.side })
        } else {
            let (row, length) = self.basic.first_within(together)?;
            self.tableau.read(row, &mut self.other);
            let side = match self.run.state.side[row] {
                Side::Free if self.basic.speed(row) > 0.0 => Side::Upper,
                Side::Free => Side::Lower,
                _ => {
                    self.trusted(row, &self.other)?;
                    Side::Free
                }
            };
            Some(Block { length, row, side })
        }
    }

    /// Σ √a_jj |d_j| for the direction of a row that is not in C, given its row of the tableau, if its s is clear of rounding.
    fn trusted(&self, i: usize, row: &[f64]) -> Option<f64> {
        let size = self.run.root[i] + self.basic.size(row);
        (row[i] > TRUSTED * size * size).then_some(size)
    }

    /// x ← x + t d, w ← w + t A d.
    fn advance(&mut self, i: usize, sign: f64, length: f64) {
        let state = &mut self.run.state;
        state.x[i] += sign * length;
        state.w[i] += sign * length * self.driven[i];
        self.basic.advance(length);
        for &j in &self.free {
            state.x[j] = self.basic.value(j);
        }
    }

    /// Puts the blocking row on its new side.
    fn exchange(&mut self, i: usize, &Block { row, side, .. }: &Block) {
        let state = &mut self.run.state;
        match side {
            Side::Lower => state.x[row] = self.run.lcp.lo()[row],
            Side::Upper => state.x[row] = self.run.lcp.hi()[row],
            _ => state.w[row] = 0.0,
        }
        let entries = if row == i { &self.driven } else { &self.other };
        if side == Side::Free {
            self.tableau.sweep(row, entries, 1.0);
            self.free.push(row);
        } else if row != i {
            self.tableau.sweep(row, entries, -1.0);
            self.free.retain(|&j| j != row);
            state.w[row] = 0.0;
            self.left += 1;
            if self.left > self.run.lcp.len() / 2 {
                self.renew();
            }
        }
        if row != i {
            self.tableau.read(i, &mut self.driven);
        }
        self.put(row, side);
    }

    /// Makes the tableau of C anew: a row that leaves takes with it what it has brought, but for rounding.
    fn renew(&mut self) {
        self.left = 0;
        self.tableau.reset(self.run.lcp.matrix());
        for &row in &self.free {
            self.tableau.read(row, &mut self.other);
            self.tableau.sweep(row, &self.other, 1.0);
        }
    }

    /// Notes that a row stands on this side from now on.
    fn put(&mut self, row: usize, side: Side) {
        let run = &mut *self.run;
        run.state.side[row] = side;
        let value = if side == Side::Free { run.state.x[row] } else { run.state.w[row] };
        let bounds = (run.lcp.lo()[row], run.lcp.hi()[row]);
        self.basic.put(row, side, value, bounds, run.root[row]);
    }

    /// x as exact as rounding allows, with x_C ← x_C + S_CC w_C; none if it does not become so.
    fn refined(&mut self) -> Option<Point> {
        let (lcp, state) = (self.run.lcp, &mut self.run.state);
        lcp.project_all(&mut state.x);
        let most = self.run.settings.tolerance.min(EXACT);
        for step in 0..=REFINEMENTS {
            let point = Point::at(lcp, state.x.clone());
            if point.largest_residual(lcp) <= most {
                return Some(point);
            }
            let mut change = vec![0.0; lcp.len()];
            for &j in &self.free {
                let w = match step {
                    0 => point.terms[j].w(),
                    _ => RowTerms::summed::<accurate::Sum>(lcp, j, &point.x).w(),
                };
                self.tableau.read(j, &mut self.other);
                for (change, s) in change.iter_mut().zip(&self.other) {
                    *change += s * w;
                }
            }
            for &j in &self.free {
                state.x[j] = (state.x[j] + change[j]).max(lcp.lo()[j]).min(lcp.hi()[j]);
            }
        }
        None
    }

    /// Leaves C and what stands at bounds to the factor, in the order in which the rows came there.
    fn hand_over(&mut self) -> ControlFlow<Status> {
        let run = &mut *self.run;
        for &row in &self.free {
            run.state.side[row] = Side::Waiting;
            run.admit(row)?;
        }
        let is_bound = |&row: &usize| matches!(run.state.side[row], Side::Lower | Side::Upper);
        let mut bound: Vec<usize> = (0..run.lcp.len()).filter(is_bound).collect();
        bound.sort_by_key(|&row| self.basic.rank(row));
        for row in bound {
            run.state.w[row] = self.basic.value(row);
            let side = std::mem::replace(&mut run.state.side[row], Side::Waiting);
            run.put(row, side);
        }
        ControlFlow::Continue(())
    }

    /// Tells an observer that asks of the move that is about to be done.
    fn tell(&mut self, i: usize, sign: f64, block: &Block) {
        if !self.run.observer.asks_for_parts() {
            return;
        }
        let (Run { lcp, state, observer, .. }, row) = (&mut *self.run, &self.driven);
        let direction: Vec<f64> = self.free.iter().map(|&j| -row[j]).collect();
        let mut delta_w = vec![0.0; lcp.len()];
        for j in 0..lcp.len() {
            if matches!(state.side[j], Side::Lower | Side::Upper) {
                (state.w[j], delta_w[j]) = (self.basic.value(j), sign * self.basic.speed(j));
            }
        }
        observer.part(&Part::Move(Move {
            lcp,
            driven: i,
            sign,
            x: &state.x,
            w: &state.w,
            side: &state.side,
            free: &self.free,
            direction: &direction,
            schur: row[i],
            delta_w: &delta_w,
            length: block.length,
            blocking: block.row,
            to: block.side,
        }));
    }
}
