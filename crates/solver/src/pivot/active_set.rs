//! Active sets: which rows are at a bound, and the point that belongs to this choice.
//!
//! With x fixed at the bounds in the rows B, the free rows F have w = 0:
//!
//! ```text
//! x_B = the bounds,   A_FF x_F = −(b_F + A_FB x_B)
//! ```
//!
//! The point solves the LCP if x_F lies within its bounds and w_B has the right signs. Principal
//! pivoting methods differ only in how they choose the next active set.

use super::principal::Point;
use crate::linalg::elimination::Lu;
use crate::tolerances::RESIDUAL_ROUNDING;
use crate::{Settings, Start, Status};
use lcplab_lcp::{Lcp, merit};

/// The side of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    /// x = lo, requires w ≥ 0.
    Lower,
    /// w = 0, requires lo ≤ x ≤ hi.
    Free,
    /// x = hi, requires w ≤ 0.
    Upper,
}

/// A side for each row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ActiveSet(pub(crate) Vec<Side>);

impl ActiveSet {
    /// The active set of a guess; without a guess, every row with a bound is at it.
    pub(crate) fn initial(lcp: &Lcp, start: &Start<'_>, x: &[f64]) -> Self {
        let side = |i: usize| match (lcp.lo()[i], lcp.hi()[i]) {
            (lo, _) if x[i] == lo => Side::Lower,
            (_, hi) if x[i] == hi => Side::Upper,
            (lo, _) if start.x.is_none() && lo.is_finite() => Side::Lower,
            (_, hi) if start.x.is_none() && hi.is_finite() => Side::Upper,
            _ => Side::Free,
        };
        ActiveSet((0..lcp.len()).map(side).collect())
    }

    /// The active set after these sweeps of projected Gauss-Seidel from x = 0; `None` if a diagonal
    /// entry is not positive.
    pub(crate) fn after_sweeps(lcp: &Lcp, sweeps: usize) -> Option<Self> {
        let mut x = Start::default().point(lcp);
        let positive = |i| Some(lcp.matrix().diagonal(i)).filter(|a_ii| *a_ii > 0.0);
        let inverse: Option<Vec<f64>> = (0..x.len()).map(|i| positive(i).map(f64::recip)).collect();
        let inverse = inverse?;
        for _ in 0..sweeps {
            for i in 0..x.len() {
                x[i] = lcp.project(i, x[i] - lcp.row_w(i, &x) * inverse[i], &x);
            }
        }
        Some(ActiveSet::initial(lcp, &Start::at(&x), &x))
    }

    /// The set from another problem, with every row moved to a bound that exists; `None` if the
    /// number of rows differs.
    pub(crate) fn fitted(self, lcp: &Lcp) -> Option<Self> {
        let side = |(i, side): (usize, Side)| match side {
            _ if lcp.lo()[i] == lcp.hi()[i] => Side::Lower,
            Side::Lower if lcp.lo()[i].is_infinite() => Side::Free,
            Side::Upper if lcp.hi()[i].is_infinite() => Side::Free,
            side => side,
        };
        let fits = self.0.len() == lcp.len();
        fits.then(|| ActiveSet(self.0.into_iter().enumerate().map(side).collect()))
    }

    /// The point of this active set, or the row whose pivot vanishes if A_FF is singular.
    pub(crate) fn point(&self, lcp: &Lcp) -> Result<Vec<f64>, usize> {
        let mut x = self.moved_to_bounds(lcp, &vec![0.0; lcp.len()]);
        let free: Vec<usize> = (0..lcp.len()).filter(|&i| self.0[i] == Side::Free).collect();
        let unit: Vec<f64> = free.iter().map(|&i| unit(lcp, i)).collect();
        let entry = |r: usize, c: usize| lcp.matrix().entry(free[r], free[c]) / unit[r] / unit[c];
        let factor = Lu::of(free.len(), entry).map_err(|k| free[k])?;
        for _ in 0..2 {
            // the second pass is a step of iterative refinement
            let w = free.iter().zip(&unit).map(|(&i, unit)| -lcp.row_w(i, &x) / unit);
            let mut step: Vec<f64> = w.collect();
            factor.solve(&mut step);
            for ((&i, step), unit) in free.iter().zip(&step).zip(&unit) {
                x[i] += step / unit;
            }
        }
        Ok(x)
    }

    /// The same set, but free rows that reached a bound up to rounding are at that bound.
    pub(crate) fn tightened(&self, lcp: &Lcp, x: &[f64]) -> Self {
        let side = |i: usize| {
            let is_at = |bound: f64| {
                let terms = merit::RowTerms::at(lcp, i, x);
                // This is false for an infinite bound.
                terms.scale * (x[i] - bound).abs() <= RESIDUAL_ROUNDING * terms.magnitude
            };
            match self.0[i] {
                Side::Free if is_at(lcp.lo()[i]) => Side::Lower,
                Side::Free if is_at(lcp.hi()[i]) => Side::Upper,
                side => side,
            }
        };
        ActiveSet((0..self.0.len()).map(side).collect())
    }

    /// x with the rows at a bound set exactly to the bound.
    pub(crate) fn moved_to_bounds(&self, lcp: &Lcp, x: &[f64]) -> Vec<f64> {
        let place = |i: usize| match self.0[i] {
            Side::Lower => lcp.lo()[i],
            Side::Upper => lcp.hi()[i],
            Side::Free => x[i],
        };
        (0..x.len()).map(place).collect()
    }

    /// The side that row i should change to, if it is not satisfied at the point of this set.
    pub(crate) fn better_side(&self, lcp: &Lcp, i: usize, point: &Point) -> Option<Side> {
        if point.residual(i) <= RESIDUAL_ROUNDING {
            return None;
        }
        match self.0[i] {
            Side::Free if point.x[i] < lcp.lo()[i] => Some(Side::Lower),
            Side::Free if point.x[i] > lcp.hi()[i] => Some(Side::Upper),
            // A_FF is so ill conditioned that w_F is not zero.
            Side::Free => None,
            Side::Lower | Side::Upper => Some(Side::Free),
        }
    }
}

/// A power of two near √s_i, the size of w_i where x_i w_i is about 1. A scaled by these units has
/// a diagonal between 1 and 4, regardless of the units of the rows.
pub(crate) fn unit(lcp: &Lcp, i: usize) -> f64 {
    match merit::row_scale(lcp, i) {
        0.0 => 1.0,
        scale => {
            // 2^exponent ≤ scale
            let exponent = (scale.to_bits() >> 52) as i32 - 1023;
            f64::from_bits(((1023 + exponent.div_euclid(2)) as u64) << 52)
        }
    }
}

/// The status of a method that stopped at x by its own rules.
pub(crate) fn claim(lcp: &Lcp, x: &[f64], settings: &Settings) -> Status {
    Point::at(lcp, x.to_vec()).claim(lcp, settings.tolerance)
}
