//! The equations of the free rows, A_FF x_F = −(b_F + A_FB x_B), solved with the factor that suits
//! A.
//!
//! | A | factor | products, for f free rows of n |
//! | --- | --- | --- |
//! | symmetric | [L Lᵀ](crate::linalg::cholesky) in blocks | f³/6 |
//! | symmetric, b entries per row near the diagonal | [L D Lᵀ](crate::linalg::envelope) within the envelope | n b²/2 |
//! | symmetric, few entries anywhere | [L Lᵀ](crate::linalg::reordered) in a fill-reducing order | by the fill |
//! | not symmetric | [L U](crate::linalg::elimination) with row exchanges | f³/3 |
//!
//! The factor is kept and reused for the same free rows of the same matrix.

use std::sync::Arc;

use super::active_set::{ActiveSet, Side, unit};
use super::opening;
use super::principal::Point;
use crate::Status;
use crate::linalg::cholesky::Cholesky;
use crate::linalg::elimination::Lu;
use crate::linalg::envelope::Envelope;
use crate::linalg::reordered::Reordered;
use crate::tolerances::{RELATIVE_ZERO, RESIDUAL_ROUNDING};
use lcplab_lcp::memory::Memory;
use lcplab_lcp::merit::RowTerms;
use lcplab_lcp::{Lcp, Matrix, accurate};

/// Number of refinement steps for rounding errors in the free rows.
const REFINEMENTS: usize = 2;
/// The envelope is used if it has at most 1/12 of A's entries, because its products are slower than
/// those of a dense block.
const ENVELOPE_PART: usize = 12;
/// Otherwise the rows are reordered if A has at most 1/100 of the entries of a dense matrix.
const SPARSE_PART: usize = 100;

/// The equations of the free rows of one matrix.
#[derive(Debug)]
pub(crate) struct FreeRows {
    /// A reference that keeps the matrix alive, so that no other matrix can have the same address.
    matrix: Arc<Matrix>,
    factor: Factor,
    /// F, if A_FF has been factorized.
    free: Option<Vec<usize>>,
}

/// A row of the table of factors above.
enum Kind {
    Envelope,
    Reordered,
    Cholesky,
    Lu,
}

#[derive(Debug)]
enum Factor {
    Cholesky(Cholesky),
    Envelope(Envelope),
    Reordered(Box<Reordered>),
    Lu(Option<Lu>),
}

impl FreeRows {
    /// The equations of this problem's matrix, without a factor.
    pub(crate) fn of(lcp: &Lcp) -> Self {
        let matrix = Arc::clone(lcp.shared_matrix());
        let factor = Factor::of(&matrix);
        FreeRows { matrix, factor, free: None }
    }

    /// The memory of a factor of this problem's matrix, at most; `None` if it would be dense and
    /// take too long.
    pub(crate) fn memory(lcp: &Lcp) -> Option<Memory> {
        opening::dense_memory(lcp).or_else(|| FreeRows::sparse_memory(lcp))
    }

    /// The memory of a sparse factor; `None` if the factor would be dense.
    fn sparse_memory(lcp: &Lcp) -> Option<Memory> {
        let matrix = lcp.matrix();
        let entries = match Kind::of(matrix) {
            Kind::Envelope => Envelope::entries(matrix),
            Kind::Reordered => Reordered::of(matrix).entries(),
            Kind::Cholesky | Kind::Lu => return None,
        };
        Some(Memory::numbers(entries))
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
            self.factor.factor(lcp, free)?;
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

impl Kind {
    /// The factor that suits the matrix.
    fn of(matrix: &Matrix) -> Self {
        let most = |part: usize| matrix.len().pow(2) / part;
        match matrix.is_nearly_symmetric() {
            true if Envelope::entries(matrix) <= most(ENVELOPE_PART) => Kind::Envelope,
            true if matrix.stored() <= most(SPARSE_PART) => Kind::Reordered,
            true => Kind::Cholesky,
            false => Kind::Lu,
        }
    }
}

impl Factor {
    /// Storage for the factor that suits the matrix.
    fn of(matrix: &Matrix) -> Self {
        match Kind::of(matrix) {
            Kind::Envelope => Factor::Envelope(Envelope::of(matrix)),
            Kind::Reordered => Factor::Reordered(Box::new(Reordered::of(matrix))),
            Kind::Cholesky => Factor::Cholesky(Cholesky::default()),
            Kind::Lu => Factor::Lu(None),
        }
    }

    fn factor(&mut self, lcp: &Lcp, free: &[usize]) -> Result<(), Status> {
        let singular = |row: usize| Status::Singular { row };
        match self {
            Factor::Cholesky(factor) => factor.factor(lcp, free).map_err(singular),
            Factor::Envelope(factor) => {
                let mut is_free = vec![false; lcp.len()];
                free.iter().for_each(|&i| is_free[i] = true);
                factor
                    .factor(lcp.matrix(), &vec![0.0; lcp.len()], |i| !is_free[i])
                    .map_err(singular)?;
                let is_zero =
                    |&i: &usize| factor.pivots()[i] <= RELATIVE_ZERO * lcp.matrix().diagonal(i);
                free.iter().copied().find(is_zero).map_or(Ok(()), |row| Err(singular(row)))
            }
            Factor::Reordered(factor) => {
                let mut is_free = vec![false; lcp.len()];
                free.iter().for_each(|&i| is_free[i] = true);
                let added = vec![0.0; lcp.len()];
                // It does not report at which row it fails.
                let is_positive = factor.factor(lcp.matrix(), &added, |i| !is_free[i]);
                if is_positive { Ok(()) } else { Err(Status::Stalled) }
            }
            Factor::Lu(factor) => {
                let unit: Vec<f64> = free.iter().map(|&i| unit(lcp, i)).collect();
                let entry =
                    |r: usize, c: usize| lcp.matrix().entry(free[r], free[c]) / unit[r] / unit[c];
                *factor = Some(Lu::of(free.len(), entry).map_err(|k| singular(free[k]))?);
                Ok(())
            }
        }
    }

    /// x_F ← x_F − A_FF⁻¹ w_F.
    fn correct(
        &mut self,
        lcp: &Lcp,
        free: &[usize],
        x: &mut [f64],
        w: impl Fn(usize, &[f64]) -> f64,
    ) {
        let mut step: Vec<f64> = free.iter().map(|&i| -w(i, x)).collect();
        self.solve(lcp, free, &mut step);
        for (&i, step) in free.iter().zip(&step) {
            x[i] += step;
        }
    }

    /// Solves A_FF z = rhs in place.
    fn solve(&mut self, lcp: &Lcp, free: &[usize], rhs: &mut [f64]) {
        match self {
            Factor::Cholesky(factor) => factor.solve(rhs),
            Factor::Envelope(factor) => {
                on_all_rows(lcp.len(), free, rhs, |all| factor.solve(all));
            }
            Factor::Reordered(factor) => {
                on_all_rows(lcp.len(), free, rhs, |all| factor.solve(all));
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

/// Applies `solve` to the vector of n rows that has these values in the free rows and 0 elsewhere.
fn on_all_rows(n: usize, free: &[usize], values: &mut [f64], solve: impl FnOnce(&mut [f64])) {
    let mut all = vec![0.0; n];
    free.iter().zip(&*values).for_each(|(&i, value)| all[i] = *value);
    solve(&mut all);
    values.iter_mut().zip(free).for_each(|(z, &i)| *z = all[i]);
}
