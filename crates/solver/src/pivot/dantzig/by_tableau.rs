//! The method in a tableau.
//!
//! The same rows are driven, the same moves end for the same reasons; only what a pivot needs is read from a row of S
//! instead of being solved for. A tableau forgets nothing, rounding included. So a pivot must keep clear of it, and a row
//! that depends on C must have nothing but rounding left (redundant.rs); where neither is so the factor of A_CC takes
//! over from the row that is being driven, and it does so at the end if x does not become exact.

use std::ops::ControlFlow;

use super::blocking::End;
use super::run::{Reached, Run};
use super::{Side, is_unbounded};
use crate::kernel::rank_one::{Block, get};
use crate::kernel::tableau::Tableau;
use crate::pivot::basic::{Basic, REDUNDANT, TIE, TRUSTED};
use crate::pivot::refinement::refined;
use crate::{Move, Part, Status};

/// What the tableau adds to a run.
pub(super) struct ByTableau<'a, 'b> {
    pub(super) run: &'a mut Run<'b>,
    pub(super) tableau: Tableau,
    pub(super) basic: Basic,
    /// C, in the order in which they came there.
    pub(super) free: Vec<usize>,
    /// Rows of the tableau: of the row that is driven, of one that enters or leaves, and of one that is looked at.
    pub(super) driven: Vec<Block>,
    pub(super) other: Vec<Block>,
    pub(super) third: Option<Vec<Block>>,
    /// So many rows have left C since the tableau was made.
    left: usize,
    /// Rows that have let x move off a bound while the driven one is driven.
    pub(super) served: Vec<usize>,
    /// Whether a pivot was neither clear of rounding nor rounding: the factor must take over.
    pub(super) is_doubtful: bool,
}

/// What s = dᵀA d of a direction says.
pub(super) enum Schur {
    /// It is clear of rounding, for a direction of this Σ √a_jj |d_j|.
    Positive(f64),
    /// It is zero: the row depends on C.
    Zero(f64),
    /// It may be either.
    Doubtful,
}

impl Run<'_> {
    /// Drives these rows in a tableau and refines x. Leaves the rest to the factor where a pivot cannot be trusted.
    pub(super) fn solve_in_tableau(&mut self, rows: &[usize]) -> ControlFlow<Status, Reached> {
        let n = self.lcp.len();
        let (tableau, basic) = (Tableau::of(self.lcp.matrix()), Basic::of(n));
        let [driven, other] = [tableau.room(), tableau.room()];
        let (free, served) = (Vec::with_capacity(n), Vec::new());
        let mut by_tableau = ByTableau {
            run: self,
            tableau,
            basic,
            free,
            driven,
            other,
            third: None,
            left: 0,
            served,
            is_doubtful: false,
        };
        by_tableau.solve(rows)
    }
}

impl ByTableau<'_, '_> {
    fn solve(&mut self, rows: &[usize]) -> ControlFlow<Status, Reached> {
        for (k, &i) in rows.iter().enumerate() {
            self.drive(i)?;
            if self.is_doubtful {
                return self.hand_over(&rows[k..]);
            }
        }
        let x = self.run.state.x.clone();
        let Run { lcp, state, settings, .. } = &*self.run;
        let is_idle = |i: usize| state.side[i] == Side::Idle && is_unbounded(lcp, i);
        match refined(lcp, &self.tableau, &self.free, x, settings.tolerance, is_idle) {
            Ok(point) => ControlFlow::Continue(Reached::Point(point)),
            Err(_) => self.hand_over(&[]),
        }
    }

    /// Moves x_i until row i is satisfied, or a pivot is doubtful.
    fn drive(&mut self, i: usize) -> ControlFlow<Status> {
        self.run.state.w[i] = self.run.lcp.row_w(i, &self.run.state.x);
        self.tableau.read(i, &mut self.driven);
        let (pivots, limit) = (self.run.pivots, self.run.settings.max_iterations);
        if self.run.is_level(i) && pivots < limit && self.settle_redundant(i) {
            return self.run.moved(i, i);
        }
        self.served.clear();
        loop {
            if let Some(side) = self.run.satisfied(i) {
                self.run.tell_satisfied(i, side, pivots);
                if matches!(side, Side::Lower | Side::Upper) {
                    self.put(i, side);
                }
                return ControlFlow::Continue(());
            }
            if self.run.pivots >= limit {
                return ControlFlow::Break(Status::IterationLimit);
            }
            let end = match self.schur(i, &self.driven) {
                Schur::Positive(size) => self.move_clear(i, size),
                Schur::Zero(_) => self.move_along_null(i)?,
                Schur::Doubtful => {
                    self.is_doubtful = true;
                    None
                }
            };
            let Some(End { row, side, .. }) = end else {
                return ControlFlow::Continue(());
            };
            self.exchange(i, row, side);
            self.run.moved(i, row)?;
            if self.is_doubtful {
                return ControlFlow::Continue(());
            }
        }
    }

    /// Moves x_i, whose s is positive, until something ends the move; nothing is moved if that is doubtful.
    fn move_clear(&mut self, i: usize, size: f64) -> Option<End> {
        let sign = -self.run.state.w[i].signum();
        let end = self.blocking(i, sign, size);
        self.is_doubtful |= end.is_none();
        let end = end?;
        if self.run.observer.asks_for_parts() {
            self.tell(i, sign, &end);
        }
        self.advance(i, sign, end.length);
        Some(end)
    }

    /// The first thing that ends a move of x_i; none if nothing does or the pivot is not trusted.
    fn blocking(&mut self, i: usize, sign: f64, size: f64) -> Option<End> {
        let zero = self.run.state.w[i].abs() / get(&self.driven, i);
        let own = self.run.end_at_bound(i, sign);
        let most = zero.min(own.length);
        let mut others = self.basic.reach(&self.driven, sign, size, most);
        loop {
            let least = most.min(others);
            let together = least * (1.0 + TIE);
            if !least.is_finite() {
                return None;
            }
            if zero <= together {
                return Some(End { length: zero, row: i, side: Side::Free });
            }
            if own.length <= together {
                return Some(own);
            }
            let (row, length) = self.basic.first_within(together)?;
            if !self.basic.speed(row).is_finite() {
                return None; // numbers have overflowed
            }
            self.tableau.read(row, &mut self.other);
            let end = |side| Some(End { length, row, side });
            match self.run.state.side[row] {
                Side::Free if self.basic.speed(row) > 0.0 => return end(Side::Upper),
                Side::Free => return end(Side::Lower),
                _ => match self.schur(row, &self.other) {
                    Schur::Positive(_) => return end(Side::Free),
                    Schur::Zero(own) if self.basic.is_rounding(row, size * own) => {
                        others = self.basic.hold(row);
                    }
                    Schur::Zero(_) => return end(Side::Idle),
                    Schur::Doubtful => return None,
                },
            }
        }
    }

    /// What s of row i, which is not in C, says, given its row of the tableau.
    pub(super) fn schur(&self, i: usize, row: &[Block]) -> Schur {
        let size = self.run.root[i] + self.basic.size(row);
        let s = get(row, i);
        if s > TRUSTED * size * size {
            Schur::Positive(size)
        } else if s.abs() <= REDUNDANT * size * size {
            Schur::Zero(size)
        } else {
            Schur::Doubtful
        }
    }

    /// x ← x + t d, w ← w + t A d.
    fn advance(&mut self, i: usize, sign: f64, length: f64) {
        let state = &mut self.run.state;
        state.x[i] += sign * length;
        state.w[i] += sign * length * get(&self.driven, i);
        self.basic.advance(length);
        for &j in &self.free {
            state.x[j] = self.basic.value(j);
        }
    }

    /// Puts the row that has ended the move of x_i on its new side.
    fn exchange(&mut self, i: usize, row: usize, side: Side) {
        let is_leaving = self.run.state.side[row] == Side::Free;
        if is_leaving && self.move_off_bound(row) {
            return;
        }
        let state = &mut self.run.state;
        match side {
            Side::Lower => state.x[row] = self.run.lcp.lo()[row],
            Side::Upper => state.x[row] = self.run.lcp.hi()[row],
            _ => state.w[row] = 0.0,
        }
        match side {
            Side::Free => self.enter(i, row),
            _ if is_leaving => self.leave(i, row, side),
            _ => self.put(row, side),
        }
    }

    /// Row `row`, the driven one, i, or that in `other`, enters C.
    pub(super) fn enter(&mut self, i: usize, row: usize) {
        self.free.push(row);
        match row == i {
            true => self.tableau.pivot(row, &self.driven, 1.0, None),
            false => self.tableau.pivot(row, &self.other, 1.0, Some((i, &mut self.driven))),
        }
        self.put(row, Side::Free);
    }

    /// Row `row`, that in `other`, leaves C for this side; a row that has depended on it takes its place.
    fn leave(&mut self, i: usize, row: usize, side: Side) {
        let idle = self.dependents(row, |own, j| own.run.state.side[j] == Side::Idle);
        self.free.retain(|&j| j != row);
        self.run.state.w[row] = 0.0;
        self.tableau.pivot(row, &self.other, -1.0, Some((i, &mut self.driven)));
        self.put(row, side);
        self.left += 1;
        if self.left > self.run.lcp.len() / 2 {
            self.renew();
            self.tableau.read(i, &mut self.driven);
        }
        self.admit_idle(i, &idle);
    }

    /// Makes the tableau of C anew: a row that leaves takes with it what it has brought, but for rounding.
    fn renew(&mut self) {
        self.left = 0;
        self.tableau.reset(self.run.lcp.matrix());
        for &row in &self.free {
            self.tableau.read(row, &mut self.other);
            self.tableau.pivot(row, &self.other, 1.0, None);
        }
    }

    /// Notes that a row stands on this side from now on.
    pub(super) fn put(&mut self, row: usize, side: Side) {
        let run = &mut *self.run;
        run.state.side[row] = side;
        let value = if side == Side::Free { run.state.x[row] } else { run.state.w[row] };
        let bounds = (run.lcp.lo()[row], run.lcp.hi()[row]);
        self.basic.put(row, side, value, bounds, run.root[row]);
    }

    /// Leaves C, what stands at bounds and these rows to the factor; idle ones are driven again.
    fn hand_over(&mut self, rows: &[usize]) -> ControlFlow<Status, Reached> {
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
        let is_idle = |&row: &usize| run.state.side[row] == Side::Idle;
        let idle: Vec<usize> = (0..run.lcp.len()).filter(is_idle).collect();
        idle.iter().for_each(|&row| run.state.side[row] = Side::Waiting);
        ControlFlow::Continue(Reached::Rows(idle.iter().chain(rows).copied().collect()))
    }

    /// Tells an observer of the move of x_i that is about to be done.
    fn tell(&mut self, i: usize, sign: f64, end: &End) {
        let direction: Vec<f64> = self.free.iter().map(|&j| -get(&self.driven, j)).collect();
        let mut delta_w = vec![0.0; self.run.lcp.len()];
        let state = &mut self.run.state;
        for j in 0..delta_w.len() {
            if matches!(state.side[j], Side::Lower | Side::Upper) {
                (state.w[j], delta_w[j]) = (self.basic.value(j), sign * self.basic.speed(j));
            }
        }
        self.tell_move(i, sign, end, &direction, &delta_w, get(&self.driven, i));
    }

    /// The same for a move along this direction, with these Δw and this s.
    pub(super) fn tell_move(
        &mut self,
        i: usize,
        sign: f64,
        end: &End,
        direction: &[f64],
        delta_w: &[f64],
        schur: f64,
    ) {
        let Run { lcp, state, observer, .. } = &mut *self.run;
        observer.part(&Part::Move(Move {
            lcp,
            driven: i,
            sign,
            x: &state.x,
            w: &state.w,
            side: &state.side,
            free: &self.free,
            direction,
            schur,
            delta_w,
            length: end.length,
            blocking: end.row,
            to: end.side,
        }));
    }
}
