//! Sparse Cholesky factors of a large matrix in a fill-reducing order, by faer.
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

/// The pattern of a lower triangle, column by column.
pub type Pattern = SymbolicSparseColMat<usize>;

/// The factors of a matrix, or only their pattern before the first factorization.
pub struct SparseFactor {
    pattern: Pattern,
    symbolic: SymbolicCholesky<usize>,
    lower: Vec<f64>,
    memory: MemBuffer,
}

// faer's working memory has no Debug.
impl fmt::Debug for SparseFactor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SparseFactor").field("entries", &self.entries()).finish_non_exhaustive()
    }
}

/// The pattern with these rows in each column: ascending, none above the diagonal.
///
/// # Panics
/// If rows do not ascend or there are more columns than a matrix can have.
pub fn pattern<C: IntoIterator<Item = usize>>(columns: impl IntoIterator<Item = C>) -> Pattern {
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for column in columns {
        rows.extend(column);
        starts.push(rows.len());
    }
    let n = starts.len() - 1;
    Pattern::new_checked(n, n, starts, None, rows)
}

/// The rows in approximate minimum degree order.
pub fn minimum_degree(pattern: &Pattern) -> Vec<usize> {
    let (n, entries) = (pattern.ncols(), pattern.compute_nnz());
    let (mut order, mut place) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, entries));
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut place, pattern.as_ref(), amd::Control::default(), stack)
        .expect("as many entries as indices can count");
    order
}

impl SparseFactor {
    /// The analysis for matrices with this pattern, with rows eliminated in this order.
    ///
    /// # Panics
    /// If `order` is not a permutation of the rows, or the factors have more entries than the index
    /// type can count.
    pub fn of(pattern: Pattern, order: &[usize]) -> Self {
        let n = pattern.ncols();
        let mut place = vec![0; n];
        order.iter().enumerate().for_each(|(k, &row)| place[row] = k);
        let symbolic = factorize_symbolic_cholesky(
            pattern.as_ref(),
            Side::Lower,
            SymmetricOrdering::Custom(PermRef::new_checked(order, &place, n)),
            CholeskySymbolicParams::default(),
        )
        .expect("as many entries as indices can count");
        let numeric = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let memory = numeric.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        SparseFactor { pattern, symbolic, lower: Vec::new(), memory: MemBuffer::new(memory) }
    }

    /// The pattern of the matrix.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// The number of entries of L.
    pub fn entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// Factorizes the matrix with these values in the order of the pattern; false if a pivot is not
    /// positive.
    pub fn factor(&mut self, values: &[f64]) -> bool {
        self.lower.resize(self.entries(), 0.0);
        let factors = self.symbolic.factorize_numeric_llt(
            &mut self.lower,
            SparseColMatRef::new(self.pattern.as_ref(), values),
            Side::Lower,
            // No regularization.
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        factors.is_ok()
    }

    /// Solves K z = rhs in place; K must have been factorized.
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
