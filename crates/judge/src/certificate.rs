//! The judge's full result on x: measured quantities, and what was proved in exact arithmetic.

use std::fmt;

use dashu_ratio::RBig;

use super::{Refutation, Verdict};
use lcplab_lcp::accurate::Sum;
use lcplab_lcp::merit::Sum as _;
use lcplab_lcp::number::readable;

use crate::convex::is_convex;
use crate::residual::{Residual, Rows, worst};

/// The judge's full result on x.
///
/// ```
/// use lcplab_judge::{Demand, judge};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // Two supports share a load of 1: x_0 + x_1 = 1 in many ways.
/// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let certificate = judge(&lcp, &[0.5, 0.5], &Demand::default());
/// let d = certificate.null_direction().expect("force can move between the supports");
/// assert_eq!(-&d[0], d[1]);
/// assert!(certificate.refutation().is_none()); // there is a solution
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Certificate {
    /// w = A x + b.
    pub w: Vec<f64>,
    /// r_i, row by row.
    pub residuals: Vec<f64>,
    /// max_i |x_i − Π(x_i − w_i)|.
    pub natural_residual: f64,
    /// max_i r_i, dimensionless: see [`scaled_residual`](lcplab_lcp::merit::scaled_residual).
    pub scaled_residual: f64,
    /// The row with the largest scaled residual.
    pub worst_row: usize,
    /// The smallest significant size of x: [`Lcp::scale`](lcplab_lcp::Lcp::scale), 0 if the
    /// problem states none.
    pub scale: f64,
    /// max_i of w_i⁺ (x_i − lo_i) and w_i⁻ (hi_i − x_i), over finite bounds.
    pub complementarity_gap: f64,
    /// The largest violation of a bound: max_i of lo_i − x_i and x_i − hi_i, or 0.
    pub bound_violation: f64,
    /// max_i |w_i| over rows where w_i pushes x_i toward an infinite bound: 0 at a solution.
    pub dual_infeasibility: f64,
    /// ½ xᵀAx + bᵀx.
    pub objective: f64,
    /// Objective minus dual objective: Σ_i w_i⁺ (x_i − lo_i) + w_i⁻ (hi_i − x_i), over finite
    /// bounds: an upper bound on the objective's error. A w that pushes x toward infinity by no
    /// more than the tolerance counts as 0: the bound then holds for the problem whose b is smaller
    /// by this w. NaN where there is no bound: A is not symmetric and positive semidefinite, x lies
    /// outside its bounds, a w pushes it toward infinity by more, or no solution exists.
    pub duality_gap: f64,
    /// The verdict.
    pub verdict: Verdict,
    /// Set if x itself is above the tolerance and the verdict is about a point x' that differs from
    /// it by rounding: an exact solution, or the rounded neighbor of x. Then it is max |x − x'|.
    /// The residuals are those of x.
    pub rounded_by: Option<f64>,
    /// Further facts proved in exact arithmetic.
    pub evidence: Option<Evidence>,
}

/// The verdict and the largest scaled residual.
///
/// ```
/// use lcplab_judge::{Demand, judge};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// assert_eq!(
///     judge(&lcp, &[0.5, 0.0], &Demand::default()).to_string(),
///     "proved: x is an exact solution; scaled residual 0"
/// );
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let residual = readable(self.scaled_residual, 3);
        match &self.verdict {
            // It states the residual itself.
            Verdict::NotASolution { .. } => self.verdict.fmt(f),
            verdict => write!(f, "{verdict}; scaled residual {residual}"),
        }
    }
}

/// Facts that exact arithmetic proves in addition to the verdict.
#[derive(Debug, Clone, PartialEq)]
pub enum Evidence {
    /// With the verdict *proved*: a direction in which x* can move while every w stays the same.
    /// Redundant contacts can share a load in many ways.
    NotUnique(Vec<RBig>),
    /// With the verdict *within tolerance*: the active set of x has an exact solution, but too far
    /// from x to prove it.
    FarSolution {
        /// max_i |x_i − x*_i|, rounded up.
        distance: f64,
    },
    /// With the verdict *within tolerance*: the problem has no exact solution, but a change of b
    /// below tolerance · s_i · [scale](Certificate::scale) makes this proof invalid. The rows of
    /// redundant joints, for example, contradict each other in their last digits.
    NoExactSolution(Refutation),
    /// With the verdict *not a solution*: the problem has no solution.
    NoSolution(Refutation),
}

impl Certificate {
    /// The certificate of the same x once it is known that the problem has no solution.
    ///
    /// ```
    /// use lcplab_judge::{Demand, judge, refutation};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // Two equations for x_0 + x_1 that contradict each other. A caller who has a proof of that
    /// // adds it to the certificate.
    /// let free = f64::INFINITY;
    /// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0, -2.0], vec![-free; 2], vec![free; 2])?;
    /// let before = judge(&lcp, &[0.0; 2], &Demand { tolerance: 10.0, prove_up_to: 0 });
    /// let proof = refutation(&lcp, &[], 1e-8).expect("a contradiction");
    /// let after = before.refuted_by(proof.clone());
    /// assert_eq!(after.verdict.to_string(), "not a solution: no solution exists");
    /// assert_eq!(after.refutation(), Some(&proof));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn refuted_by(self, refutation: Refutation) -> Self {
        let verdict = self.verdict.refused(self.worst_row, self.scaled_residual);
        let evidence = Some(Evidence::NoSolution(refutation));
        Certificate { verdict, evidence, rounded_by: None, duality_gap: f64::NAN, ..self }
    }

    /// A direction in which the solution can move while every w stays the same, if one was proved.
    pub fn null_direction(&self) -> Option<&[RBig]> {
        match &self.evidence {
            Some(Evidence::NotUnique(direction)) => Some(direction),
            _ => None,
        }
    }

    /// Why the problem has no solution, if that was proved.
    pub fn refutation(&self) -> Option<&Refutation> {
        self.evidence.as_ref().and_then(Evidence::refutation)
    }
}

impl Evidence {
    pub(crate) fn refutation(&self) -> Option<&Refutation> {
        match self {
            Evidence::NoSolution(refutation) => Some(refutation),
            _ => None,
        }
    }
}

/// The certificate of x before any proof, from its rows and their residuals.
pub(super) fn measure(at: &Rows<'_>, residuals: &[Residual], tolerance: f64) -> Certificate {
    let (lcp, x, all_w) = (at.lcp, at.x, at.w());
    let (worst_row, scaled_residual) = worst(residuals.iter().map(|own| own.relative));
    let mut is_feasible = true;
    let (mut natural, mut gap, mut outside, mut infeasible) = (0.0, 0.0, 0.0, 0.0);
    let (mut objective, mut duality_gap) = (Sum::default(), Sum::default());
    for (i, &w) in all_w.iter().enumerate() {
        let (lo, hi) = lcp.bounds(i, x);
        natural = f64::max(natural, finite_or_infinite(w.min(x[i] - lo).max(x[i] - hi).abs()));
        outside = f64::max(outside, (lo - x[i]).max(x[i] - hi));
        let room = if w > 0.0 { x[i] - lo } else { hi - x[i] };
        is_feasible &= lo <= x[i] && x[i] <= hi;
        is_feasible &= room.is_finite() || residuals[i].relative <= tolerance;
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
        residuals: residuals.iter().map(|own| own.relative).collect(),
        w: all_w,
        natural_residual: natural,
        scaled_residual,
        worst_row,
        scale: lcp.scale(),
        complementarity_gap: gap,
        bound_violation: outside,
        dual_infeasibility: infeasible,
        objective: objective.value(),
        duality_gap: if is_feasible && is_convex(lcp) { duality_gap.value() } else { f64::NAN },
        verdict: Verdict::rejected(x, worst_row, scaled_residual, tolerance),
        rounded_by: None,
        evidence: None,
    }
}

/// Replaces NaN by ∞, the worst residual.
fn finite_or_infinite(residual: f64) -> f64 {
    if residual.is_nan() { f64::INFINITY } else { residual }
}
