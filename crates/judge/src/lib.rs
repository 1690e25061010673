//! Is this x a solution? The judge sees the problem and x, never the solver.
//!
//! [`judge`] recomputes everything from (A, b, lo, hi, x) in compensated arithmetic and decides:
//!
//! - *proved*: within tolerance, and x was shown in exact rational arithmetic to have a solution x* of the
//!   problem as it was posed beside it, at a stated distance ([`exact`]);
//! - *within tolerance*: the scaled residual is at most the tolerance, x is worth something (nearer to a
//!   solution than doing nothing, by a factor of ten), and no proof was found that there is no solution
//!   ([`refutation`](refutation()));
//! - *not a solution*: row i misses by so much, or one of the other two.
//!
//! ```
//! use lcplab_judge::{Verdict, judge, Demand};
//! use lcplab_problem::{Lcp, Matrix};
//!
//! let a = Matrix::dense(2, &[3.0, 1.0, 1.0, 3.0]);
//! let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
//! let good = judge(&lcp, &[1.0 / 3.0, 0.0], &Demand::default());
//! assert!(matches!(good.verdict, Verdict::Proved { distance } if distance < 2e-17)); // 1/3 rounds
//! let bad = judge(&lcp, &[0.3, 0.0], &Demand::default());
//! assert!(matches!(bad.verdict, Verdict::NotASolution { row: 0, .. }));
//! # Ok::<(), lcplab_problem::error::Error>(())
//! ```

mod certificate;
mod cone;
#[cfg(feature = "clarabel")]
pub mod cross_check;
pub mod error_bound;
pub mod exact;
mod friction;
mod interval;
pub mod motion_bound;
pub mod ray;
#[cfg(feature = "clarabel")]
pub mod reference;
mod refutation;
pub mod regularity;
pub mod uniqueness;
mod verdict;

pub use certificate::{Certificate, Evidence};
pub use cone::{ConeCertificate, judge_cone};
pub use friction::{FrictionCertificate, judge_friction};
pub use refutation::{Refutation, refutation, refuting_vector};
pub use verdict::{Refusal, Verdict, printed_up, upper_bound};

use certificate::measure;
use lcplab_problem::Lcp;
use lcplab_problem::accurate::Sum;
use lcplab_problem::merit::{self, RowTerms};
use refutation::{Existence, existence};

/// What the judge asks of a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// The largest scaled residual that passes.
    pub tolerance: f64,
    /// Problems of up to this many rows are proved exactly.
    pub prove_up_to: usize,
}

impl Demand {
    /// A proof of so many rows takes seconds: what a user waits for who asks for one.
    pub const EXACT_ROWS: usize = 150;
}

impl Default for Demand {
    fn default() -> Self {
        Demand { tolerance: 1e-8, prove_up_to: 50 }
    }
}

/// A solution farther from x than this part of max |x_i| proves nothing of x.
const NEAR: f64 = 1e-6;

/// Judges x for a problem; coupled rows have the bounds they have at this x.
///
/// # Panics
/// If x has not n entries.
pub fn judge(lcp: &Lcp, x: &[f64], demand: &Demand) -> Certificate {
    assert_eq!(x.len(), lcp.len(), "x needs one entry a row");
    let terms: Vec<RowTerms> = (0..lcp.len()).map(|i| accurate_terms(lcp, i, x)).collect();
    let certificate = measure(lcp, x, &terms);
    if x.iter().any(|x| !x.is_finite()) || !(certificate.scaled_residual <= demand.tolerance) {
        return certificate;
    }
    let is_small = lcp.len() <= demand.prove_up_to;
    let proof = if is_small { exact::prove(lcp, x, &certificate.w) } else { None };
    let within = Certificate { verdict: Verdict::WithinTolerance, ..certificate };
    match proof {
        Some(proof) if is_near(x, proof.distance) => Certificate {
            verdict: Verdict::Proved { distance: proof.distance },
            evidence: proof.null_direction.map(Evidence::NotUnique),
            ..within
        },
        _ if !merit::is_worth_something(lcp, x, demand.tolerance) => {
            let (row, amount) = (within.worst_row, within.scaled_residual);
            let verdict = Verdict::NotASolution { row, amount, why: Refusal::Worthless };
            Certificate { verdict, ..within }
        }
        Some(exact::Proof { distance, .. }) => {
            Certificate { evidence: Some(Evidence::FarSolution { distance }), ..within }
        }
        None if is_small => searched(lcp, x, within),
        None => within,
    }
}

/// The certificate of an x within the tolerance whose active set carries no solution, after a search for
/// one elsewhere.
fn searched(lcp: &Lcp, x: &[f64], within: Certificate) -> Certificate {
    let sides = exact::sides(lcp, x, &within.w);
    match existence(lcp, &[x], Some(&sides)) {
        Existence::None(refutation) => within.refuted_by(refutation),
        Existence::Solution(point) => match point.distance(x) {
            distance if is_near(x, distance) => {
                Certificate { verdict: Verdict::Proved { distance }, ..within }
            }
            _ => within,
        },
        Existence::Unknown => within,
    }
}

/// Whether a solution at this distance says something of x.
fn is_near(x: &[f64], distance: f64) -> bool {
    distance <= NEAR * x.iter().fold(0.0, |most, x| f64::max(most, x.abs()))
}

/// The terms of row i in compensated arithmetic.
fn accurate_terms(lcp: &Lcp, i: usize, x: &[f64]) -> RowTerms {
    RowTerms::summed::<Sum>(lcp, i, x)
}
