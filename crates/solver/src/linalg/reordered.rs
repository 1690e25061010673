//! Sparse factors of a symmetric matrix with some rows replaced by rows of the identity, in a
//! fill-reducing order.

use super::sparse_factor::{SparseFactor, minimum_degree, pattern};
use lcplab_lcp::Matrix;

/// The factors of A + diag(added) in minimum degree order, or storage for them.
#[derive(Debug)]
pub struct Reordered(SparseFactor);

impl Reordered {
    /// The analysis for a symmetric matrix.
    pub fn of(matrix: &Matrix) -> Self {
        let column = |i: usize| std::iter::once(i).chain(below(matrix, i).map(|(j, _)| j));
        let places = pattern((0..matrix.len()).map(column));
        let order = minimum_degree(&places);
        Reordered(SparseFactor::of(places, &order))
    }

    /// The number of entries of the factors.
    pub fn entries(&self) -> usize {
        self.0.entries()
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
        self.0.factor(&values)
    }

    /// Solves with the factors in place.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.0.solve(rhs);
    }
}

/// Column i of the lower triangle without the diagonal: the entries of row i right of the diagonal.
fn below(matrix: &Matrix, i: usize) -> impl Iterator<Item = (usize, f64)> {
    matrix.row(i).iter().filter(move |&(j, _)| j > i)
}
