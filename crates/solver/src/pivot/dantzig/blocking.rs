//! How far x moves: what ends a move first.
//!
//! Where several things end a move at once, the driven row goes first, then a row that enters C, the
//! one longest at its bound before the others, then a row that leaves C. The rule matters: Fathi's
//! problem, all ties, takes n² − n + 1 pivots with it and 2ⁿ − 1 if ties go to the least index.

use std::ops::ControlFlow;

use super::direction::Direction;
use super::{Run, Side};
use crate::Status;

/// Moves whose lengths differ by less than this part of them end together.
const TIE: f64 = 1e-10;

/// What ends a move.
#[derive(Debug)]
pub(super) struct Block {
    pub(super) length: f64,
    pub(super) row: usize,
    /// Where the row goes.
    pub(super) side: Side,
    /// Its own direction, if it enters C and is not the driven row.
    pub(super) entering: Option<Direction>,
}

impl Run<'_> {
    /// The first thing that ends a move of x_i by sign · t, t ≥ 0; see above for ties. A row whose w
    /// only rounding moves ends nothing, and its Δw is set to zero.
    pub(super) fn blocking(
        &mut self,
        i: usize,
        sign: f64,
        d: &mut Direction,
    ) -> ControlFlow<Status, Option<Block>> {
        loop {
            let mut block = self.nearest(i, sign, d);
            match &mut block {
                Some(Block { row, side: Side::Free, entering, .. }) if *row != i => {
                    let of_row = self.direction(*row)?;
                    if !self.is_rounding(d.delta_w[*row], d, &of_row) {
                        *entering = Some(of_row);
                        return ControlFlow::Continue(block);
                    }
                    self.spare.push(of_row);
                    d.delta_w[*row] = 0.0;
                }
                _ => return ControlFlow::Continue(block),
            }
        }
    }

    fn nearest(&mut self, i: usize, sign: f64, d: &Direction) -> Option<Block> {
        let mut lengths = std::mem::take(&mut self.lengths);
        lengths.clear();
        let to_zero = if d.schur > 0.0 { self.w[i].abs() / d.schur } else { f64::INFINITY };
        let (to_bound, bound) = self.distance_to_bound(i, sign);
        lengths.extend([to_zero, to_bound]);
        lengths.extend(self.bound.iter().map(|&j| self.distance_to_zero(j, sign * d.delta_w[j])));
        let free = || self.free.iter().zip(&d.free);
        lengths.extend(free().map(|(&j, d)| self.distance_to_bound(j, sign * d).0));
        let least =
            lengths.iter().fold(f64::INFINITY, |least, &l| if l < least { l } else { least });
        let together = least.max(0.0) * (1.0 + TIE);
        let first = lengths.iter().position(|&length| length <= together && length < f64::INFINITY);
        let (rows_at_bound, block) = (self.bound.len(), |k: usize, row, side| {
            Some(Block { length: lengths[k].max(0.0), row, side, entering: None })
        });
        let block = match first? {
            0 => block(0, i, Side::Free),
            1 => block(1, i, bound),
            k if k < 2 + rows_at_bound => block(k, self.bound[k - 2], Side::Free),
            k => {
                let place = k - 2 - rows_at_bound;
                let row = self.free[place];
                block(k, row, self.distance_to_bound(row, sign * d.free[place]).1)
            }
        };
        self.lengths = lengths;
        block
    }

    /// How far w_j, row j being at a bound, can move at this velocity until it is zero.
    fn distance_to_zero(&self, j: usize, velocity: f64) -> f64 {
        let length = -self.w[j] / velocity; // a division costs less than a wrong guess of who needs it
        if self.away[j] * velocity > 0.0 { length } else { f64::INFINITY }
    }

    /// How far x_j can move at this velocity, and the bound it meets then.
    pub(super) fn distance_to_bound(&self, j: usize, velocity: f64) -> (f64, Side) {
        if velocity > 0.0 {
            ((self.lcp.hi()[j] - self.x[j]) / velocity, Side::Upper)
        } else if velocity < 0.0 {
            ((self.lcp.lo()[j] - self.x[j]) / velocity, Side::Lower)
        } else {
            (f64::INFINITY, Side::Free)
        }
    }
}
