//! Searches for a proof that a problem has no solution.
//!
//! A small residual does not show that a solution exists: far from the origin the terms of a row
//! are large, and a violation looks small compared with them. Therefore, if no exact solution was
//! found near x, the judge searches for a proof that there is none: a vector ([`ray`](super::ray))
//! derived from x, from a solver's ray or from the solution of a linear program, otherwise a [case
//! split](super::cases).
//!
//! If the problem states a [scale](Lcp::scale), errors of w up to tolerance · s_i · scale do not
//! count. A contradiction that such a change of b removes proves nothing then: rows of redundant
//! joints are equal but for rounding, and have no exact solution. The tolerance 0 asks for any
//! contradiction of the problem as it is written.

use super::cases::{Search, Tree, is_excluded, search, search_within};
use super::ray::{Farkas, refute, whole_vector};
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
    /// A proof that no exact solution exists, but a change of b below the tolerance allows one.
    Insignificant(Refutation),
    /// Neither was found.
    Unknown,
}

/// Tries to prove that a problem has no solution, even if each b_i changes by tolerance · s_i ·
/// [scale](Lcp::scale); `hints` are a solver's ray or any other vectors.
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
/// assert!(matches!(refutation(&lcp, &[], 1e-8), Some(Refutation::CaseSplit { .. })));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn refutation(lcp: &Lcp, hints: &[&[f64]], tolerance: f64) -> Option<Refutation> {
    match existence(lcp, hints, tolerance) {
        Existence::None(refutation) => Some(refutation),
        Existence::Solution(_) | Existence::Insignificant(_) | Existence::Unknown => None,
    }
}

/// Tries to prove it by a single vector. Such a proof is valid for every friction model, since the
/// vector is 0 in rows with friction.
///
/// ```
/// use lcplab_judge::refuting_vector;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = −1 for every x.
/// let lcp = Lcp::new(Matrix::from([[0.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// assert!(refuting_vector(&lcp, &[&[1.0]], 1e-8).is_some());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn refuting_vector(lcp: &Lcp, hints: &[&[f64]], tolerance: f64) -> Option<Farkas> {
    vectors(lcp, hints).find(|farkas| farkas.is_significant(tolerance))
}

/// Tries to prove it without cases, also by the limits of friction. Such a proof is valid for every
/// friction model that keeps the friction x_t of a contact within ±μ x_n.
pub(super) fn without_cases(lcp: &Lcp, hints: &[&[f64]], tolerance: f64) -> Option<Refutation> {
    let by_vector = refuting_vector(lcp, hints, tolerance).map(Refutation::Vector);
    by_vector.or_else(|| is_excluded(lcp, tolerance).then_some(Refutation::CaseSplit { pieces: 1 }))
}

/// The proofs by the hints and by a linear program, which is solved only if it is needed.
fn vectors(lcp: &Lcp, hints: &[&[f64]]) -> impl Iterator<Item = Farkas> {
    let is_small = lcp.len() <= MOST_ROWS;
    let by_program = is_small.then_some(lcp).into_iter().filter_map(by_linear_program);
    let hinted = hints.iter().filter_map(|d| refuted_by(lcp, d));
    hinted.chain(by_program.filter_map(|d| refuted_by(lcp, &d)))
}

/// Tries to prove it by this vector, whose rounding is repaired.
///
/// ```
/// use lcplab_judge::refuted_by;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = x₀ − x₁ − 1 and −x₀ + x₁ add up to −1, but both should be at least 0.
/// let a = Matrix::from([[1.0, -1.0], [-1.0, 1.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 0.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// assert!(refuted_by(&lcp, &[1.0, 1.0]).is_some());
/// assert!(refuted_by(&lcp, &[1.0, 0.0]).is_none());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
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
pub(super) fn existence(lcp: &Lcp, hints: &[&[f64]], tolerance: f64) -> Existence {
    let mut insignificant = None;
    for farkas in vectors(lcp, hints) {
        if farkas.is_significant(tolerance) {
            return Existence::None(Refutation::Vector(farkas));
        }
        insignificant = Some(Refutation::Vector(farkas));
    }
    if choices(lcp).is_none_or(|count| count > MOST_CHOICES) {
        return insignificant.map_or(Existence::Unknown, Existence::Insignificant);
    }
    let by_cases = |tree: Tree| Refutation::CaseSplit { pieces: tree.leaves() };
    let exact = match insignificant {
        Some(refutation) => refutation,
        None => match search(lcp, MOST_PROGRAMS) {
            Some(Search::None(tree)) if lcp.scale() == 0.0 => {
                return Existence::None(by_cases(tree));
            }
            Some(Search::None(tree)) => match &tree {
                Tree::Leaf(d) => {
                    whole_vector(lcp, d).map_or_else(|| by_cases(tree), Refutation::Vector)
                }
                Tree::Branch { .. } => by_cases(tree),
            },
            Some(Search::Solution(point)) => return Existence::Solution(point),
            None => return Existence::Unknown,
        },
    };
    match search_within(lcp, tolerance, MOST_PROGRAMS) {
        Some(Search::None(tree)) => Existence::None(by_cases(tree)),
        // Without an answer, a contradiction below the tolerance is possible.
        Some(Search::Solution(_)) | None => Existence::Insignificant(exact),
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
