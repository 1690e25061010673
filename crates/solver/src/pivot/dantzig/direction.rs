//! The direction of a move, which changes w_i and keeps w_C at zero.

use std::iter;
use std::ops::ControlFlow;

use super::run::{Basis, Run};
use crate::Status;
use crate::kernel::moves;
use crate::tolerances::{
    NEGATIVE_SCHUR, NULL_DIRECTION_ROUNDING, RELATIVE_ZERO, SCHUR_ROUNDING, SLOPE_ROUNDING,
};
use lcplab_lcp::merit;

/// A direction of motion: x_i changes by 1, x_C by d_C.
#[derive(Debug, Default)]
pub(super) struct Direction {
    /// d_C, in the order of C, then zeros.
    pub(super) free: Vec<f64>,
    /// A_Ci, in the order of C, then zeros.
    column: Vec<f64>,
    /// d, n entries and zeros up to the next multiple of eight: d_i = 1, and 0 for rows outside C.
    pub(super) d: Vec<f64>,
    /// Δw_i; 0 if row i depends on C.
    pub(super) schur: f64,
    /// Σ √a_jj |d_j|, row i included; equal to √s if nothing cancels.
    pub(super) size: f64,
    /// Δw = A d, as long as d; valid for the rows at a bound.
    pub(super) delta_w: Vec<f64>,
}

impl Direction {
    /// An empty direction with storage for n rows.
    fn with_room(n: usize) -> Self {
        Direction {
            free: Vec::with_capacity(n.next_multiple_of(8)),
            column: Vec::with_capacity(n.next_multiple_of(8)),
            d: vec![0.0; n.next_multiple_of(8)],
            delta_w: vec![0.0; n.next_multiple_of(8)],
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
        let Direction { free, column, d, schur, size, .. } = &mut *direction;
        let (row, padded) = (self.rows().row(i), self.basis.free.len().next_multiple_of(8));
        column.clear();
        column.extend(self.basis.free.iter().map(|&j| row.entry(j)));
        column.resize(padded, 0.0);
        free.clear();
        free.resize(padded, 0.0);
        let product = self.basis.factor.subtract_solution(column, free);
        *schur = self.lcp.matrix().diagonal(i) - product;
        d.fill(0.0);
        d[i] = 1.0;
        for (&j, value) in self.basis.free.iter().zip(&*free) {
            d[j] = *value;
        }
        *size = moves::size(self.width, &self.root[..self.end], d);
        if *schur < -NEGATIVE_SCHUR * *size * *size {
            let reason = "A is not positive semidefinite";
            return ControlFlow::Break(Status::OutsideClass { reason });
        }
        if *schur <= SCHUR_ROUNDING * *size * *size {
            *schur = 0.0;
            self.clean_null_direction(i, free, d);
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
        let rows = iter::once(i).chain(self.basis.free.iter().copied());
        for (j, d) in rows.map(|j| (j, d.d[j])).filter(|(_, d)| *d != 0.0) {
            let terms = merit::RowTerms::at(self.lcp, j, &self.state.x);
            slope += d * terms.w();
            magnitude += (d * libm::ldexp(terms.magnitude, terms.exponent)).abs();
        }
        if slope.abs() <= SLOPE_ROUNDING * magnitude { 0.0 } else { slope }
    }

    /// Sets entries of d that are only rounding to zero, if A d = 0: a move along d may be long and
    /// must not end at a bound because of rounding. √a_jj d_j has the same unit in all rows.
    fn clean_null_direction(&self, i: usize, free: &mut [f64], d: &mut [f64]) {
        let size = |j: usize, d: f64| self.root[j] * d.abs();
        let sizes = self.basis.free.iter().map(|&j| size(j, d[j]));
        let largest = sizes.fold(self.root[i], f64::max);
        for (&j, of_free) in self.basis.free.iter().zip(free) {
            if size(j, d[j]) <= NULL_DIRECTION_ROUNDING * largest {
                (*of_free, d[j]) = (0.0, 0.0);
            }
        }
    }

    /// Δw = A d for a unit move of x_i, for the rows at a bound; 0 where it is only rounding.
    pub(super) fn respond(&self, i: usize, d: &mut Direction) {
        d.delta_w.fill(0.0);
        if d.schur == 0.0 {
            // All of A d vanishes.
            return;
        }
        let end = self.end.next_multiple_of(8);
        let (Basis { free, bound, .. }, a) = (&self.basis, self.rows());
        if bound.len() <= free.len() {
            a.products(bound, &d.d[..end], &mut d.delta_w);
        } else {
            // A is symmetric.
            a.combine(free, &d.d, &mut d.delta_w[..end]);
            a.combine(&[i], &d.d, &mut d.delta_w[..end]);
        }
        let mut sizes = None;
        for &j in self.basis.bound.iter().filter(|&&j| j != i) {
            let delta = d.delta_w[j];
            // no term |a_jk d_k| sums to more than √a_jj Σ √a_kk |d_k|
            let is_small = delta.abs() <= RELATIVE_ZERO * self.root[j] * d.size;
            let mut terms = || {
                let sizes =
                    sizes.get_or_insert_with(|| d.d.iter().map(|d| d.abs()).collect::<Vec<f64>>());
                self.rows().row(j).magnitude(sizes)
            };
            let is_zero = delta == 0.0 || is_small && delta.abs() <= RELATIVE_ZERO * terms();
            d.delta_w[j] = if is_zero { 0.0 } else { delta };
        }
    }
}
