//! The basic variables of the tableau and how far they can move.
//!
//! Each row has one that may move: x_j of a free row, w_j of a row at a bound. They keep between two limits, an x
//! between its bounds, a w on the side of zero that its bound allows; so one test serves all.

use super::Side;
use crate::kernel::Width;
use crate::kernel::tableau::{Advance, ROUNDING, Reach};

/// One a row, as arrays that a processor can go through at a stretch.
pub(super) struct Basic {
    value: Vec<f64>,
    low: Vec<f64>,
    high: Vec<f64>,
    /// The speed is so many times the entry of the tableau: −1 for an x, 1 for a w, 0 where nothing is asked.
    factor: Vec<f64>,
    /// √a_jj for a w, 0 for an x: how large an entry is that only rounding leaves.
    rounding: Vec<f64>,
    /// √a_jj for an x, 0 for a w: what d_j is measured by.
    weight: Vec<f64>,
    /// Of those that end a move together the least goes first: w before x, then in the order of arrival.
    rank: Vec<u64>,
    arrivals: u64,
    /// Of the move under way.
    speed: Vec<f64>,
    length: Vec<f64>,
    width: Width,
}

/// Moves whose lengths differ by less than this part of them end together.
pub(super) const TIE: f64 = 1e-10;

impl Basic {
    /// n rows of which nothing is asked, and some more, so that they are whole blocks of eight.
    pub(super) fn of(n: usize, width: Width) -> Self {
        let n = n.next_multiple_of(8);
        let zeros = || vec![0.0; n];
        Basic {
            value: zeros(),
            low: vec![f64::NEG_INFINITY; n],
            high: vec![f64::INFINITY; n],
            factor: zeros(),
            rounding: zeros(),
            weight: zeros(),
            rank: vec![0; n],
            arrivals: 0,
            speed: zeros(),
            length: vec![f64::INFINITY; n],
            width,
        }
    }

    /// Row j stands on this side from now on, at this x or w, whichever may move; √a_jj is its unit.
    pub(super) fn put(
        &mut self,
        j: usize,
        side: Side,
        value: f64,
        (lo, hi): (f64, f64),
        unit: f64,
    ) {
        self.arrivals += 1;
        self.value[j] = value;
        let (low, high, factor) = match side {
            Side::Free => (lo, hi, -1.0),
            Side::Lower if lo < hi => (0.0, f64::INFINITY, 1.0),
            Side::Upper if lo < hi => (f64::NEG_INFINITY, 0.0, 1.0),
            _ => (f64::NEG_INFINITY, f64::INFINITY, 0.0),
        };
        (self.low[j], self.high[j], self.factor[j]) = (low, high, factor);
        let is_free = side == Side::Free;
        (self.weight[j], self.rounding[j]) = if is_free { (unit, 0.0) } else { (0.0, unit) };
        self.rank[j] = self.arrivals + if is_free { 1 << 62 } else { 0 };
    }

    /// Σ_C √a_jj |d_j|, given a row of the tableau.
    pub(super) fn size(&self, row: &[f64]) -> f64 {
        let mut lanes = [0.0; 8];
        let weights = self.weight.as_chunks::<8>().0;
        for (block, weights) in row.as_chunks::<8>().0.iter().zip(weights) {
            for lane in 0..8 {
                lanes[lane] += weights[lane] * block[lane].abs();
            }
        }
        lanes.iter().sum()
    }

    /// How far x_i, whose row of the tableau this is, can go up, sign = 1, or down before a variable meets a limit; `size`
    /// is that of the direction. ∞ if none does.
    pub(super) fn reach(&mut self, row: &[f64], sign: f64, size: f64) -> f64 {
        let Basic { value, low, high, factor, rounding: zero, speed, length, width, .. } = self;
        let size = ROUNDING * size;
        Reach { value, low, high, factor, zero, row, sign, size, speed, length }.run(*width)
    }

    /// The row whose variable ends a move within this length, and where; where several do, the first by rank.
    pub(super) fn first_within(&self, length: f64) -> Option<(usize, f64)> {
        let ends = self.length.iter().enumerate().filter(|(_, own)| **own <= length);
        ends.min_by_key(|&(j, _)| self.rank[j]).map(|(j, own)| (j, *own))
    }

    /// How fast row j's variable moves.
    pub(super) fn speed(&self, j: usize) -> f64 {
        self.speed[j]
    }

    /// Row j's variable.
    pub(super) fn value(&self, j: usize) -> f64 {
        self.value[j]
    }

    /// All variables go on for this length; exactly 0 where only rounding is left, or ties are missed.
    pub(super) fn advance(&mut self, length: f64) {
        let (value, speed) = (&mut self.value, &self.speed);
        Advance { value, speed, length }.run(self.width);
    }

    /// The place of row j in the order of arrival, among those of its kind.
    pub(super) fn rank(&self, j: usize) -> u64 {
        self.rank[j]
    }
}
