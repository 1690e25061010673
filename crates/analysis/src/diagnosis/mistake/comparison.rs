//! Decides whether an answer is explained by a mistake or by chance.
//!
//! There are three conditions. The mistake's answer y must agree with x to the precision of x. It
//! must be at least a hundred times nearer to x than the exact solution s. And the agreement must
//! not be chance: of the answers around s that are as far from s as x is, one in
//!
//! ```text
//! ∏_i  |x_i − s_i| / (2 |x_i − y_i|)
//! ```
//!
//! is as near to y in all entries. Where x and y are decimals with the same few digits, their
//! difference counts as rounding. Random digits agree more often, so such a mistake is only
//! possible. An entry that s explains as well does not count, and every
//! number that was fitted to x, such as a factor of b, removes one entry: on a single row a factor
//! fits any answer.

use super::nearest::distance;
use super::precision::Precision;

/// A mistake must be at least this many times nearer to x than the exact solution.
const NEARER: f64 = 100.0;
/// Numbers that agree to this fraction of the largest are the same, if they are known to that many
/// digits.
const SAME: f64 = 1e-6;
/// Equal numbers may differ by this many units of rounding, relative to the largest number.
const ROUNDINGS: f64 = 4.0;
/// An answer that differs from the solution by more than this part of the largest entry is not a
/// rounded one, however few its digits are.
const LARGEST_ROUNDING: f64 = 0.05;
/// An agreement with a larger probability by chance proves nothing.
const CHANCE: f64 = 1e-6;

/// An answer x with the nearest exact solution.
pub(super) struct Comparison<'a> {
    x: &'a [f64],
    solution: &'a [f64],
    precision: Precision,
    /// The largest absolute entry of both.
    size: f64,
}

/// How closely a mistake's answer agrees.
#[derive(Debug, Clone, Copy)]
pub(super) struct Agreement {
    /// max |x_i − y_i|.
    pub distance: f64,
    /// The same, but at least the precision of x.
    apart: f64,
    /// The probability that a random answer comes this near.
    chance: f64,
    /// The same for a random answer with as few digits.
    chance_of_digits: f64,
}

impl Agreement {
    /// Whether the probability of chance is below one in a million when this many other answers of
    /// equal simplicity were compared.
    pub(crate) fn is_no_chance(&self, answers: usize) -> bool {
        self.chance * answers as f64 <= CHANCE
    }

    /// Whether an answer of random digits would agree too often to exclude chance.
    pub(crate) fn may_be_chance(&self, answers: usize) -> bool {
        self.chance_of_digits * answers as f64 > CHANCE
    }

    /// Whether another agreement is at most a hundred times nearer.
    pub(crate) fn is_as_near_as(&self, other: &Agreement) -> bool {
        self.apart <= NEARER * other.apart
    }
}

impl<'a> Comparison<'a> {
    pub(crate) fn new(x: &'a [f64], solution: &'a [f64], precision: Precision) -> Self {
        let size = x.iter().chain(solution).fold(0.0_f64, |most, x| most.max(x.abs()));
        Comparison { x, solution, precision, size }
    }

    /// max |x_i − s_i| relative to the largest entry of both.
    pub(crate) fn solution_distance(&self) -> f64 {
        self.relative(distance(self.x, self.solution))
    }

    /// A distance relative to the largest entry of x and of the solution.
    pub(crate) fn relative(&self, distance: f64) -> f64 {
        distance / self.size
    }

    /// Whether x is the exact solution within its digits. Nobody rounds to whole numbers what is
    /// about 1: (1, 0) is an answer of its own, not (0.9, 0.45) without its digits.
    pub(crate) fn is_rounded_solution(&self) -> bool {
        let is_rounded = |i: usize| (self.x[i] - self.solution[i]).abs() <= self.uncertainty(i);
        self.solution_distance() <= LARGEST_ROUNDING && (0..self.x.len()).all(is_rounded)
    }

    /// The agreement of y with x, if it is near enough; `fitted` numbers of y were taken from x.
    pub(crate) fn agreement(&self, y: &[f64], fitted: usize) -> Option<Agreement> {
        let (distance, distance_to_solution) =
            (distance(self.x, y), distance(self.x, self.solution));
        // If the mistake's own answer is an equally short decimal, the digits of x are exact, not
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
        let chance = |gap: &dyn Fn(usize) -> f64| {
            let ratio = |i: usize| (2.0 * gap(i) / (self.x[i] - self.solution[i]).abs()).min(1.0);
            let mut ratios: Vec<f64> = (0..y.len()).map(ratio).collect();
            ratios.sort_by(f64::total_cmp);
            ratios.iter().skip(fitted).product()
        };
        let chance_of_digits = chance(&|i| gap(i).max(self.uncertainty(i)));
        Some(Agreement { distance, apart, chance: chance(&gap), chance_of_digits })
    }

    /// The agreement of an x that itself solves a changed problem, where several answers do. The
    /// scaled residual of each row in the problem as posed and in the changed one takes the place
    /// of the distances from s and from y.
    pub(crate) fn judged(&self, posed: &[f64], changed: &[f64], fitted: usize) -> Agreement {
        let ratio = |(own, changed): (&f64, &f64)| match *own {
            0.0 => 1.0,
            own => (changed.max(ROUNDINGS * f64::EPSILON) / own).min(1.0),
        };
        let mut ratios: Vec<f64> = posed.iter().zip(changed).map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        let chance = ratios.iter().skip(fitted).product();
        Agreement { distance: 0.0, apart: self.rounding(), chance, chance_of_digits: chance }
    }

    /// How far the exact number behind x_i may be from x_i.
    fn uncertainty(&self, i: usize) -> f64 {
        // A number halfway between two others may be rounded to either.
        self.precision.half_unit(self.x[i]).max(self.rounding()) * (1.0 + SAME)
    }

    fn rounding(&self) -> f64 {
        ROUNDINGS * f64::EPSILON * self.size
    }
}
