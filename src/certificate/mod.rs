//! Is this x a solution? The judge sees the problem and x, never the solver.
//!
//! [`judge`] recomputes everything from (A, b, lo, hi, x) in compensated arithmetic and decides:
//!
//! - *proved*: within tolerance, and the active set of x was shown in exact rational arithmetic to
//!   carry a solution x*, at a stated distance from x ([`exact`]);
//! - *within tolerance*: the scaled residual is at most the tolerance;
//! - *not a solution*: row i misses by so much.
//!
//! ```
//! use lcplab::certificate::{Verdict, judge, Demand};
//! use lcplab::lcp::{Lcp, Matrix};
//!
//! let a = Matrix::dense(2, &[3.0, 1.0, 1.0, 3.0]);
//! let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
//! let good = judge(&lcp, &[1.0 / 3.0, 0.0], &Demand::default());
//! assert!(matches!(good.verdict, Verdict::Proved { distance } if distance < 2e-17)); // 1/3 rounds
//! let bad = judge(&lcp, &[0.3, 0.0], &Demand::default());
//! assert!(matches!(bad.verdict, Verdict::NotASolution { row: 0, .. }));
//! # Ok::<(), lcplab::error::Error>(())
//! ```

mod cone;
pub mod cross_check;
pub mod error_bound;
pub mod exact;
mod friction;
mod interval;
mod modular;
pub mod motion_bound;
pub mod ray;
pub mod regularity;
pub mod uniqueness;

pub use cone::{ConeCertificate, judge_cone};
pub use friction::{FrictionCertificate, judge_friction};

use crate::lcp::accurate::Sum;
use dashu_ratio::RBig;

use crate::lcp::Lcp;
use crate::lcp::merit::{RowTerms, Sum as _};

/// What the judge asks of a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// The largest scaled residual that passes.
    pub tolerance: f64,
    /// Problems of up to this many rows are proved exactly.
    pub prove_up_to: usize,
}

impl Default for Demand {
    fn default() -> Self {
        Demand { tolerance: 1e-8, prove_up_to: 50 }
    }
}

/// The judge's word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// An exact solution was shown to exist with x's active set, this far from x (max norm, in the
    /// unit of x).
    Proved {
        /// max_i |x_i − x*_i|, rounded up.
        distance: f64,
    },
    /// The scaled residual is at most the tolerance.
    WithinTolerance,
    /// x is not a solution.
    NotASolution {
        /// The row with the largest scaled residual.
        row: usize,
        /// That residual.
        amount: f64,
    },
}

impl Verdict {
    /// Whether x counts as a solution.
    pub fn is_solution(&self) -> bool {
        !matches!(self, Verdict::NotASolution { .. })
    }

    /// How far an exact solution lies from x at most, where one was proved.
    pub fn distance(&self) -> Option<f64> {
        match self {
            Verdict::Proved { distance } => Some(*distance),
            _ => None,
        }
    }

    /// The word used in JSON, tables and plots.
    pub fn word(&self) -> &'static str {
        match self {
            Verdict::Proved { .. } => "proved",
            Verdict::WithinTolerance => "within_tolerance",
            Verdict::NotASolution { .. } => "not_a_solution",
        }
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Verdict::Proved { distance } => {
                write!(f, "proved: an exact solution lies within {distance:.1e} of x")
            }
            Verdict::WithinTolerance => write!(f, "within tolerance"),
            Verdict::NotASolution { row, amount } => {
                write!(f, "not a solution: row {row} misses by {amount:.1e} of its terms")
            }
        }
    }
}

/// Everything the judge found out about x.
#[derive(Debug, Clone, PartialEq)]
pub struct Certificate {
    /// w = A x + b.
    pub w: Vec<f64>,
    /// max_i |x_i − Π(x_i − w_i)|.
    pub natural_residual: f64,
    /// max_i r_i, dimensionless: see
    /// [`RowTerms::scaled_residual`](crate::lcp::merit::RowTerms::scaled_residual).
    pub scaled_residual: f64,
    /// The row that has it.
    pub worst_row: usize,
    /// max_i of w_i⁺ (x_i − lo_i) and w_i⁻ (hi_i − x_i), over finite bounds.
    pub complementarity_gap: f64,
    /// How far x lies outside its bounds: max_i of lo_i − x_i and x_i − hi_i, or 0.
    pub bound_violation: f64,
    /// max_i |w_i| where it pushes x_i towards an infinite bound: 0 at a solution.
    pub dual_infeasibility: f64,
    /// ½ xᵀAx + bᵀx.
    pub objective: f64,
    /// Objective minus dual objective: Σ_i w_i⁺ (x_i − lo_i) + w_i⁻ (hi_i − x_i), over finite
    /// bounds. With A symmetric semidefinite and no infeasibility it bounds the objective's error.
    pub duality_gap: f64,
    /// The decision.
    pub verdict: Verdict,
    /// With the verdict *proved*: an exact direction in which x can be moved without moving any w,
    /// if there is one. Redundant contacts share a load in many ways.
    pub null_direction: Option<Vec<RBig>>,
}

/// Judges x for a problem; coupled rows have the bounds they have at this x.
///
/// # Panics
/// If x has not n entries.
pub fn judge(lcp: &Lcp, x: &[f64], demand: &Demand) -> Certificate {
    assert_eq!(x.len(), lcp.len(), "x needs one entry a row");
    let lcp = &lcp.frozen_at(x);
    let terms: Vec<RowTerms> = (0..lcp.len()).map(|i| accurate_terms(lcp, i, x)).collect();
    let mut certificate = measure(lcp, x, &terms);
    if x.iter().all(|x| x.is_finite()) && certificate.scaled_residual <= demand.tolerance {
        certificate.verdict = Verdict::WithinTolerance;
        if lcp.len() <= demand.prove_up_to
            && let Some(proof) = exact::prove(lcp, x, &certificate.w)
        {
            certificate.verdict = Verdict::Proved { distance: proof.distance };
            certificate.null_direction = proof.null_direction;
        }
    }
    certificate
}

/// The terms of row i in compensated arithmetic.
fn accurate_terms(lcp: &Lcp, i: usize, x: &[f64]) -> RowTerms {
    RowTerms::summed::<Sum>(lcp, i, x)
}

fn measure(lcp: &Lcp, x: &[f64], terms: &[RowTerms]) -> Certificate {
    let (mut worst_row, mut scaled_residual) = (0, 0.0);
    let (mut natural, mut gap, mut outside, mut infeasible) = (0.0, 0.0, 0.0, 0.0);
    let (mut objective, mut duality_gap) = (Sum::default(), Sum::default());
    for (i, row) in terms.iter().enumerate() {
        let (lo, hi, w) = (lcp.lo()[i], lcp.hi()[i], row.w());
        let residual = finite_or_infinite(row.scaled_residual(x[i], lo, hi));
        if residual > scaled_residual {
            (worst_row, scaled_residual) = (i, residual);
        }
        natural = f64::max(natural, finite_or_infinite(w.min(x[i] - lo).max(x[i] - hi).abs()));
        outside = f64::max(outside, (lo - x[i]).max(x[i] - hi));
        let room = if w > 0.0 { x[i] - lo } else { hi - x[i] };
        if room.is_infinite() {
            infeasible = f64::max(infeasible, w.abs());
        } else {
            gap = f64::max(gap, w.abs() * room);
            duality_gap.add_product(w.abs(), room);
        }
        objective.add_product(0.5 * x[i], w);
        objective.add_product(0.5 * x[i], lcp.b()[i]);
    }
    Certificate {
        w: terms.iter().map(RowTerms::w).collect(),
        natural_residual: natural,
        scaled_residual,
        worst_row,
        complementarity_gap: gap,
        bound_violation: outside,
        dual_infeasibility: infeasible,
        objective: objective.value(),
        duality_gap: duality_gap.value(),
        verdict: Verdict::NotASolution { row: worst_row, amount: scaled_residual },
        null_direction: None,
    }
}

/// NaN is as bad as a residual can be.
fn finite_or_infinite(residual: f64) -> f64 {
    if residual.is_nan() { f64::INFINITY } else { residual }
}
