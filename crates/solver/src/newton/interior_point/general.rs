//! The linear equations of a step if A is not symmetric, by sparse LU factors of faer.
//!
//! The equations have a unique solution if A is monotone, xᵀA x ≥ 0 for all x, because D is
//! positive. The conditions of a convex quadratic program with constraints are such a problem:
//!
//! ```text
//! ( P  −Cᵀ ) ( y )   (  q )
//! ( C   0  ) ( λ ) + ( −d ) = w     min ½ yᵀP y + qᵀy  with  C y ≥ d
//! ```
//!
//! Its diagonal may be 0, so the size of a row is that of the residual test: |a_ii|, or the largest
//! |a_ij| if a_ii is 0, or 1 for a row of zeros.

use faer::MatMut;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, Triplet};

use super::step::StepEquations;
use crate::Status;
use crate::tolerances::MONOTONE_ADDED_DIAGONAL;
use lcplab_lcp::{Lcp, merit};

/// A + D and its factors.
pub(super) struct General<'a> {
    lcp: &'a Lcp,
    sizes: Vec<f64>,
    /// The analysis of the pattern, after the first factorization.
    symbolic: Option<SymbolicLu<usize>>,
    factors: Option<Lu<usize, f64>>,
}

impl<'a> General<'a> {
    /// The equations of this problem, if the factors of a dense matrix would fit.
    pub(super) fn of(
        lcp: &'a Lcp,
        fit: impl Fn(usize) -> Result<(), Status>,
    ) -> Result<Self, Status> {
        fit(lcp.len().saturating_mul(lcp.len()))?;
        let size = |i: usize| match merit::row_scale(lcp, i) {
            0.0 => 1.0,
            size => size,
        };
        let sizes = (0..lcp.len()).map(size).collect();
        Ok(General { lcp, sizes, symbolic: None, factors: None })
    }

    /// A + diag(added), with rows and columns of the identity where x is pinned.
    fn matrix(&self, added: &[f64], pinned: &[bool]) -> Option<SparseColMat<usize, f64>> {
        let (matrix, n) = (self.lcp.matrix(), self.lcp.len());
        let mut entries = Vec::with_capacity(matrix.stored() + n);
        for i in 0..n {
            let diagonal = if pinned[i] { 1.0 } else { matrix.diagonal(i) + added[i] };
            entries.push(Triplet::new(i, i, diagonal));
            let off = matrix.row(i).iter().filter(|&(j, _)| j != i);
            entries.extend(
                off.map(|(j, a)| Triplet::new(i, j, if pinned[i] || pinned[j] { 0.0 } else { a })),
            );
        }
        SparseColMat::try_new_from_triplets(n, n, &entries).ok()
    }

    fn factors(&mut self, added: &[f64], pinned: &[bool]) -> Option<Lu<usize, f64>> {
        let matrix = self.matrix(added, pinned)?;
        if self.symbolic.is_none() {
            self.symbolic = SymbolicLu::try_new(matrix.symbolic()).ok();
        }
        Lu::try_new_with_symbolic(self.symbolic.clone()?, matrix.as_ref()).ok()
    }
}

impl StepEquations for General<'_> {
    const UNBOUNDED: f64 = MONOTONE_ADDED_DIAGONAL;
    const REFINES: bool = true;

    fn diagonal(&self, i: usize) -> f64 {
        self.sizes[i]
    }

    fn w(&self, x: &[f64]) -> Vec<f64> {
        self.lcp.w(x)
    }

    fn factor(&mut self, added: &[f64], pinned: &[bool]) -> bool {
        self.factors = self.factors(added, pinned);
        self.factors.is_some()
    }

    fn solve(&mut self, r: &mut [f64]) {
        let n = r.len();
        if let Some(factors) = &self.factors {
            factors.solve_in_place(MatMut::from_column_major_slice_mut(r, n, 1));
        }
    }
}
