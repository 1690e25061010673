//! Searches for a proof that a problem has no solution.
//!
//! A small residual does not show that a solution exists: far from the origin the terms of a row
//! are large, and a violation looks small compared with them. Therefore, if no exact solution was
//! found near x, the judge searches for a proof that there is none: a vector ([`ray`](super::ray))
//! derived from x, from a solver's ray or from the solution of a linear program, otherwise a [case
//! split](super::cases).

use super::cases::{Search, search};
use super::ray::{Farkas, refute};
use lcplab_lcp::Lcp;
use lcplab_lcp::exact::Point;

/// For problems with more rows only the given vectors are tried.
const MOST_ROWS: usize = 150;

/// Problems with more combinations of sides, such as four contacts with friction, are not split
/// into cases.
const MOST_CHOICES: usize = 1 << 16;
/// Limit on the judge's linear programs.
const MOST_PROGRAMS: usize = 500;

/// Why no x solves a problem.
#[derive(Debug, Clone, PartialEq)]
pub enum Refutation {
    /// A vector proves it.
    Vector(Farkas),
    /// A [case split](super::cases) proves it; a vector excludes each case.
    CaseSplit {
        /// The number of cases.
        pieces: usize,
    },
}

/// The result of the search.
pub(super) enum Existence {
    /// A solution.
    Solution(Point),
    /// A proof that no solution exists.
    None(Refutation),
    /// Neither was found.
    Unknown,
}

/// Tries to prove that a problem has no solution; `hints` are a solver's ray or any other vectors.
///
/// ```
/// use lcplab_judge::{Refutation, refutation};
/// use lcplab_lcp::{Coupling, Lcp, Matrix};
///
/// // w_n = x_n − x_t − 1 and w_t = x_t − x_n − ½ with |x_t| ≤ x_n: Painlevé's trouble in two rows.
/// let a = Matrix::dense(2, &[1.0, -1.0, -1.0, 1.0]);
/// let (lo, hi) = (vec![0.0, -f64::INFINITY], vec![f64::INFINITY; 2]);
/// let lcp = Lcp::new(a, vec![-1.0, -0.5], lo, hi)?;
/// let lcp = lcp.with_coupling(Coupling::new(vec![None, Some(0)], vec![0.0, 1.0])?)?;
/// assert!(matches!(refutation(&lcp, &[]), Some(Refutation::CaseSplit { .. })));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn refutation(lcp: &Lcp, hints: &[&[f64]]) -> Option<Refutation> {
    match existence(lcp, hints) {
        Existence::None(refutation) => Some(refutation),
        Existence::Solution(_) | Existence::Unknown => None,
    }
}

/// Tries to prove it by a single vector. Such a proof is valid for every friction model, since the
/// vector is 0 in rows with friction.
pub fn refuting_vector(lcp: &Lcp, hints: &[&[f64]]) -> Option<Farkas> {
    hints.iter().find_map(|d| refuted_by(lcp, d)).or_else(|| {
        let is_small = lcp.len() <= MOST_ROWS;
        is_small.then(|| by_linear_program(lcp)).flatten().and_then(|d| refuted_by(lcp, &d))
    })
}

/// Tries to prove it by this vector, whose rounding is repaired.
pub fn refuted_by(lcp: &Lcp, d: &[f64]) -> Option<Farkas> {
    refute(lcp, largest(lcp, d), d)
}

/// The vector that clarabel finds.
#[cfg(feature = "clarabel")]
use crate::reference::farkas as by_linear_program;

/// Without the feature `clarabel` no linear program is solved.
#[cfg(not(feature = "clarabel"))]
fn by_linear_program(_: &Lcp) -> Option<Vec<f64>> {
    None
}

/// Searches for a proof that there is no solution, or for a solution.
pub(super) fn existence(lcp: &Lcp, hints: &[&[f64]]) -> Existence {
    if let Some(farkas) = refuting_vector(lcp, hints) {
        return Existence::None(Refutation::Vector(farkas));
    }
    if choices(lcp).is_none_or(|count| count > MOST_CHOICES) {
        return Existence::Unknown;
    }
    match search(lcp, MOST_PROGRAMS) {
        Some(Search::Solution(point)) => Existence::Solution(point),
        Some(Search::None(tree)) => {
            Existence::None(Refutation::CaseSplit { pieces: tree.leaves() })
        }
        None => Existence::Unknown,
    }
}

/// The number of combinations of sides: each row at its lower bound, free, or at its upper bound.
fn choices(lcp: &Lcp) -> Option<usize> {
    let sides = |i: usize| match lcp.is_coupled(i) {
        true => 3,
        false => 1 + [lcp.lo()[i], lcp.hi()[i]].iter().filter(|bound| bound.is_finite()).count(),
    };
    (0..lcp.len()).try_fold(1usize, |count, i| count.checked_mul(sides(i)))
}

/// The row with the largest |d_i|, among those that can be part of a proof.
fn largest(lcp: &Lcp, d: &[f64]) -> usize {
    let rows = (0..d.len().min(lcp.len())).filter(|&i| !lcp.is_coupled(i));
    rows.max_by(|&i, &j| d[i].abs().total_cmp(&d[j].abs())).unwrap_or(0)
}
