//! The factorization L D Lᵀ of a sparse matrix in envelope storage: each row from its first entry
//! to the diagonal.
//!
//! ```text
//! l_rq d_q = a_rq − Σ_k l_rk d_k l_qk,   d_r = a_rr − Σ_q l_rq d_q l_rq,   k from where both rows begin
//! ```
//!
//! Row r of L begins in the same column as row r of A (George & Liu 1981: the *envelope* of A), so
//! each row is stored contiguously and every sum runs over two contiguous ranges. For contacts
//! numbered along a stack or chain, the envelope is hardly larger than A, and the cost for n rows
//! of b entries is n b²/2; a dense A is its own envelope. Rows are not reordered.

use lcplab_lcp::{Matrix, dot};

/// The factors, or storage for them before the first factorization.
#[derive(Debug, Clone)]
pub struct Envelope {
    /// The column in which each row begins.
    first: Vec<usize>,
    /// The offset of row r of L in `lower`; the row has r − first_r entries, without the unit
    /// diagonal.
    starts: Vec<usize>,
    lower: Vec<f64>,
    diagonal: Vec<f64>,
}

impl Envelope {
    /// Storage for the factors of a symmetric matrix.
    pub fn of(matrix: &Matrix) -> Self {
        let n = matrix.len();
        let first: Vec<usize> = (0..n).map(|r| begin(matrix, r)).collect();
        let mut starts = vec![0];
        for r in 0..n {
            starts.push(starts[r] + r - first[r]);
        }
        let lower = vec![0.0; starts[n]];
        Envelope { first, starts, lower, diagonal: vec![0.0; n] }
    }

    /// The number of entries of the factors below the diagonal.
    pub fn entries(matrix: &Matrix) -> usize {
        (0..matrix.len()).map(|r| r - begin(matrix, r)).sum()
    }

    /// Computes the factors of A + diag(added), with rows and columns of the identity where
    /// `is_unit`.
    ///
    /// # Errors
    /// The first row whose pivot is not positive.
    pub fn factor(
        &mut self,
        matrix: &Matrix,
        added: &[f64],
        is_unit: impl Fn(usize) -> bool,
    ) -> Result<(), usize> {
        for r in 0..self.diagonal.len() {
            let first = self.first[r];
            let (before, rest) = self.lower.split_at_mut(self.starts[r]);
            let row = &mut rest[..r - first];
            row.fill(0.0);
            let mut pivot = if is_unit(r) { 1.0 } else { added[r] };
            if !is_unit(r) {
                for (c, a) in matrix.row(r).iter().take_while(|&(c, _)| c <= r) {
                    match c {
                        c if c == r => pivot += a,
                        c if a != 0.0 && !is_unit(c) => row[c - first] = a,
                        _ => {}
                    }
                }
                for q in first..r {
                    let begin = first.max(self.first[q]);
                    let other = &before[self.starts[q]..self.starts[q + 1]];
                    let sum = dot(&row[begin - first..q - first], &other[begin - self.first[q]..]);
                    // l_rq d_q
                    row[q - first] -= sum;
                }
                for (l, d) in row.iter_mut().zip(&self.diagonal[first..]) {
                    let scaled = *l;
                    *l /= d;
                    pivot -= scaled * *l;
                }
            }
            if !(pivot > 0.0) {
                return Err(r);
            }
            self.diagonal[r] = pivot;
        }
        Ok(())
    }

    /// D, the pivots.
    pub fn pivots(&self) -> &[f64] {
        &self.diagonal
    }

    /// Solves L D Lᵀ z = rhs in place.
    pub fn solve(&self, rhs: &mut [f64]) {
        let row = |r: usize| (self.first[r], &self.lower[self.starts[r]..self.starts[r + 1]]);
        for r in 0..rhs.len() {
            let (first, l) = row(r);
            // rhs ← L⁻¹ rhs.
            rhs[r] -= dot(l, &rhs[first..r]);
        }
        for (z, d) in rhs.iter_mut().zip(&self.diagonal) {
            *z /= d;
        }
        for r in (0..rhs.len()).rev() {
            let (first, l) = row(r);
            let z = rhs[r];
            for (rhs, l) in rhs[first..r].iter_mut().zip(l) {
                // rhs ← L⁻ᵀ rhs, by rows of L.
                *rhs -= l * z;
            }
        }
    }
}

/// The column of the first nonzero entry of row r, at most r.
fn begin(matrix: &Matrix, r: usize) -> usize {
    let nonzero = matrix.row(r).iter().find(|&(_, a)| a != 0.0);
    nonzero.map_or(r, |(column, _)| column.min(r))
}
