//! How far x moves: what ends a move first.
//!
//! Where several things end a move at once, the driven row goes first, then a row that enters C, the
//! one longest at its bound before the others, then a row that leaves C. The rule matters: Fathi's
//! problem, all ties, takes n² − n + 1 pivots with it and 2ⁿ − 1 if ties go to the least index.

use std::ops::ControlFlow;

use super::direction::Direction;
use super::{Run, Side};
use crate::solver::Status;

/// Moves whose lengths differ by less than this part of them end together.
const TIE: f64 = 1e-10;

/// What ends a move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Block {
    pub(super) length: f64,
    pub(super) row: usize,
    /// Where the row goes.
    pub(super) side: Side,
}

impl Run<'_> {
    /// The first thing that ends a move of x_i by sign · t, t ≥ 0; see above for ties. A row whose w
    /// only rounding moves ends nothing, and its Δw is set to zero.
    pub(super) fn blocking(
        &self,
        i: usize,
        sign: f64,
        d: &Direction,
        delta_w: &mut [f64],
    ) -> ControlFlow<Status, Option<Block>> {
        loop {
            let block = self.nearest(i, sign, d, delta_w);
            match block {
                Some(Block { row, side: Side::Free, .. }) if row != i => {
                    if !self.is_rounding(delta_w[row], d, &self.direction(row)?) {
                        return ControlFlow::Continue(block);
                    }
                    delta_w[row] = 0.0;
                }
                _ => return ControlFlow::Continue(block),
            }
        }
    }

    fn nearest(&self, i: usize, sign: f64, d: &Direction, delta_w: &[f64]) -> Option<Block> {
        let mut blocks: Vec<Block> = Vec::new();
        let mut consider = |length: f64, row: usize, side: Side| {
            if length < f64::INFINITY {
                blocks.push(Block { length: length.max(0.0), row, side });
            }
        };
        if d.schur > 0.0 {
            consider(self.w[i].abs() / d.schur, i, Side::Free);
        }
        let (length, side) = self.distance_to_bound(i, sign);
        consider(length, i, side);
        for &j in &self.bound {
            let delta = sign * delta_w[j];
            let falls = self.side[j] == Side::Lower && delta < 0.0;
            let rises = self.side[j] == Side::Upper && delta > 0.0;
            if (falls || rises) && self.lcp.lo()[j] < self.lcp.hi()[j] {
                consider(-self.w[j] / delta, j, Side::Free);
            }
        }
        for (&j, d) in self.free.iter().zip(&d.free) {
            let (length, side) = self.distance_to_bound(j, sign * d);
            consider(length, j, side);
        }
        let least = blocks.iter().map(|block| block.length).fold(f64::INFINITY, f64::min);
        blocks.into_iter().find(|block| block.length <= least * (1.0 + TIE))
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
