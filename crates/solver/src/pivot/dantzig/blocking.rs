//! The length of a move of x: the first event that ends it.
//!
//! If several events end a move at once, the driven row goes first, then a row that enters C (the
//! one longest at its bound first), then a row that leaves C. The rule matters: Fathi's problem,
//! which consists of ties, takes n² − n + 1 pivots with it, and 2ⁿ − 1 if ties go to the least
//! index.

use std::ops::ControlFlow;

use super::Side;
use super::direction::Direction;
use super::run::Run;
use crate::Status;
use crate::tolerances::LENGTH_TIE;

/// A possible end of a move: a row that reaches this side after this length.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    pub(super) length: f64,
    pub(super) row: usize,
    pub(super) side: Side,
}

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

    /// The nearest end of a move; the first of equally near ones.
    fn find_nearest(&mut self, i: usize, sign: f64, d: &Direction) -> Option<Block> {
        let mut ends = std::mem::take(&mut self.scratch.ends);
        ends.clear();
        ends.extend(self.ends(i, sign, d));
        let least = ends.iter().fold(f64::INFINITY, |least, end| f64::min(least, end.length));
        let together = least.max(0.0) * (1.0 + LENGTH_TIE);
        let is_nearest = |end: &&End| end.length <= together && end.length < f64::INFINITY;
        let nearest = ends.iter().find(is_nearest).copied();
        self.scratch.ends = ends;
        let End { length, row, side } = nearest?;
        Some(Block { length: length.max(0.0), row, side, entering: None })
    }

    /// All possible ends of a move of x_i, in the order in which ties are broken.
    fn ends(&self, i: usize, sign: f64, d: &Direction) -> impl Iterator<Item = End> {
        let zero = if d.schur > 0.0 { self.state.w[i].abs() / d.schur } else { f64::INFINITY };
        let driven = [End { length: zero, row: i, side: Side::Free }, self.end_at_bound(i, sign)];
        let entering = self.basis.bound.iter().map(move |&row| {
            let length = self.distance_to_zero(row, sign * d.delta_w[row]);
            End { length, row, side: Side::Free }
        });
        let leaving = self.basis.free.iter().zip(&d.free);
        let leaving = leaving.map(move |(&row, d)| self.end_at_bound(row, sign * d));
        driven.into_iter().chain(entering).chain(leaving)
    }

    /// How far w_j of a row at a bound can move at this velocity until it is zero.
    fn distance_to_zero(&self, j: usize, velocity: f64) -> f64 {
        // A division costs less than a mispredicted branch.
        let length = -self.state.w[j] / velocity;
        let away = if self.state.side[j] == Side::Upper { velocity } else { -velocity };
        if away > 0.0 && self.may_leave(j) { length } else { f64::INFINITY }
    }

    /// How far x_j can move at this velocity, and the bound it then reaches.
    pub(super) fn end_at_bound(&self, row: usize, velocity: f64) -> End {
        let (x, lo, hi) = (self.state.x[row], self.lcp.lo()[row], self.lcp.hi()[row]);
        let (length, side) = if velocity > 0.0 {
            ((hi - x) / velocity, Side::Upper)
        } else if velocity < 0.0 {
            ((lo - x) / velocity, Side::Lower)
        } else {
            (f64::INFINITY, Side::Free)
        };
        End { length: length.max(0.0), row, side }
    }
}
