//! The linear equations of a step, one per row.
//!
//! If rows reach far back but have few entries, as in a network with many loops, an envelope would
//! contain mostly zeros. The rows are then reordered
//! ([`sparse_factor`](crate::linalg::sparse_factor)).

use super::step::StepEquations;
use crate::Status;
use crate::linalg::envelope::Envelope;
use crate::linalg::sparse_factor::{SparseFactor, minimum_degree, pattern};
use crate::tolerances::MIN_ADDED;
use lcplab_lcp::{Lcp, Matrix};

/// An envelope may have at most this many times the entries of A's lower triangle.
const SPARSE: usize = 6;

/// A + D and its factors.
pub(super) struct Rows<'a> {
    lcp: &'a Lcp,
    diagonal: Vec<f64>,
    factor: Factor,
}

enum Factor {
    /// Rows in their given order.
    Envelope(Envelope),
    /// Rows in a fill-reducing order.
    Reordered(Box<SparseFactor>),
}

impl<'a> Rows<'a> {
    /// Storage for the factors, if their entries fit.
    pub(super) fn of(
        lcp: &'a Lcp,
        diagonal: Vec<f64>,
        fit: impl Fn(usize) -> Result<(), Status>,
    ) -> Result<Self, Status> {
        let matrix = lcp.matrix();
        let (entries, lower) = (Envelope::entries(matrix), (matrix.stored() + matrix.len()) / 2);
        let factor = if entries <= SPARSE * lower {
            fit(entries)?;
            Factor::Envelope(Envelope::of(matrix))
        } else {
            let factor = reordered(matrix);
            fit(factor.entries())?;
            Factor::Reordered(Box::new(factor))
        };
        Ok(Rows { lcp, diagonal, factor })
    }
}

/// The factors of matrices with this pattern, in minimum degree order.
fn reordered(matrix: &Matrix) -> SparseFactor {
    let column = |i: usize| std::iter::once(i).chain(below(matrix, i).map(|(j, _)| j));
    let places = pattern((0..matrix.len()).map(column));
    let order = minimum_degree(&places);
    SparseFactor::of(places, &order)
}

/// Column i of the lower triangle without the diagonal: the entries of row i right of the diagonal.
fn below(matrix: &Matrix, i: usize) -> impl Iterator<Item = (usize, f64)> {
    matrix.row(i).iter().filter(move |&(j, _)| j > i)
}

impl StepEquations for Rows<'_> {
    const UNBOUNDED: f64 = MIN_ADDED;

    fn diagonal(&self, i: usize) -> f64 {
        self.diagonal[i]
    }

    fn w(&self, x: &[f64]) -> Vec<f64> {
        self.lcp.w(x)
    }

    fn factor(&mut self, added: &[f64], pinned: &[bool]) -> bool {
        let matrix = self.lcp.matrix();
        match &mut self.factor {
            Factor::Envelope(envelope) => envelope.factor(matrix, added, |i| pinned[i]).is_ok(),
            Factor::Reordered(factor) => factor.factor(&lower_triangle(matrix, added, pinned)),
        }
    }

    fn solve(&mut self, r: &mut [f64]) {
        match &mut self.factor {
            Factor::Envelope(envelope) => envelope.solve(r),
            Factor::Reordered(factor) => factor.solve(r),
        }
    }
}

/// The lower triangle of A + diag(added) by columns, with columns of the identity where x is
/// pinned.
fn lower_triangle(matrix: &Matrix, added: &[f64], pinned: &[bool]) -> Vec<f64> {
    let mut values = Vec::with_capacity((matrix.stored() + matrix.len()) / 2);
    for i in 0..matrix.len() {
        values.push(if pinned[i] { 1.0 } else { matrix.diagonal(i) + added[i] });
        let off = |(j, a): (usize, f64)| if pinned[i] || pinned[j] { 0.0 } else { a };
        values.extend(below(matrix, i).map(off));
    }
    values
}
