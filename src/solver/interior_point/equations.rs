//! The linear equations of a step, and their solution by rows.

use crate::lcp::{Lcp, Matrix};
use crate::solver::envelope::Envelope;
use crate::solver::sparse_factor::{SparseFactor, minimum_degree, pattern};

/// Rows are reordered where an envelope would have so many times the entries of A's lower triangle.
const SPARSE: usize = 6;

/// (A + D) dx = r with a positive diagonal D, in a form in which they can be solved; a unit row stands for
/// each x that is pinned.
pub(super) trait Equations {
    /// D is at least this part of A's diagonal.
    const LEAST: f64;

    /// a_ii, 1 where x_i is pinned and A has none.
    fn diagonal(&self, i: usize) -> f64;

    /// w = A x + b.
    fn w(&self, x: &[f64]) -> Vec<f64>;

    /// Factorises the equations with this D; false if a pivot is not positive.
    fn factor(&mut self, added: &[f64], pinned: &[bool]) -> bool;

    /// r ← dx; r is 0 where x is pinned.
    fn solve(&mut self, r: &mut [f64]);
}

/// A + D as it stands, one equation a row.
pub(super) struct Rows<'a> {
    lcp: &'a Lcp,
    diagonal: Vec<f64>,
    factor: Factor,
}

enum Factor {
    /// Rows in the order they come.
    Envelope(Envelope),
    /// Rows in an order of their own.
    Reordered(SparseFactor),
}

impl<'a> Rows<'a> {
    /// The factors have at least so many entries, and just so many where rows stay in their order.
    pub(super) fn least_entries(lcp: &Lcp) -> usize {
        Envelope::entries(lcp.matrix()).min(lcp.matrix().stored() / 2)
    }

    /// Room for the factors; `None` if they have more entries than `most`.
    pub(super) fn of(lcp: &'a Lcp, diagonal: Vec<f64>, most: usize) -> Option<Self> {
        let matrix = lcp.matrix();
        let enough = SPARSE * (matrix.stored() + matrix.len()) / 2;
        let factor = match Envelope::of(matrix, most.min(enough)) {
            Some(envelope) => Factor::Envelope(envelope),
            None => Factor::Reordered(reordered(matrix, most)?),
        };
        Some(Rows { lcp, diagonal, factor })
    }
}

/// Room for the factors in the order of minimum degree.
fn reordered(matrix: &Matrix, most: usize) -> Option<SparseFactor> {
    let below = |i: usize| matrix.row(i).iter().map(|(j, _)| j).filter(move |&j| j > i);
    let places = pattern((0..matrix.len()).map(|i| std::iter::once(i).chain(below(i))));
    let order = minimum_degree(&places);
    SparseFactor::of(places, &order, most)
}

impl Equations for Rows<'_> {
    const LEAST: f64 = 1e-12;

    fn diagonal(&self, i: usize) -> f64 {
        self.diagonal[i]
    }

    fn w(&self, x: &[f64]) -> Vec<f64> {
        self.lcp.w(x)
    }

    fn factor(&mut self, added: &[f64], pinned: &[bool]) -> bool {
        let matrix = self.lcp.matrix();
        match &mut self.factor {
            Factor::Envelope(envelope) => envelope.factor(matrix, added, |i| pinned[i]),
            Factor::Reordered(factor) => {
                let mut values = Vec::with_capacity(factor.pattern().compute_nnz());
                for i in 0..matrix.len() {
                    let diagonal = if pinned[i] { 1.0 } else { matrix.diagonal(i) + added[i] };
                    let below = matrix.row(i).iter().filter(|&(j, _)| j > i);
                    values.push(diagonal);
                    values.extend(below.map(|(j, a)| if pinned[i] || pinned[j] { 0.0 } else { a }));
                }
                factor.factor(&values)
            }
        }
    }

    fn solve(&mut self, r: &mut [f64]) {
        match &mut self.factor {
            Factor::Envelope(envelope) => envelope.solve(r),
            Factor::Reordered(factor) => factor.solve(r),
        }
    }
}
