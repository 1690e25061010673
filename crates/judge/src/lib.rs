//! Checks whether x solves a problem. The judge sees the problem and x, never the solver.
//!
//! [`judge`] recomputes everything from (A, b, lo, hi, x) in compensated arithmetic and returns one
//! of three verdicts:
//!
//! - *proved*: x is within tolerance, and bounds on all rounding errors, or rational arithmetic
//!   where they do not suffice ([`exact`]), show that the problem has an exact solution x* at a
//!   stated distance from x;
//! - *within tolerance*: the scaled residual is at most the tolerance, x is at least ten times
//!   closer to a solution than x = 0 projected onto the bounds, and the judge found no proof that
//!   there is no solution ([`refutation`](refutation()));
//! - *not a solution*: a row's residual is above the tolerance, or one of the other two conditions
//!   fails.
//!
//! ```
//! use lcplab_judge::{Verdict, judge, Demand};
//! use lcplab_lcp::{Lcp, Matrix};
//!
//! let a = Matrix::dense(2, &[3.0, 1.0, 1.0, 3.0]);
//! let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
//! let good = judge(&lcp, &[1.0 / 3.0, 0.0], &Demand::default());
//! assert!(matches!(good.verdict, Verdict::Proved { distance } if distance < 2e-17)); // 1/3 rounds
//! let bad = judge(&lcp, &[0.3, 0.0], &Demand::default());
//! assert!(matches!(bad.verdict, Verdict::NotASolution { row: 0, .. }));
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

pub mod cases;
mod certificate;
mod cone;
mod convex;
#[cfg(feature = "clarabel")]
pub mod cross_check;
mod enclosure;
pub mod error_bound;
pub mod exact;
mod friction;
pub mod gap_bound;
mod interval;
mod inverse;
pub mod motion_bound;
mod neighbor;
mod polygon;
pub mod ray;
#[cfg(feature = "clarabel")]
pub mod reference;
mod refutation;
pub mod regularity;
mod residual;
#[cfg(feature = "serde")]
mod serialized;
pub mod uniqueness;
mod verdict;

pub use certificate::{Certificate, Evidence};
pub use cone::{
    ConeCertificate, ConeProof, Dependence, Enclosure, RowState, another_cone_solution,
    cone_body_proof, cone_proof, judge_cone, nearest_cone_proof,
};
pub use friction::{FrictionCertificate, judge_friction};
pub use refutation::{Refutation, refutation, refuted_by, refuting_vector};
pub use verdict::{Refusal, Verdict, printed_up, upper_bound};

use certificate::measure;
use lcplab_lcp::Lcp;
use refutation::{Existence, existence};
use residual::{Residual, Rows, improves_on_zero};

/// What the judge requires of a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// The largest scaled residual that is accepted.
    pub tolerance: f64,
    /// Problems with up to this many rows are checked for an exact solution.
    pub prove_up_to: usize,
}

impl Demand {
    /// Row limit for an exact proof that the user requests; a proof of this size takes seconds.
    pub const EXACT_ROWS: usize = 150;
}

impl Default for Demand {
    fn default() -> Self {
        Demand { tolerance: 1e-8, prove_up_to: 50 }
    }
}

/// A solution farther from x than this fraction of max |x_i| proves nothing about x.
const NEAR: f64 = 1e-6;

/// Judges x for a problem; coupled rows have the bounds they have at this x.
///
/// Before an x above the tolerance is rejected, two more checks can accept it: an exact solution
/// lies within rounding of x, or the judge accepts the rounded neighbor of x, in which entries that
/// differ from a bound or from 0 only by rounding are moved there.
///
/// ```
/// use lcplab_judge::{Demand, judge};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = (2 x_0 − x_1 − 1, 2 x_1 − x_0 + 2): x = (½, 0).
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let verdict = |x: [f64; 2]| judge(&lcp, &x, &Demand::default()).verdict.to_string();
/// assert_eq!(verdict([0.5, 0.0]), "proved: x is an exact solution");
/// assert_eq!(
///     verdict([0.4, 0.0]),
///     "not a solution: scaled residual 0.11 in row 0, above the tolerance 10⁻⁸"
/// );
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Panics
/// If x does not have n entries.
pub fn judge(lcp: &Lcp, x: &[f64], demand: &Demand) -> Certificate {
    assert_eq!(x.len(), lcp.len(), "x needs one entry per row");
    let certificate = judge_as_given(lcp, x, demand);
    if certificate.verdict.is_solution() || !x.iter().all(|x| x.is_finite()) {
        return certificate;
    }
    if let Some(proof) = proof_within_rounding(lcp, x, demand) {
        return Certificate {
            verdict: Verdict::Proved { distance: proof.distance },
            rounded_by: Some(proof.distance),
            evidence: proof.null_direction.map(Evidence::NotUnique),
            ..certificate
        };
    }
    let Some(neighbor) = neighbor::rounded(lcp, &[], x) else { return certificate };
    let of_neighbor = judge_as_given(lcp, &neighbor, demand);
    let moved = distance(x, &neighbor);
    match of_neighbor.verdict.of_point_at(moved) {
        Some(verdict) => {
            let evidence = of_neighbor.evidence;
            Certificate { verdict, rounded_by: Some(moved), evidence, ..certificate }
        }
        None => certificate,
    }
}

/// Judges x itself, without its rounded neighbor.
fn judge_as_given(lcp: &Lcp, x: &[f64], demand: &Demand) -> Certificate {
    let at = Rows::at(lcp, x);
    let residuals = at.residuals();
    let certificate = measure(&at, &residuals, demand.tolerance);
    if x.iter().any(|x| !x.is_finite()) || !(certificate.scaled_residual <= demand.tolerance) {
        return certificate;
    }
    let is_small = lcp.len() <= demand.prove_up_to;
    let within = Certificate { verdict: Verdict::WithinTolerance, ..certificate };
    let enclosed = if is_small { enclosure::distance(&at) } else { None };
    if let Some(distance) = enclosed.filter(|&distance| is_near(x, distance)) {
        return Certificate { verdict: Verdict::Proved { distance }, ..within };
    }
    let nearest = if is_small { exact::nearest_to(lcp, x) } else { None };
    match nearest {
        Some((solution, distance)) if is_near(x, distance) => Certificate {
            verdict: Verdict::Proved { distance },
            evidence: solution.null_direction.map(|d| Evidence::NotUnique(d.entries())),
            ..within
        },
        _ if !improves_on_zero(&residuals, &at_zero(lcp), demand.tolerance) => {
            let (row, amount) = (within.worst_row, within.scaled_residual);
            let verdict = Verdict::NotASolution { row, amount, why: Refusal::NoBetterThanZero };
            Certificate { verdict, ..within }
        }
        // If there is a family of solutions, the distance to one of them says nothing about x.
        Some((exact::ExactSolution { null_direction: Some(_), .. }, _)) => within,
        Some((_, distance)) => {
            Certificate { evidence: Some(Evidence::FarSolution { distance }), ..within }
        }
        None if is_small => searched(&at, within, demand.tolerance),
        None => within,
    }
}

/// The residuals at Π(0), which an answer must improve on.
fn at_zero(lcp: &Lcp) -> Vec<Residual> {
    let mut zero = vec![0.0; lcp.len()];
    lcp.project_all(&mut zero);
    Rows::at(lcp, &zero).residuals()
}

/// An exact solution that differs from x only by rounding: each entry relative to the largest entry
/// of its component.
fn proof_within_rounding(lcp: &Lcp, x: &[f64], demand: &Demand) -> Option<exact::Proof> {
    if lcp.len() > demand.prove_up_to {
        return None;
    }
    let bounds = neighbor::rounding_of(&neighbor::sizes(lcp, &[], x));
    if !may_be_rounding(lcp, x, &bounds) {
        return None;
    }
    exact::prove(lcp, x).filter(|proof| exact::is_within(x, &proof.x, &bounds))
}

/// Whether x can be this close to a solution: only if each x_i is at most as far from its projected
/// step as such changes of x allow. This check avoids an exact proof that must fail.
fn may_be_rounding(lcp: &Lcp, x: &[f64], bounds: &[f64]) -> bool {
    let at = Rows::at(lcp, x);
    (0..x.len()).all(|i| {
        let moved = |j: usize, a: f64| a.abs() * bounds[j];
        let of_w: f64 = lcp.matrix().row(i).iter().map(|(j, a)| moved(j, a)).sum();
        let of_bound = lcp.coupled_to(i).map_or(0.0, |(k, mu)| mu * bounds[k]);
        let scale = at.rows[i].scale.value();
        // Twice, because this is rounded, too.
        let least = 2.0 * (of_w + scale * (bounds[i] + of_bound));
        let size = at.residual(i).step * at.rows[i].scale.sqrt();
        !(size.value() > least)
    })
}

/// max_i |x_i − y_i|, rounded up.
pub(crate) fn distance(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| interval::add_up(x.max(*y), -x.min(*y))).fold(0.0, f64::max)
}

/// The certificate of an x within the tolerance whose active set has no solution, after a search
/// for a solution elsewhere.
fn searched(at: &Rows<'_>, within: Certificate, tolerance: f64) -> Certificate {
    match existence(at.lcp, &[at.x], tolerance) {
        Existence::None(refutation) => within.refuted_by(refutation),
        Existence::Insignificant(refutation) => {
            Certificate { evidence: Some(Evidence::NoExactSolution(refutation)), ..within }
        }
        Existence::Solution(point) => match point.distance(at.x) {
            distance if is_near(at.x, distance) => {
                Certificate { verdict: Verdict::Proved { distance }, ..within }
            }
            // It is one of several solutions, which says nothing about x.
            _ => within,
        },
        Existence::Unknown => within,
    }
}

/// Whether a solution at this distance says something about x.
fn is_near(x: &[f64], distance: f64) -> bool {
    distance <= near(x)
}

/// A solution farther from x than this says nothing about x.
fn near(x: &[f64]) -> f64 {
    NEAR * x.iter().fold(0.0, |most, x| f64::max(most, x.abs()))
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
