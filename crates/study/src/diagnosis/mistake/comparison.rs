//! Whether an answer is explained by a mistake, or by chance.
//!
//! Three things are asked. The mistake's answer y must agree with x as far as x has digits. It must
//! be at least a hundred times nearer to x than the exact solution s is, at the precision of x. And
//! the agreement must not be chance: of the answers around s that are as far from it as x is, one
//! in
//!
//! ```text
//! ∏_i  |x_i − s_i| / (2 |x_i − y_i|)
//! ```
//!
//! comes as near to y in all entries. An entry that s explains as well counts nothing, and every
//! number that was fitted to x, such as a factor of b, takes one entry away: on one row a factor
//! fits any answer.

use super::nearest::distance;
use super::precision::Precision;

/// A mistake is at least this many times nearer to x than the exact solution.
const NEARER: f64 = 100.0;
/// Numbers that agree to this part of the largest are the same, if they are known to as many
/// digits.
const SAME: f64 = 1e-6;
/// Two numbers that should be one differ by this many units of rounding, beside the largest number.
const ROUNDINGS: f64 = 4.0;
/// An agreement that chance gives so often proves nothing.
const CHANCE: f64 = 1e-6;

/// An answer x, and the exact solution nearest to it.
pub(super) struct Comparison<'a> {
    x: &'a [f64],
    solution: &'a [f64],
    precision: Precision,
    /// The largest number of both.
    size: f64,
}

/// How near a mistake's answer comes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Agreement {
    /// max |x_i − y_i|.
    pub distance: f64,
    /// The same, at least the precision of x.
    apart: f64,
    /// How often an answer by chance comes so near.
    chance: f64,
}

impl Agreement {
    /// Whether chance would have to be blamed less than once in a million times, where this many
    /// other answers were compared that are as simple.
    pub(crate) fn is_no_chance(&self, answers: usize) -> bool {
        self.chance * answers as f64 <= CHANCE
    }

    /// Whether another agreement is not a hundred times nearer.
    pub(crate) fn is_as_near_as(&self, other: &Agreement) -> bool {
        self.apart <= NEARER * other.apart
    }
}

impl<'a> Comparison<'a> {
    pub fn new(x: &'a [f64], solution: &'a [f64], precision: Precision) -> Self {
        let size = x.iter().chain(solution).fold(0.0_f64, |most, x| most.max(x.abs()));
        Comparison { x, solution, precision, size }
    }

    /// max |x_i − s_i| beside the largest number of both.
    pub fn solution_distance(&self) -> f64 {
        self.relative(distance(self.x, self.solution))
    }

    /// A distance beside the largest number of x and of the solution.
    pub fn relative(&self, distance: f64) -> f64 {
        distance / self.size
    }

    /// Whether x is the exact solution as far as its digits say.
    pub(crate) fn is_rounded_solution(&self) -> bool {
        let is_rounded = |i: usize| (self.x[i] - self.solution[i]).abs() <= self.uncertainty(i);
        (0..self.x.len()).all(is_rounded)
    }

    /// How y agrees with x, if it is near enough; `fitted` numbers of it were taken from x.
    pub fn agreement(&self, y: &[f64], fitted: usize) -> Option<Agreement> {
        let (distance, distance_to_solution) =
            (distance(self.x, y), distance(self.x, self.solution));
        // A mistake whose own answer is as short a number explains why x is: its digits are not
        // rounded.
        let is_decimal = matches!(self.precision, Precision::Decimal { .. });
        let is_short = is_decimal && distance <= self.rounding();
        let known = |i: usize| if is_short { self.rounding() } else { self.uncertainty(i) };
        let gap = |i: usize| (self.x[i] - y[i]).abs().max(known(i));
        let is_same = |i: usize| (self.x[i] - y[i]).abs() <= (SAME * self.size).max(2.0 * known(i));
        let apart = (0..y.len()).map(gap).fold(0.0, f64::max);
        if !(0..y.len()).all(is_same) || NEARER * apart > distance_to_solution {
            return None;
        }
        let ratio = |i: usize| (2.0 * gap(i) / (self.x[i] - self.solution[i]).abs()).min(1.0);
        let mut ratios: Vec<f64> = (0..y.len()).map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        let chance = ratios.iter().skip(fitted).product();
        Some(Agreement { distance, apart, chance })
    }

    /// How far the number that x_i stands for may lie from it.
    fn uncertainty(&self, i: usize) -> f64 {
        // A number exactly between two others is rounded to either.
        self.precision.half_unit(self.x[i]).max(self.rounding()) * (1.0 + SAME)
    }

    fn rounding(&self) -> f64 {
        ROUNDINGS * f64::EPSILON * self.size
    }
}
