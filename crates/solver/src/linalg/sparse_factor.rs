//! The Cholesky factors of a large sparse matrix in an order that keeps them sparse, by faer.
//!
//! ```text
//! P K Pᵀ = L Lᵀ
//! ```
//!
//! Eliminating a row ties all its neighbours together, which fills L; the order P decides how much.
//! Taking the row with the fewest neighbours next is cheap and rarely far from the best
//! (*approximate minimum degree*, Amestoy, Davis & Duff 1996). Where the entries of L will be
//! depends on those of K alone, not on their values: that *analysis* is made once, and numbers
//! follow as often as wanted. Columns of L that have the same rows are kept together as dense
//! blocks (*supernodes*), if L is large enough for that to pay.

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

/// Where the entries of a lower triangle are, column by column.
pub type Pattern = SymbolicSparseColMat<usize>;

/// The factors of a matrix, or before the first factorisation where their entries will be.
pub struct SparseFactor {
    pattern: Pattern,
    symbolic: SymbolicCholesky<usize>,
    lower: Vec<f64>,
    memory: MemBuffer,
}

/// The pattern with these rows in each column: ascending, none above the diagonal.
///
/// # Panics
/// If rows do not ascend or there are as many columns as no matrix has.
pub fn pattern<C: IntoIterator<Item = usize>>(columns: impl IntoIterator<Item = C>) -> Pattern {
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for column in columns {
        rows.extend(column);
        starts.push(rows.len());
    }
    let n = starts.len() - 1;
    Pattern::new_checked(n, n, starts, None, rows)
}

/// The rows in the order of approximate minimum degree.
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
    /// The factors of matrices with entries in these places, rows to be eliminated in this order.
    ///
    /// # Panics
    /// If `order` is no permutation of the rows, or the factors have more entries than indices can
    /// count.
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

    /// The places.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// The number of entries of L.
    pub fn entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// Factorises the matrix with these values in the places of the pattern; false if a pivot is
    /// not positive.
    pub fn factor(&mut self, values: &[f64]) -> bool {
        self.lower.resize(self.entries(), 0.0);
        let factors = self.symbolic.factorize_numeric_llt(
            &mut self.lower,
            SparseColMatRef::new(self.pattern.as_ref(), values),
            Side::Lower,
            LltRegularization::default(), // none
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        factors.is_ok()
    }

    /// The solution z of K z = rhs, in place, once K has been factorised.
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
