//! Rows that depend on C, in the tableau.
//!
//! Where row j depends on C its s is zero but for rounding, A d = 0 along its direction d, and w_j is dᵀw. What is done
//! with it is what the factor does (run.rs, centring.rs); the directions are read from the tableau.

use std::ops::ControlFlow;

use super::Side;
use super::blocking::End;
use super::by_tableau::{ByTableau, Schur};
use super::direction::ROUNDING;
use crate::Status;
use crate::kernel::rank_one::{Block, get};

impl ByTableau<'_, '_> {
    /// Makes the driven row i idle, in the middle of what it leaves open, if it is at rest and depends on C; returns
    /// whether it did.
    pub(super) fn settle_redundant(&mut self, i: usize) -> bool {
        match self.schur(i, &self.driven) {
            Schur::Positive(_) => false,
            Schur::Zero(_) if !self.run.is_at_rest(i) => false,
            Schur::Zero(_) => {
                let d = self.null_direction(i, &self.driven);
                self.run.slope(i, &self.free, &d) == 0.0 && self.centre(i, &d, None)
            }
            Schur::Doubtful => {
                self.is_doubtful = true;
                false
            }
        }
    }

    /// Moves x along the direction d of the driven row i, A d = 0, until a bound stops it. If dᵀw is zero, or what row i
    /// asks for, there is nothing to do and nothing is returned.
    pub(super) fn move_along_null(&mut self, i: usize) -> ControlFlow<Status, Option<End>> {
        let d = self.null_direction(i, &self.driven);
        let w = self.run.slope(i, &self.free, &d);
        self.run.state.w[i] = w;
        let idle = (w == 0.0).then_some(Side::Idle);
        if let Some(side) = self.run.satisfied(i).or(idle) {
            self.put(i, side);
            return ControlFlow::Continue(None);
        }
        let sign = -w.signum();
        let own = self.run.end_at_bound(i, sign);
        let of_free = self.free.iter().zip(&d).map(|(&k, d)| self.run.end_at_bound(k, sign * d));
        let end = of_free.fold(own, |end, next| if next.length < end.length { next } else { end });
        if end.length == f64::INFINITY
            && self.run.residual_for_good(i) <= self.run.settings.tolerance
        {
            self.put(i, Side::Idle);
            return ControlFlow::Continue(None);
        }
        if end.length == f64::INFINITY {
            return ControlFlow::Break(self.run.ray(i, sign, &self.free, &d));
        }
        if self.run.observer.asks_for_parts() {
            self.tell_move(i, sign, &end, &d, &vec![0.0; self.run.lcp.len()], 0.0);
        }
        self.run.state.x[i] += sign * end.length;
        for (&k, d) in self.free.iter().zip(&d) {
            self.run.state.x[k] += sign * end.length * d;
        }
        self.note_x();
        if end.row != i {
            self.tableau.read(end.row, &mut self.other);
        }
        ControlFlow::Continue(Some(end))
    }

    /// Moves x off the bound that `row` of C, that in `other`, has met, to the middle of what a row that depends on it
    /// leaves open; returns whether it could.
    pub(super) fn move_off_bound(&mut self, row: usize) -> bool {
        let spare = self.dependents(row, |own, j| {
            let is_spare = match own.run.state.side[j] {
                Side::Idle => true,
                Side::Lower | Side::Upper => own.run.may_leave(j) && own.basic.value(j) == 0.0,
                Side::Waiting | Side::Free => false,
            };
            is_spare && !own.served.contains(&j)
        });
        for j in spare {
            self.served.push(j);
            let mut third = std::mem::take(&mut self.third).unwrap_or_else(|| self.tableau.room());
            self.tableau.read(j, &mut third);
            let is_null = matches!(self.schur(j, &third), Schur::Zero(_));
            let d = self.null_direction(j, &third);
            self.third = Some(third);
            let k = self.free.iter().position(|&k| k == row);
            let leads_away = is_null && k.is_some_and(|k| d[k] != 0.0);
            if leads_away && self.centre(j, &d, Some(row)) {
                return true;
            }
        }
        false
    }

    /// Lets the first of these idle rows enter C that no longer depends on it.
    pub(super) fn admit_idle(&mut self, i: usize, idle: &[usize]) {
        for &row in idle {
            self.tableau.read(row, &mut self.other);
            match self.schur(row, &self.other) {
                Schur::Positive(_) => return self.enter(i, row),
                Schur::Zero(_) => {}
                Schur::Doubtful => self.is_doubtful = true,
            }
        }
    }

    /// Those of the rows of some kind that depend on row k of C, that in `other`, so that one can take its place: once k
    /// is gone s of row j is s_jk² / |s_kk| ≤ s_jk² a_kk.
    pub(super) fn dependents(
        &self,
        k: usize,
        is_of_kind: impl Fn(&Self, usize) -> bool,
    ) -> Vec<usize> {
        let depends = |j: usize| {
            let part = get(&self.other, j) * self.run.root[k];
            part * part > ROUNDING * self.run.root[j].powi(2)
        };
        (0..self.run.lcp.len()).filter(|&j| is_of_kind(self, j) && depends(j)).collect()
    }

    /// d_C of a row that depends on C, given its row of the tableau.
    fn null_direction(&self, j: usize, row: &[Block]) -> Vec<f64> {
        let mut d: Vec<f64> = self.free.iter().map(|&k| -get(row, k)).collect();
        self.run.clean_null_direction(j, &self.free, &mut d);
        d
    }

    /// Moves x to the middle of where it may go along d; then row j is idle.
    fn centre(&mut self, j: usize, d: &[f64], keeps: Option<usize>) -> bool {
        let has_moved = self.run.centre(j, &self.free, d, keeps);
        if has_moved {
            self.put(j, Side::Idle);
            self.note_x();
        }
        has_moved
    }

    /// The variables of the free rows are x.
    fn note_x(&mut self) {
        for &k in &self.free {
            self.basic.set(k, self.run.state.x[k]);
        }
    }
}
