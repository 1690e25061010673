//! The equations of the free rows, A_FF x_F = −(b_F + A_FB x_B), solved with the factor that suits
//! A.
//!
//! | A | factor | products, for f free rows of n |
//! | --- | --- | --- |
//! | symmetric | [L Lᵀ](crate::linalg::cholesky) in blocks | f³/6 |
//! | symmetric, b entries per row near the diagonal | [L D Lᵀ](crate::linalg::envelope) within the envelope | n b²/2 |
//! | not symmetric | [L U](crate::linalg::elimination) with row exchanges | f³/3 |
//!
//! The factor is kept and reused for the same free rows of the same matrix.

use std::sync::Arc;

use super::active_set::{ActiveSet, Side, unit};
use super::principal::Point;
use crate::Status;
use crate::linalg::cholesky::Cholesky;
use crate::linalg::elimination::Lu;
use crate::linalg::envelope::Envelope;
use crate::tolerances::{RELATIVE_ZERO, RESIDUAL_ROUNDING};
use lcplab_lcp::merit::RowTerms;
use lcplab_lcp::{Lcp, Matrix, accurate};

/// Number of refinement steps for rounding errors in the free rows.
const REFINEMENTS: usize = 2;
/// The envelope is used if it has at most 1/12 of A's entries, because its products are slower than
/// those of a dense block.
const ENVELOPE_PART: usize = 12;

/// The equations of the free rows of one matrix.
#[derive(Debug)]
pub(crate) struct FreeRows {
    /// A reference that keeps the matrix alive, so that no other matrix can have the same address.
    matrix: Arc<Matrix>,
    factor: Factor,
    /// F, if A_FF has been factorized.
    free: Option<Vec<usize>>,
}

#[derive(Debug)]
enum Factor {
    Cholesky(Cholesky),
    Envelope(Envelope),
    Lu(Option<Lu>),
}

impl FreeRows {
    /// The equations of this problem's matrix, without a factor.
    pub(crate) fn of(lcp: &Lcp) -> Self {
        let matrix = Arc::clone(lcp.shared_matrix());
        let most = matrix.len().pow(2) / ENVELOPE_PART;
        let factor = match matrix.is_nearly_symmetric() {
            true if Envelope::entries(&matrix) <= most => Factor::Envelope(Envelope::of(&matrix)),
            true => Factor::Cholesky(Cholesky::default()),
            false => Factor::Lu(None),
        };
        FreeRows { matrix, factor, free: None }
    }

    /// The cached equations if they belong to this problem's matrix (the same object, not an equal
    /// one), otherwise new ones.
    pub(crate) fn kept<'a>(kept: &'a mut Option<Self>, lcp: &Lcp) -> &'a mut Self {
        let is_same = |kept: &Self| Arc::ptr_eq(&kept.matrix, lcp.shared_matrix());
        *kept = kept.take().filter(is_same);
        kept.get_or_insert_with(|| FreeRows::of(lcp))
    }

    /// Whether A is symmetric.
    pub(crate) fn are_symmetric(&self) -> bool {
        !matches!(self.factor, Factor::Lu(_))
    }

    /// Computes the factor of A_FF, unless it is cached.
    fn prepare(&mut self, lcp: &Lcp, free: &[usize]) -> Result<(), Status> {
        if self.free.as_deref() != Some(free) {
            self.free = None;
            self.factor.factor(lcp, free).map_err(|row| Status::Singular { row })?;
            self.free = Some(free.to_vec());
        }
        Ok(())
    }

    /// z ← A_FF⁻¹ z for these free rows, or [`Status::Singular`].
    pub(crate) fn solve(&mut self, lcp: &Lcp, free: &[usize], z: &mut [f64]) -> Result<(), Status> {
        self.prepare(lcp, free)?;
        self.factor.solve(lcp, free, z);
        Ok(())
    }

    /// The point of an active set; [`Status::Singular`] or [`Status::NotFinite`] if there is none.
    pub(crate) fn point(&mut self, lcp: &Lcp, set: &ActiveSet) -> Result<Point, Status> {
        let free: Vec<usize> = (0..lcp.len()).filter(|&i| set.0[i] == Side::Free).collect();
        self.prepare(lcp, &free)?;
        let free = &free;
        let mut x = set.moved_to_bounds(lcp, &vec![0.0; lcp.len()]);
        match x.iter().all(|&x| x == 0.0) {
            // w = b
            true => self.factor.correct(lcp, free, &mut x, |i, _| lcp.b()[i]),
            false => self.factor.correct(lcp, free, &mut x, |i, x| lcp.row_w(i, x)),
        }
        let mut point = Point::at(lcp, x);
        for _ in 0..REFINEMENTS {
            let is_left = |&i: &usize| {
                let RowTerms { w, magnitude, .. } = point.terms[i];
                w.abs() > RESIDUAL_ROUNDING * magnitude
            };
            if !free.iter().any(is_left) {
                break;
            }
            let accurate_w = |i: usize, x: &[f64]| RowTerms::summed::<accurate::Sum>(lcp, i, x).w();
            self.factor.correct(lcp, free, &mut point.x, accurate_w);
            point = Point::at(lcp, point.x);
        }
        if point.x.iter().all(|x| x.is_finite()) { Ok(point) } else { Err(Status::NotFinite) }
    }
}

impl Factor {
    fn factor(&mut self, lcp: &Lcp, free: &[usize]) -> Result<(), usize> {
        match self {
            Factor::Cholesky(factor) => factor.factor(lcp, free),
            Factor::Envelope(factor) => {
                let mut is_free = vec![false; lcp.len()];
                free.iter().for_each(|&i| is_free[i] = true);
                factor.factor(lcp.matrix(), &vec![0.0; lcp.len()], |i| !is_free[i])?;
                let is_zero =
                    |&i: &usize| factor.pivots()[i] <= RELATIVE_ZERO * lcp.matrix().diagonal(i);
                free.iter().copied().find(is_zero).map_or(Ok(()), Err)
            }
            Factor::Lu(factor) => {
                let unit: Vec<f64> = free.iter().map(|&i| unit(lcp, i)).collect();
                let entry =
                    |r: usize, c: usize| lcp.matrix().entry(free[r], free[c]) / unit[r] / unit[c];
                *factor = Some(Lu::of(free.len(), entry).map_err(|k| free[k])?);
                Ok(())
            }
        }
    }

    /// x_F ← x_F − A_FF⁻¹ w_F.
    fn correct(&self, lcp: &Lcp, free: &[usize], x: &mut [f64], w: impl Fn(usize, &[f64]) -> f64) {
        let mut step: Vec<f64> = free.iter().map(|&i| -w(i, x)).collect();
        self.solve(lcp, free, &mut step);
        for (&i, step) in free.iter().zip(&step) {
            x[i] += step;
        }
    }

    /// Solves A_FF z = rhs in place.
    fn solve(&self, lcp: &Lcp, free: &[usize], rhs: &mut [f64]) {
        match self {
            Factor::Cholesky(factor) => factor.solve(rhs),
            Factor::Envelope(factor) => {
                let mut all = vec![0.0; lcp.len()];
                free.iter().zip(&*rhs).for_each(|(&i, value)| all[i] = *value);
                factor.solve(&mut all);
                rhs.iter_mut().zip(free).for_each(|(z, &i)| *z = all[i]);
            }
            Factor::Lu(factor) => {
                let scale = |z: &mut [f64]| {
                    z.iter_mut().zip(free).for_each(|(z, &i)| *z /= unit(lcp, i));
                };
                scale(rhs);
                factor.iter().for_each(|factor| factor.solve(rhs));
                scale(rhs);
            }
        }
    }
}
