//! The direction of a move, which changes w_i and keeps w_C at zero.

use std::iter;
use std::ops::ControlFlow;

use super::run::Run;
use crate::Status;
use crate::linalg::ldlt::Elimination;
use crate::tolerances::{
    NEGATIVE_SCHUR, NULL_DIRECTION_ROUNDING, RELATIVE_ZERO, SCHUR_ROUNDING, SLOPE_ROUNDING,
};
use lcplab_lcp::merit;

/// A direction of motion: x_i changes by 1, x_C by `free`.
#[derive(Debug, Default)]
pub(super) struct Direction {
    /// d_C, in the order of C.
    pub(super) free: Vec<f64>,
    /// Δw_i; 0 if row i depends on C.
    pub(super) schur: f64,
    /// Σ √a_jj |d_j|, row i included; equal to √s if nothing cancels.
    pub(super) size: f64,
    /// Δw of the rows at a bound, n entries; 0 for all other rows.
    pub(super) delta_w: Vec<f64>,
    /// A_Ci.
    column: Vec<f64>,
    /// A_CC⁻¹ A_Ci, and the row of the factor if row i enters C.
    pub(super) elimination: Elimination,
    /// A d.
    product: Vec<f64>,
}

impl Direction {
    /// An empty direction with storage for n rows.
    fn with_room(n: usize) -> Self {
        Direction {
            free: Vec::with_capacity(n),
            delta_w: Vec::with_capacity(n),
            column: Vec::with_capacity(n),
            elimination: Elimination::with_room(n),
            product: Vec::with_capacity(n),
            ..Direction::default()
        }
    }
}

impl Run<'_> {
    /// d_C = −A_CC⁻¹ A_Ci and the Schur complement s.
    pub(super) fn direction(&mut self, i: usize) -> ControlFlow<Status, Box<Direction>> {
        let mut direction = self
            .scratch
            .directions
            .pop()
            .unwrap_or_else(|| Box::new(Direction::with_room(self.state.x.len())));
        let Direction { free, schur, size, column, elimination, .. } = &mut *direction;
        let row = self.rows().row(i);
        column.clear();
        column.extend(self.basis.free.iter().map(|&j| row.entry(j)));
        *schur = self.lcp.matrix().diagonal(i) - self.basis.factor.eliminate(column, elimination);
        free.clear();
        free.extend(self.basis.factor.substitute(elimination).map(|z| -z));
        let sizes = self.basis.free.iter().zip(&*free).map(|(&j, d)| self.root[j] * d.abs());
        *size = self.root[i] + sizes.sum::<f64>();
        if *schur < -NEGATIVE_SCHUR * *size * *size {
            let reason = "A is not positive semidefinite";
            return ControlFlow::Break(Status::OutsideClass { reason });
        }
        if *schur <= SCHUR_ROUNDING * *size * *size {
            *schur = 0.0;
            self.clean_null_direction(i, free);
        }
        ControlFlow::Continue(direction)
    }

    /// Whether Δw_j of a row at a bound may be only rounding of the factor.
    pub(super) fn is_rounding(&self, delta_w: f64, along: &Direction, of_row: &Direction) -> bool {
        delta_w.abs() <= SCHUR_ROUNDING * along.size * of_row.size
    }

    /// dᵀw if A d = 0, with w recomputed: the rate at which the objective changes along d,
    /// unaffected by errors in x; exactly 0 if it is only rounding.
    pub(super) fn slope(&self, i: usize, d: &Direction) -> f64 {
        let (mut slope, mut magnitude) = (0.0, 0.0);
        let free = self.basis.free.iter().copied().zip(d.free.iter().copied());
        for (j, d) in iter::once((i, 1.0)).chain(free).filter(|(_, d)| *d != 0.0) {
            let terms = merit::RowTerms::at(self.lcp, j, &self.state.x);
            slope += d * terms.w();
            magnitude += (d * libm::ldexp(terms.magnitude, terms.exponent)).abs();
        }
        if slope.abs() <= SLOPE_ROUNDING * magnitude { 0.0 } else { slope }
    }

    /// Sets entries of d that are only rounding to zero, if A d = 0: a move along d may be long and
    /// must not end at a bound because of rounding. √a_jj d_j has the same unit in all rows.
    fn clean_null_direction(&self, i: usize, d: &mut [f64]) {
        let size = |j: usize, d: f64| self.root[j] * d.abs();
        let sizes = self.basis.free.iter().zip(&*d).map(|(&j, &d)| size(j, d));
        let largest = sizes.fold(self.root[i], f64::max);
        for (&j, d) in self.basis.free.iter().zip(d) {
            if size(j, *d) <= NULL_DIRECTION_ROUNDING * largest {
                *d = 0.0;
            }
        }
    }

    /// Δw = A d for a unit move of x_i, for the rows at a bound; 0 where it is only rounding.
    pub(super) fn respond(&self, i: usize, d: &mut Direction) {
        d.delta_w.clear();
        d.delta_w.resize(self.state.x.len(), 0.0);
        if d.schur == 0.0 {
            // All of A d vanishes.
            return;
        }
        let end = self.basis.bound.iter().max().map_or(0, |last| last + 1);
        d.product.resize(end, 0.0);
        self.rows().combine(i, &self.basis.free, &d.free, &mut d.product);
        let mut sizes = None;
        for &j in self.basis.bound.iter().filter(|&&j| j != i) {
            let delta = d.product[j];
            // no term |a_jk d_k| sums to more than √a_jj Σ √a_kk |d_k|
            let is_small = delta.abs() <= RELATIVE_ZERO * self.root[j] * d.size;
            let mut terms = || {
                let sizes = sizes.get_or_insert_with(|| self.sizes(i, &d.free));
                self.rows().row(j).magnitude(sizes)
            };
            let is_zero = delta == 0.0 || is_small && delta.abs() <= RELATIVE_ZERO * terms();
            d.delta_w[j] = if is_zero { 0.0 } else { delta };
        }
    }

    /// |d| of all rows.
    fn sizes(&self, i: usize, free: &[f64]) -> Vec<f64> {
        let mut sizes = vec![0.0; self.state.x.len()];
        sizes[i] = 1.0;
        for (&k, d) in self.basis.free.iter().zip(free) {
            sizes[k] = d.abs();
        }
        sizes
    }
}
