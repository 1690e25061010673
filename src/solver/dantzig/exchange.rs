//! A pivot: x moves, and the row that ended the move changes sides.

use std::ops::ControlFlow;

use super::blocking::Block;
use super::direction::Direction;
use super::{Run, Side};
use crate::solver::Status;
use crate::solver::elimination::difference;

impl Run<'_> {
    /// x ← x + t d, w ← w + t A d.
    pub(super) fn advance(&mut self, i: usize, t: f64, direction: &Direction, delta_w: &[f64]) {
        self.x[i] += t;
        for (&j, d) in self.free.iter().zip(&direction.free) {
            self.x[j] = difference(self.x[j], -t * d);
        }
        for (w, delta) in self.w.iter_mut().zip(delta_w) {
            *w = difference(*w, -t * delta); // exactly 0 where it should be, or ties are missed
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
        let Block { row, side, .. } = block;
        match side {
            Side::Lower => self.x[row] = self.lcp.lo()[row],
            Side::Upper => self.x[row] = self.lcp.hi()[row],
            _ => self.w[row] = 0.0,
        }
        match (self.side[row], side) {
            (Side::Free, _) => {
                let k = self.free.iter().position(|&j| j == row).expect("a free row is in C");
                self.free.remove(k);
                self.factor.remove(k);
                self.w[row] = 0.0;
                self.put(row, side);
                return self.wake_idle();
            }
            (_, Side::Free) => {
                let d = if row == i { direction } else { self.direction(row)? };
                if d.schur > 0.0 {
                    self.enter(row, d);
                } else {
                    self.put(row, Side::Idle); // only rounding had moved its w
                }
            }
            _ => self.put(row, side),
        }
        ControlFlow::Continue(())
    }

    fn enter(&mut self, row: usize, direction: Direction) {
        self.factor.append(&direction.column, direction.schur);
        self.free.push(row);
        self.put(row, Side::Free);
    }

    /// After a row has left C, lets the idle row that no longer depends on C enter in its place.
    fn wake_idle(&mut self) -> ControlFlow<Status> {
        for row in 0..self.side.len() {
            if self.side[row] == Side::Idle {
                let direction = self.direction(row)?;
                if direction.schur > 0.0 {
                    self.enter(row, direction);
                    break;
                }
            }
        }
        ControlFlow::Continue(())
    }
}
