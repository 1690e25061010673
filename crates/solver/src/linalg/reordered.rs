//! Sparse Cholesky factors of a large symmetric matrix in a fill-reducing order, by faer.
//!
//! ```text
//! P K Pᵀ = L Lᵀ
//! ```
//!
//! Eliminating a row connects all its neighbors, which fills L; the order P decides how much.
//! Eliminating the row with the fewest neighbors first is cheap and rarely far from the best
//! (*approximate minimum degree*, Amestoy, Davis & Duff 1996). The pattern of L depends only on the
//! pattern of K, not on its values. This *analysis* is done once, followed by any number of numeric
//! factorizations. Columns of L with the same rows are stored together as dense blocks
//! (*supernodes*) if L is large enough.

use std::fmt;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};
use lcplab_lcp::Matrix;

/// The factors of A + diag(added) in minimum degree order, with some rows and columns replaced by
/// those of the identity; or storage for them.
pub struct Reordered {
    /// The lower triangle of A, column by column.
    pattern: SymbolicSparseColMat<usize>,
    symbolic: SymbolicCholesky<usize>,
    lower: Vec<f64>,
    memory: MemBuffer,
}

// faer's working memory has no Debug.
impl fmt::Debug for Reordered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Reordered").field("entries", &self.entries()).finish_non_exhaustive()
    }
}

impl Reordered {
    /// The analysis for a symmetric matrix.
    ///
    /// # Panics
    /// If the factors have more entries than the index type can count.
    pub fn of(matrix: &Matrix) -> Self {
        let n = matrix.len();
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for i in 0..n {
            rows.push(i);
            rows.extend(below(matrix, i).map(|(j, _)| j));
            starts.push(rows.len());
        }
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let (order, place) = minimum_degree(&pattern);
        let symbolic = factorize_symbolic_cholesky(
            pattern.as_ref(),
            Side::Lower,
            SymmetricOrdering::Custom(PermRef::new_checked(&order, &place, n)),
            CholeskySymbolicParams::default(),
        )
        .expect("as many entries as indices can count");
        let numeric = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let memory = numeric.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        Reordered { pattern, symbolic, lower: Vec::new(), memory: MemBuffer::new(memory) }
    }

    /// The number of entries of L.
    pub fn entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// Factorizes A + diag(added) with rows and columns of the identity where `is_unit`; false if a
    /// pivot is not positive.
    pub fn factor(
        &mut self,
        matrix: &Matrix,
        added: &[f64],
        is_unit: impl Fn(usize) -> bool,
    ) -> bool {
        let mut values = Vec::with_capacity((matrix.stored() + matrix.len()) / 2);
        for i in 0..matrix.len() {
            values.push(if is_unit(i) { 1.0 } else { matrix.diagonal(i) + added[i] });
            let off = |(j, a): (usize, f64)| if is_unit(i) || is_unit(j) { 0.0 } else { a };
            values.extend(below(matrix, i).map(off));
        }
        self.lower.resize(self.entries(), 0.0);
        let factors = self.symbolic.factorize_numeric_llt(
            &mut self.lower,
            SparseColMatRef::new(self.pattern.as_ref(), &values),
            Side::Lower,
            // No regularization.
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        factors.is_ok()
    }

    /// Solves with the factors in place.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        let n = rhs.len();
        let rhs = MatMut::from_column_major_slice_mut(rhs, n, 1);
        let stack = MemStack::new(&mut self.memory);
        LltRef::new(&self.symbolic, &self.lower).solve_in_place_with_conj(
            Conj::No,
            rhs,
            Par::Seq,
            stack,
        );
    }
}

/// The rows in approximate minimum degree order, and the place of each row.
fn minimum_degree(pattern: &SymbolicSparseColMat<usize>) -> (Vec<usize>, Vec<usize>) {
    let (n, entries) = (pattern.ncols(), pattern.compute_nnz());
    let (mut order, mut place) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, entries));
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut place, pattern.as_ref(), amd::Control::default(), stack)
        .expect("as many entries as indices can count");
    (order, place)
}

/// Column i of the lower triangle without the diagonal: the entries of row i right of the diagonal.
fn below(matrix: &Matrix, i: usize) -> impl Iterator<Item = (usize, f64)> {
    matrix.row(i).iter().filter(move |&(j, _)| j > i)
}
