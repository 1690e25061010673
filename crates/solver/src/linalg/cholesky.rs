//! The factorization A_FF = L Lᵀ of a principal submatrix, by blocks (with faer).
//!
//! The submatrix is gathered once and scaled by powers of two so that its diagonal lies between 1
//! and 4; units therefore change no bit of L. A pivot below 1e-13 of its diagonal entry counts as
//! zero; A_FF is then singular or not positive semidefinite.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt;
use faer::{MatMut, MatRef, Par};

use crate::pivot::active_set::unit;
use crate::tolerances::RELATIVE_ZERO;
use lcplab_lcp::Lcp;

/// The last factor, with storage for the next.
#[derive(Debug, Clone, Default)]
pub struct Cholesky {
    unit: Vec<f64>,
    /// L by columns, f² entries; those above the diagonal are unused.
    lower: Vec<f64>,
}

impl Cholesky {
    /// Factorizes the submatrix of these rows (ascending); reads only entries on and right of the
    /// diagonal.
    ///
    /// # Errors
    /// The first row whose pivot is zero or negative; there is then no factor.
    pub fn factor(&mut self, lcp: &Lcp, rows: &[usize]) -> Result<(), usize> {
        let f = rows.len();
        self.unit.clear();
        self.unit.extend(rows.iter().map(|&i| unit(lcp, i)));
        let diagonal = self.gather(lcp, rows);
        let lower = MatMut::from_column_major_slice_mut(&mut self.lower, f, f);
        let need = llt::factor::cholesky_in_place_scratch::<f64>(f, Par::Seq, Default::default());
        let mut memory = MemBuffer::new(need);
        let stack = MemStack::new(&mut memory);
        let (none, default) = (Default::default(), Default::default());
        let refused = llt::factor::cholesky_in_place(lower, none, Par::Seq, stack, default).err();
        let refused =
            refused.map(|llt::factor::LltError::NonPositivePivot { index }| index.min(f - 1));
        let is_zero = |&k: &usize| {
            let pivot = self.lower[k * (f + 1)].powi(2);
            !(pivot > RELATIVE_ZERO * diagonal[k])
        };
        // Rounding can leave a zero pivot slightly positive, so that faer rejects only a later one.
        let zero = (0..refused.unwrap_or(f)).find(is_zero).or(refused);
        zero.map_or(Ok(()), |k| Err(rows[k]))
    }

    /// Reads the entries on and right of the diagonal of A as columns; returns the diagonal.
    fn gather(&mut self, lcp: &Lcp, rows: &[usize]) -> Vec<f64> {
        let f = rows.len();
        self.lower.resize(f * f, 0.0);
        let inverse: Vec<f64> = self.unit.iter().map(|unit| unit.recip()).collect();
        for (c, &j) in rows.iter().enumerate() {
            let column = &mut self.lower[c * f + c..(c + 1) * f];
            lcp.matrix().row(j).gather(&rows[c..], column);
            for (entry, scale) in column.iter_mut().zip(&inverse[c..]) {
                *entry *= scale * inverse[c];
            }
        }
        (0..f).map(|k| self.lower[k * (f + 1)]).collect()
    }

    /// Solves A_FF z = rhs in place.
    pub fn solve(&self, rhs: &mut [f64]) {
        let f = self.unit.len();
        rhs.iter_mut().zip(&self.unit).for_each(|(z, unit)| *z /= unit);
        let lower = MatRef::from_column_major_slice(&self.lower, f, f);
        let z = MatMut::from_column_major_slice_mut(rhs, f, 1);
        llt::solve::solve_in_place(lower, z, Par::Seq, MemStack::new(&mut []));
        rhs.iter_mut().zip(&self.unit).for_each(|(z, unit)| *z /= unit);
    }
}
