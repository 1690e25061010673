//! The length of a move of x: the first event that ends it.
//!
//! If several events end a move at once, the driven row goes first, then a row that enters C (the
//! one longest at its bound first), then a row that leaves C. The rule matters: Fathi's problem,
//! which consists of ties, takes n² − n + 1 pivots with it, and 2ⁿ − 1 if ties go to the least
//! index.

use std::ops::ControlFlow;

use super::Side;
use super::direction::Direction;
use super::run::{Run, State};
use crate::Status;
use crate::kernel::moves::{Rows, length_to_bound};
use crate::tolerances::LENGTH_TIE;

/// The event that ends a move.
#[derive(Debug)]
pub(super) struct Block {
    pub(super) length: f64,
    pub(super) row: usize,
    /// The new side of the row.
    pub(super) side: Side,
    /// Its own direction, if it enters C and is not the driven row.
    pub(super) entering: Option<Box<Direction>>,
}

impl Run<'_> {
    /// The first event that ends a move of x_i by sign · t, t ≥ 0; for ties see the module
    /// documentation. A row whose Δw is only rounding ends nothing, and its Δw is set to zero.
    pub(super) fn blocking(
        &mut self,
        i: usize,
        sign: f64,
        d: &mut Direction,
    ) -> ControlFlow<Status, Option<Block>> {
        loop {
            let mut block = self.find_nearest(i, sign, d);
            match &mut block {
                Some(Block { row, side: Side::Free, entering, .. }) if *row != i => {
                    let of_row = self.direction(*row)?;
                    if !self.is_rounding(d.delta_w[*row], d, &of_row) {
                        *entering = Some(of_row);
                        return ControlFlow::Continue(block);
                    }
                    self.scratch.directions.push(of_row);
                    d.delta_w[*row] = 0.0;
                }
                _ => return ControlFlow::Continue(block),
            }
        }
    }

    /// The nearest end of a move; of equally near ones that which the module documentation names.
    fn find_nearest(&mut self, i: usize, sign: f64, d: &Direction) -> Option<Block> {
        let State { x, w, away, .. } = &self.state;
        let (lo, hi) = (self.lcp.lo(), self.lcp.hi());
        let x = &x[..self.end];
        let rows = Rows { x, w, lo, hi, away, d: &d.d, delta_w: &d.delta_w, sign };
        let lengths = &mut self.scratch.lengths;
        let zero = if d.schur > 0.0 { w[i].abs() / d.schur } else { f64::INFINITY };
        let least = rows.lengths(self.width, lengths).min(zero);
        let together = least.max(0.0) * (1.0 + LENGTH_TIE);
        let is_nearest = |length: f64| length <= together && length < f64::INFINITY;
        let block = |length: f64, row, side| {
            Some(Block { length: length.max(0.0), row, side, entering: None })
        };
        let bound = |j: usize| if sign * d.d[j] > 0.0 { Side::Upper } else { Side::Lower };
        if is_nearest(zero) {
            return block(zero, i, Side::Free);
        }
        if is_nearest(lengths[i]) {
            return block(lengths[i], i, bound(i));
        }
        if let Some(&j) = self.basis.bound.iter().find(|&&j| is_nearest(lengths[j])) {
            return block(lengths[j], j, Side::Free);
        }
        let j = *self.basis.free.iter().find(|&&j| is_nearest(lengths[j]))?;
        block(lengths[j], j, bound(j))
    }

    /// How far x_j can move at this velocity until it reaches a bound.
    pub(super) fn length_to_bound(&self, j: usize, velocity: f64) -> f64 {
        length_to_bound(self.state.x[j], [self.lcp.lo()[j], self.lcp.hi()[j]], velocity)
    }
}
