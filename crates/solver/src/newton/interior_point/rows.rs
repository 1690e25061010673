//! The linear equations of a step, one per row.
//!
//! If rows reach far back but have few entries, as in a network with many loops, an envelope would
//! contain mostly zeros. The rows are then reordered
//! ([`reordered`](crate::linalg::reordered)).

use super::step::StepEquations;
use crate::Status;
use crate::linalg::envelope::Envelope;
use crate::linalg::reordered::Reordered;
use crate::tolerances::MIN_ADDED;
use lcplab_lcp::Lcp;

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
    Reordered(Box<Reordered>),
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
            let factor = Reordered::of(matrix);
            fit(factor.entries())?;
            Factor::Reordered(Box::new(factor))
        };
        Ok(Rows { lcp, diagonal, factor })
    }
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
            Factor::Reordered(factor) => factor.factor(matrix, added, |i| pinned[i]),
        }
    }

    fn solve(&mut self, r: &mut [f64]) {
        match &mut self.factor {
            Factor::Envelope(envelope) => envelope.solve(r),
            Factor::Reordered(factor) => factor.solve(r),
        }
    }
}
