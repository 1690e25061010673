//! The basic variables of a symmetric tableau and how far they can move.
//!
//! Each row has one variable that may move: x_j of a free row, w_j of a row at a bound. Each stays
//! between two limits, x between its bounds, w on the side of zero that its bound allows, so one
//! test covers both.

use super::dantzig::Side;
use crate::kernel::Width;
use crate::kernel::lanes::{Lanes, Work};
use crate::kernel::rank_one::Block;
use crate::tolerances::RELATIVE_ZERO;

/// The basic variables, one per row.
pub(crate) struct Basic {
    lanes_of_rows: Vec<RowLanes>,
    /// The number of blocks up to the last driven row; later rows do not move.
    used: usize,
    width: Width,
}

/// The variables of eight rows, as arrays suitable for vectorization.
#[derive(Clone)]
#[repr(align(64))]
struct RowLanes {
    value: [f64; 8],
    low: [f64; 8],
    high: [f64; 8],
    /// The speed relative to the entry of the tableau: −1 for an x, 1 for a w, 0 for a row without
    /// requirements.
    factor: [f64; 8],
    /// √a_jj for a w, 0 for an x: the scale of rounding in an entry.
    rounding: [f64; 8],
    /// √a_jj for an x, 0 for a w: the weight of d_j.
    weight: [f64; 8],
    /// The speed in the current move.
    speed: [f64; 8],
    /// The length until the variable reaches a limit, ∞ if it never does; valid where `ends` is
    /// true, otherwise it is larger than all lengths of interest.
    length: [f64; 8],
    ends: bool,
}

/// Rows without requirements.
const IDLE: RowLanes = RowLanes {
    value: [0.0; 8],
    low: [f64::NEG_INFINITY; 8],
    high: [f64::INFINITY; 8],
    factor: [0.0; 8],
    rounding: [0.0; 8],
    weight: [0.0; 8],
    speed: [0.0; 8],
    length: [f64::INFINITY; 8],
    ends: false,
};

impl Basic {
    /// n rows without requirements, padded to a multiple of eight.
    pub(crate) fn of(n: usize) -> Self {
        Basic { lanes_of_rows: vec![IDLE; n.div_ceil(8)], used: 0, width: Width::widest() }
    }

    /// Sets row j to this side, with this value of x or w, whichever may move; √a_jj is its unit.
    pub(crate) fn put(
        &mut self,
        j: usize,
        side: Side,
        value: f64,
        (lo, hi): (f64, f64),
        unit: f64,
    ) {
        let is_free = side == Side::Free;
        let (low, high, factor) = match side {
            Side::Free => (lo, hi, -1.0),
            Side::Lower if lo < hi => (0.0, f64::INFINITY, 1.0),
            Side::Upper if lo < hi => (f64::NEG_INFINITY, 0.0, 1.0),
            _ => (f64::NEG_INFINITY, f64::INFINITY, 0.0),
        };
        let (own, k) = (&mut self.lanes_of_rows[j / 8], j % 8);
        (own.value[k], own.low[k], own.high[k], own.factor[k]) = (value, low, high, factor);
        (own.weight[k], own.rounding[k]) = if is_free { (unit, 0.0) } else { (0.0, unit) };
        self.used = self.used.max(j / 8 + 1);
    }

    /// Σ_C √a_jj |d_j|, given a row of the tableau.
    pub(crate) fn size(&self, row: &[Block]) -> f64 {
        let mut lanes = [0.0; 8];
        for (rows, row) in self.lanes_of_rows[..self.used].iter().zip(row) {
            for k in 0..8 {
                lanes[k] += rows.weight[k] * row.0[k].abs();
            }
        }
        lanes.iter().sum()
    }

    /// How far x_i, whose row of the tableau is given, can go up (sign = 1) or down before a
    /// variable reaches a limit, if that is within `most`; otherwise ∞. `size` is the size of the
    /// direction.
    pub(crate) fn reach(&mut self, row: &[Block], sign: f64, size: f64, most: f64) -> f64 {
        let lanes_of_rows = &mut self.lanes_of_rows[..self.used];
        self.width.run(Reach { lanes_of_rows, row, sign, rounding: RELATIVE_ZERO * size, most })
    }

    /// The rows whose variables end a move within this length.
    pub(crate) fn all_within(&self, length: f64) -> impl Iterator<Item = usize> {
        let ending =
            self.lanes_of_rows[..self.used].iter().enumerate().filter(|(_, rows)| rows.ends);
        let lengths = ending.flat_map(|(b, rows)| (0..8).map(move |k| (8 * b + k, rows.length[k])));
        lengths.filter(move |(_, own)| *own <= length).map(|(j, _)| j)
    }

    /// The speed of row j's variable.
    pub(crate) fn speed(&self, j: usize) -> f64 {
        self.lanes_of_rows[j / 8].speed[j % 8]
    }

    /// The value of row j's variable.
    pub(crate) fn value(&self, j: usize) -> f64 {
        self.lanes_of_rows[j / 8].value[j % 8]
    }

    /// Moves all variables by this length; a value becomes exactly 0 if only rounding is left,
    /// because ties would be missed otherwise.
    pub(crate) fn advance(&mut self, length: f64) {
        self.width.run(Advance { lanes_of_rows: &mut self.lanes_of_rows[..self.used], length });
    }
}

/// See [`Basic::reach`].
struct Reach<'a> {
    lanes_of_rows: &'a mut [RowLanes],
    row: &'a [Block],
    sign: f64,
    /// The threshold, relative to √a_jj, below which an entry is rounding.
    rounding: f64,
    most: f64,
}

impl Work for Reach<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<V: Lanes>(self) -> f64 {
        let (rounding, sign) = (V::splat(self.rounding), V::splat(self.sign));
        let (most, zero) = (V::splat(2.0 * self.most), V::splat(0.0));
        let mut least = [f64::INFINITY; 8];
        for (rows, row) in self.lanes_of_rows.iter_mut().zip(self.row) {
            let entry = V::load(&row.0).zero_within(rounding * V::load(&rows.rounding));
            let speed = sign * V::load(&rows.factor) * entry;
            speed.store(&mut rows.speed);
            let (value, way) = (V::load(&rows.value), most * speed);
            let meets_high = (V::load(&rows.high) - value).any_at_most(way);
            let meets_low = (value - V::load(&rows.low)).any_at_most(zero - way);
            rows.ends = meets_high || meets_low;
            if rows.ends {
                // A division takes longer than all other operations here.
                rows.measure(&mut least);
            }
        }
        least.into_iter().fold(f64::INFINITY, f64::min)
    }
}

impl RowLanes {
    /// Computes how far each variable can move, and updates the least.
    #[inline(always)]
    fn measure(&mut self, least: &mut [f64; 8]) {
        for k in 0..8 {
            let speed = self.speed[k];
            let limit = if speed > 0.0 { self.high[k] } else { self.low[k] };
            let length = (limit - self.value[k]) / speed;
            let length = if length > 0.0 { length } else { 0.0 };
            let length = if speed == 0.0 { f64::INFINITY } else { length };
            self.length[k] = length;
            least[k] = if length < least[k] { length } else { least[k] };
        }
    }
}

/// See [`Basic::advance`].
struct Advance<'a> {
    lanes_of_rows: &'a mut [RowLanes],
    length: f64,
}

impl Work for Advance<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let (length, zero) = (V::splat(self.length), V::splat(RELATIVE_ZERO));
        for RowLanes { value, speed, .. } in self.lanes_of_rows {
            let (before, change) = (V::load(value), length * V::load(speed));
            let rounding = zero * (before.abs() + change.abs());
            (before + change).zero_within(rounding).store(value);
        }
    }
}
