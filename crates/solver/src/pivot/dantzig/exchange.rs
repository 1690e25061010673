//! A pivot: x moves, and the row that ended the move changes sides.

use std::ops::ControlFlow;

use super::Side;
use super::blocking::Block;
use super::direction::Direction;
use super::run::{Run, State};
use crate::Status;
use crate::kernel::moves::advance;
use crate::tolerances::SCHUR_ROUNDING;

impl Run<'_> {
    /// x ← x + t d, w ← w + t A d.
    pub(super) fn advance(&mut self, i: usize, t: f64, direction: &Direction) {
        let (x_i, w_i) = (self.state.x[i] + t, self.state.w[i] + t * direction.schur);
        // exactly 0 where it should be; otherwise ties are missed
        let State { x, w, .. } = &mut self.state;
        let state = [&mut x[..self.end], &mut w[..self.end]];
        advance(self.width, t, state, [&direction.d, &direction.delta_w]);
        (self.state.x[i], self.state.w[i]) = (x_i, w_i);
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
                let dependents = self.dependents(row, set_aside);
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
        self.basis.factor.enter(&direction.free, direction.schur);
        self.basis.free.push(row);
        self.put(row, Side::Free);
    }

    /// Those of these rows that depend on row k of C, so that one of them can replace it.
    ///
    /// Row j is the sum of the rows of C times A_CC⁻¹ A_Cj. With z = A_CC⁻¹ e_k its coefficient of
    /// row k is zᵀA_Cj, and once k is removed its Schur complement is (zᵀA_Cj)² / z_k ≤ (zᵀA_Cj)²
    /// a_kk.
    pub(super) fn dependents(&self, k: usize, rows: Vec<usize>) -> Vec<usize> {
        if rows.is_empty() {
            return rows;
        }
        let unit = self.basis.free.iter().map(|&j| f64::from(j == k)).collect();
        let (minus_z, _) = self.basis.factor.eliminate(unit);
        let mut of_row = vec![0.0; self.state.x.len().next_multiple_of(8)];
        let mut products = of_row.clone();
        for (&j, minus_z) in self.basis.free.iter().zip(&minus_z) {
            of_row[j] = *minus_z;
        }
        self.rows().products(&rows, &of_row, &mut products);
        let part = |j: usize| products[j] * self.root[k];
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
