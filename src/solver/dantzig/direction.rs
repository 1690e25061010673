//! Where x moves to: the direction that changes w_i and leaves w_C at zero.

use std::iter;
use std::ops::ControlFlow;

use super::{Run, Side};
use crate::lcp::merit;
use crate::solver::Status;

/// A number below this part of the terms it is summed from counts as zero.
const RELATIVE_ZERO: f64 = 1e-13;
/// dᵀA d below this part of (Σ √a_jj |d_j|)² counts as zero, as does Δw_j beside the product of two
/// such sums: so much the rounding of A and of its factor, some ten units in the last place, can do.
pub(super) const ROUNDING: f64 = 2e-15;
/// A part of a null direction below this part of its largest counts as zero.
const NULL_ROUNDING: f64 = 1e-11;
/// dᵀw counts as zero below this part of the terms that the w_j are summed from.
const LEVEL: f64 = 1e-14;
/// s below minus this part of (Σ √a_jj |d_j|)² is not rounding: A is not semidefinite.
const NEGATIVE: f64 = 1e-7;

/// A direction of motion: x_i by 1, x_C by `free`.
pub(super) struct Direction {
    /// d_C, in the order of C.
    pub(super) free: Vec<f64>,
    /// A_Ci.
    pub(super) column: Vec<f64>,
    /// Δw_i; 0 where row i depends on C.
    pub(super) schur: f64,
    /// Σ √a_jj |d_j|, row i included: √s if nothing cancelled.
    pub(super) size: f64,
}

impl Run<'_> {
    /// d_C = −A_CC⁻¹ A_Ci and the Schur complement s.
    pub(super) fn direction(&self, i: usize) -> ControlFlow<Status, Direction> {
        let a = self.lcp.matrix();
        let column: Vec<f64> = self.free.iter().map(|&j| a.entry(i, j)).collect();
        let mut d = column.clone();
        self.factor.solve(&mut d);
        let (mut schur, mut size) = (a.diagonal(i), self.root(i));
        for ((d, a), &j) in d.iter_mut().zip(&column).zip(&self.free) {
            *d = -*d;
            schur += a * *d;
            size += self.root(j) * d.abs();
        }
        if schur < -NEGATIVE * size * size {
            let reason = "A is not positive semidefinite";
            return ControlFlow::Break(Status::OutsideClass { reason });
        }
        if schur <= ROUNDING * size * size {
            schur = 0.0;
            self.clean_null_direction(i, &mut d);
        }
        ControlFlow::Continue(Direction { free: d, column, schur, size })
    }

    /// √a_jj, which has the unit of √(x w) / x_j.
    pub(super) fn root(&self, j: usize) -> f64 {
        self.lcp.matrix().diagonal(j).max(0.0).sqrt()
    }

    /// Whether Δw_j, row j being at a bound, may be nothing but the rounding of the factor.
    pub(super) fn is_rounding(&self, delta_w: f64, along: &Direction, of_row: &Direction) -> bool {
        delta_w.abs() <= ROUNDING * along.size * of_row.size
    }

    /// dᵀw where A d = 0, with w recomputed: how fast the objective changes along d, which the
    /// errors of x do not change; exactly 0 where it is only rounding.
    pub(super) fn slope(&self, i: usize, direction: &Direction) -> f64 {
        let (mut slope, mut magnitude) = (0.0, 0.0);
        for (j, d) in iter::once((i, 1.0)).chain(self.moving(direction)) {
            let terms = merit::RowTerms::at(self.lcp, j, &self.x);
            slope += d * terms.w();
            magnitude += (d * libm::ldexp(terms.magnitude, terms.exponent)).abs();
        }
        if slope.abs() <= LEVEL * magnitude { 0.0 } else { slope }
    }

    fn moving<'a>(&'a self, direction: &'a Direction) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.free.iter().copied().zip(direction.free.iter().copied())
    }

    /// Sets to zero what is only rounding in d where A d = 0: along such a d a move may be long, and
    /// must not end at a bound that only rounding leads to. √a_jj d_j has the same unit in all rows.
    fn clean_null_direction(&self, i: usize, d: &mut [f64]) {
        let size = |j: usize, d: f64| self.root(j) * d.abs();
        let sizes = self.free.iter().zip(&*d).map(|(&j, &d)| size(j, d));
        let largest = sizes.fold(self.root(i), f64::max);
        for (&j, d) in self.free.iter().zip(d) {
            if size(j, *d) <= NULL_ROUNDING * largest {
                *d = 0.0;
            }
        }
    }

    /// Δw for a unit move of x_i, for the rows at a bound; 0 where it is only rounding.
    pub(super) fn delta_w(&self, i: usize, direction: &Direction) -> Vec<f64> {
        let mut d = vec![0.0; self.x.len()];
        d[i] = 1.0;
        for (&j, &value) in self.free.iter().zip(&direction.free) {
            d[j] = value;
        }
        let at_bound = |j: usize| matches!(self.side[j], Side::Lower | Side::Upper) && j != i;
        let delta = |j: usize| {
            let (mut sum, mut magnitude) = (0.0, 0.0);
            for (k, a) in self.lcp.matrix().row(j).iter() {
                sum += a * d[k];
                magnitude += (a * d[k]).abs();
            }
            if f64::abs(sum) <= RELATIVE_ZERO * magnitude { 0.0 } else { sum }
        };
        // where s = 0 the whole of A d vanishes
        let moves = |j: usize| direction.schur > 0.0 && at_bound(j);
        (0..d.len()).map(|j| if moves(j) { delta(j) } else { 0.0 }).collect()
    }
}
