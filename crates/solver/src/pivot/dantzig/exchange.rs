//! A pivot: x moves, and the row that ended the move changes sides.

use std::ops::ControlFlow;

use super::blocking::Block;
use super::direction::{Direction, ROUNDING};
use super::{Run, Side};
use crate::Status;
use crate::elimination::difference;

impl Run<'_> {
    /// x ← x + t d, w ← w + t A d.
    pub(super) fn advance(&mut self, i: usize, t: f64, direction: &Direction) {
        self.x[i] += t;
        for (&j, d) in self.free.iter().zip(&direction.free) {
            self.x[j] = difference(self.x[j], -t * d);
        }
        for &j in &self.bound {
            // exactly 0 where it should be, or ties are missed
            self.w[j] = difference(self.w[j], -t * direction.delta_w[j]);
        }
        self.w[i] += t * direction.schur;
    }

    /// Puts the blocking row on its new side.
    pub(super) fn exchange(
        &mut self,
        i: usize,
        block: Block,
        direction: Direction,
    ) -> ControlFlow<Status> {
        let Block { row, side, entering, .. } = block;
        match side {
            Side::Lower => self.x[row] = self.lcp.lo()[row],
            Side::Upper => self.x[row] = self.lcp.hi()[row],
            _ => self.w[row] = 0.0,
        }
        match (self.side[row], side) {
            (Side::Free, _) => {
                let k = self.free.iter().position(|&j| j == row).expect("a free row is in C");
                let idle = (0..self.x.len()).filter(|&j| self.side[j] == Side::Idle).collect();
                let dependents = self.dependents(k, idle);
                self.free.remove(k);
                self.factor.remove(k);
                self.w[row] = 0.0;
                self.put(row, side);
                self.wake(&dependents)?;
            }
            (_, Side::Free) if row == i => self.enter(row, &direction),
            (_, Side::Free) => {
                let own = entering.expect("a row that enters has been looked at");
                if own.schur > 0.0 {
                    self.enter(row, &own);
                } else {
                    self.put(row, Side::Idle); // only rounding had moved its w
                }
                self.spare.push(own);
            }
            _ => self.put(row, side),
        }
        self.spare.push(direction);
        ControlFlow::Continue(())
    }

    fn enter(&mut self, row: usize, direction: &Direction) {
        self.factor.enter(&direction.elimination, direction.schur);
        self.free.push(row);
        self.put(row, Side::Free);
    }

    /// Those of these rows that depend on the row at position k of C, so that one can take its place.
    ///
    /// Row j is the sum of the rows of C times A_CC⁻¹ A_Cj. With z = A_CC⁻¹ e_k its part of row k is
    /// zᵀA_Cj, and once k is gone its Schur complement is (zᵀA_Cj)² / z_k ≤ (zᵀA_Cj)² a_kk.
    pub(super) fn dependents(&self, k: usize, rows: Vec<usize>) -> Vec<usize> {
        if rows.is_empty() {
            return rows;
        }
        let mut z = vec![0.0; self.free.len()];
        z[k] = 1.0;
        self.factor.solve(&mut z);
        let mut of_row = vec![0.0; self.x.len()];
        for (&j, z) in self.free.iter().zip(&z) {
            of_row[j] = *z;
        }
        let part = |j: usize| self.rows.row(j).dot(&of_row) * self.root[self.free[k]];
        let depends = |&j: &usize| part(j).powi(2) > ROUNDING * self.root[j].powi(2);
        rows.into_iter().filter(depends).collect()
    }

    /// After a row has left C, lets the idle row that no longer depends on C enter in its place.
    fn wake(&mut self, dependents: &[usize]) -> ControlFlow<Status> {
        for &row in dependents {
            let direction = self.direction(row)?;
            let is_free = direction.schur > 0.0;
            if is_free {
                self.enter(row, &direction);
            }
            self.spare.push(direction);
            if is_free {
                break;
            }
        }
        ControlFlow::Continue(())
    }
}
