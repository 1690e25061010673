//! A pivot: x moves, and the row that ended the move changes sides.

use std::ops::ControlFlow;

use super::Side;
use super::blocking::Block;
use super::direction::Direction;
use super::run::Run;
use crate::Status;
use crate::linalg::elimination::difference;
use crate::tolerances::SCHUR_ROUNDING;

impl Run<'_> {
    /// x ← x + t d, w ← w + t A d.
    pub(super) fn advance(&mut self, i: usize, t: f64, direction: &Direction) {
        self.state.x[i] += t;
        for (&j, d) in self.basis.free.iter().zip(&direction.free) {
            self.state.x[j] = difference(self.state.x[j], -t * d);
        }
        for &j in &self.basis.bound {
            // exactly 0 where it should be; otherwise ties are missed
            self.state.w[j] = difference(self.state.w[j], -t * direction.delta_w[j]);
        }
        self.state.w[i] += t * direction.schur;
    }

    /// Moves the blocking row to its new side.
    pub(super) fn exchange(
        &mut self,
        i: usize,
        block: Block,
        direction: Box<Direction>,
    ) -> ControlFlow<Status> {
        let Block { row, side, entering, .. } = block;
        match side {
            Side::Lower => self.state.x[row] = self.lcp.lo()[row],
            Side::Upper => self.state.x[row] = self.lcp.hi()[row],
            _ => self.state.w[row] = 0.0,
        }
        match (self.state.side[row], side) {
            (Side::Free, _) => {
                let k = self.basis.free.iter().position(|&j| j == row).expect("a free row is in C");
                let set_aside = (0..self.state.x.len())
                    .filter(|&j| self.state.side[j] == Side::Dependent)
                    .collect();
                let dependents = self.dependents(k, set_aside);
                self.basis.free.remove(k);
                self.basis.factor.remove(k);
                self.state.w[row] = 0.0;
                self.put(row, side);
                self.admit_dependent(&dependents)?;
            }
            (_, Side::Free) if row == i => self.enter(row, &direction),
            (_, Side::Free) => {
                let own = entering.expect("a row that enters has been examined");
                if own.schur > 0.0 {
                    self.enter(row, &own);
                } else {
                    // Its w had changed only by rounding.
                    self.put(row, Side::Dependent);
                }
                self.scratch.directions.push(own);
            }
            _ => self.put(row, side),
        }
        self.scratch.directions.push(direction);
        ControlFlow::Continue(())
    }

    fn enter(&mut self, row: usize, direction: &Direction) {
        self.basis.factor.enter(&direction.elimination, direction.schur);
        self.basis.free.push(row);
        self.put(row, Side::Free);
    }

    /// Those of these rows that depend on the row at position k of C, so that one of them can
    /// replace it.
    ///
    /// Row j is the sum of the rows of C times A_CC⁻¹ A_Cj. With z = A_CC⁻¹ e_k its coefficient of
    /// row k is zᵀA_Cj, and once k is removed its Schur complement is (zᵀA_Cj)² / z_k ≤ (zᵀA_Cj)²
    /// a_kk.
    pub(super) fn dependents(&self, k: usize, rows: Vec<usize>) -> Vec<usize> {
        if rows.is_empty() {
            return rows;
        }
        let mut z = vec![0.0; self.basis.free.len()];
        z[k] = 1.0;
        self.basis.factor.solve(&mut z);
        let mut of_row = vec![0.0; self.state.x.len()];
        for (&j, z) in self.basis.free.iter().zip(&z) {
            of_row[j] = *z;
        }
        let part = |j: usize| self.rows().row(j).dot(&of_row) * self.root[self.basis.free[k]];
        let depends = |&j: &usize| part(j).powi(2) > SCHUR_ROUNDING * self.root[j].powi(2);
        rows.into_iter().filter(depends).collect()
    }

    /// After a row has left C, the dependent row that no longer depends on C enters C instead.
    fn admit_dependent(&mut self, dependents: &[usize]) -> ControlFlow<Status> {
        for &row in dependents {
            let direction = self.direction(row)?;
            let is_free = direction.schur > 0.0;
            if is_free {
                self.enter(row, &direction);
            }
            self.scratch.directions.push(direction);
            if is_free {
                break;
            }
        }
        ControlFlow::Continue(())
    }
}
