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

pub use cone::{ConeCertificate, judge_cone};
pub use friction::{FrictionCertificate, judge_friction};
pub use refutation::{Refutation, refutation, refuting_vector};

use dashu_ratio::RBig;

use lcplab_problem::Lcp;
use lcplab_problem::accurate::Sum;
use lcplab_problem::merit::{self, RowTerms, Sum as _};
use refutation::{Existence, existence};

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

/// A solution farther from x than this part of max |x_i| proves nothing of x.
const NEAR: f64 = 1e-6;

/// The judge's word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// An exact solution was shown to exist this far from x (max norm, in the unit of x), at most 1e-6
    /// of the largest entry of x.
    Proved {
        /// max_i |x_i − x*_i|, rounded up.
        distance: f64,
    },
    /// The scaled residual is at most the tolerance, x is worth something, and nothing was found that
    /// speaks against a solution.
    WithinTolerance,
    /// x is not a solution.
    NotASolution {
        /// The row with the largest scaled residual.
        row: usize,
        /// That residual.
        amount: f64,
        /// Why x is refused.
        why: Refusal,
    },
}

/// Why x is no solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// The residual is above the tolerance.
    Residual,
    /// The residual is small beside the terms of a far away x, and that is all: x is no nearer to a
    /// solution than Π(0).
    Worthless,
    /// The problem has no solution.
    Impossible,
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

    /// The verdict once it is known that the problem has no solution: an x that misses already is
    /// refused for that.
    fn refused(self, row: usize, amount: f64) -> Verdict {
        let why = match self {
            Verdict::NotASolution { why: Refusal::Residual, .. } => Refusal::Residual,
            _ => Refusal::Impossible,
        };
        Verdict::NotASolution { row, amount, why }
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
                let distance = upper_bound(*distance);
                write!(f, "proved: an exact solution lies within {distance} of x")
            }
            Verdict::WithinTolerance => write!(f, "within tolerance"),
            Verdict::NotASolution { row, amount, why: Refusal::Residual } => {
                write!(f, "not a solution: row {row} misses by {amount:.1e} of its terms")
            }
            Verdict::NotASolution { why: Refusal::Worthless, .. } => {
                write!(
                    f,
                    "not a solution: x is no nearer to one than zero is, only its terms are large"
                )
            }
            Verdict::NotASolution { why: Refusal::Impossible, .. } => {
                write!(f, "not a solution: the problem has none")
            }
        }
    }
}

/// A bound with two digits, rounded up as a bound must be: 1.04e-9 is `1.1e-9`.
///
/// ```
/// use lcplab_judge::upper_bound;
///
/// assert_eq!(upper_bound(1.04e-9), "1.1e-9");
/// assert_eq!(upper_bound(9.96e3), "1.0e4");
/// assert_eq!(upper_bound(0.25), "2.5e-1"); // exact
/// assert_eq!(upper_bound(f64::from_bits(1)), "5.0e-324"); // 4.94…e-324
/// ```
pub fn upper_bound(bound: f64) -> String {
    if bound == 0.0 || !bound.is_finite() {
        return format!("{bound:.1e}");
    }
    let all = format!("{bound:.800e}"); // every digit that a number has
    let (digits, exponent) = all.split_once('e').expect("an exponent");
    let (two, rest) = digits.split_at(3);
    let exponent: i32 = exponent.parse().expect("a whole number");
    let tens: u32 = two.replace('.', "").parse().expect("two digits");
    let is_exact = rest.bytes().all(|digit| digit == b'0');
    match tens + u32::from(!is_exact) {
        100 => format!("1.0e{}", exponent + 1),
        tens => format!("{}.{}e{exponent}", tens / 10, tens % 10),
    }
}

/// A number that is at least the bound, also where its shortest decimal form is read exactly.
pub fn printed_up(bound: f64) -> f64 {
    let (shown, all) = (format!("{bound:e}"), format!("{bound:.800e}"));
    let parts = |text: &str| {
        let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let digits: String = digits.chars().filter(char::is_ascii_digit).collect();
        (exponent.parse::<i32>().unwrap_or(0), format!("{digits:0<801}"))
    };
    if bound > 0.0 && bound.is_finite() && parts(&shown) < parts(&all) {
        bound.next_up()
    } else {
        bound
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
    /// [`RowTerms::scaled_residual`](lcplab_problem::merit::RowTerms::scaled_residual).
    pub scaled_residual: f64,
    /// The row that has it.
    pub worst_row: usize,
    /// The size of x below which a row is at rest: [`Lcp::scale`], 0 if the problem states none.
    pub scale: f64,
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
    /// What else was shown in exact arithmetic.
    pub evidence: Option<Evidence>,
}

/// What exact arithmetic shows beside the verdict.
#[derive(Debug, Clone, PartialEq)]
pub enum Evidence {
    /// With the verdict *proved*: a direction in which x* can be moved without moving any w. Redundant
    /// contacts share a load in many ways.
    NotUnique(Vec<RBig>),
    /// With the verdict *within tolerance*: the active set of x carries an exact solution, but so far
    /// from x that it is no proof of it.
    FarSolution {
        /// max_i |x_i − x*_i|, rounded up.
        distance: f64,
    },
    /// With the verdict *not a solution*: no x is one.
    NoSolution(Refutation),
}

impl Certificate {
    /// The same x as the answer to a problem that has no solution.
    pub fn refuted_by(self, refutation: Refutation) -> Self {
        let verdict = self.verdict.refused(self.worst_row, self.scaled_residual);
        Certificate { verdict, evidence: Some(Evidence::NoSolution(refutation)), ..self }
    }

    /// The direction in which the solution can be moved without moving any w, if one was shown.
    pub fn null_direction(&self) -> Option<&[RBig]> {
        match &self.evidence {
            Some(Evidence::NotUnique(direction)) => Some(direction),
            _ => None,
        }
    }

    /// Why the problem has no solution, if that was shown.
    pub fn refutation(&self) -> Option<&Refutation> {
        self.evidence.as_ref().and_then(Evidence::refutation)
    }
}

impl Evidence {
    fn refutation(&self) -> Option<&Refutation> {
        match self {
            Evidence::NoSolution(refutation) => Some(refutation),
            _ => None,
        }
    }
}

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

fn measure(lcp: &Lcp, x: &[f64], terms: &[RowTerms]) -> Certificate {
    let (mut worst_row, mut scaled_residual) = (0, 0.0);
    let (mut natural, mut gap, mut outside, mut infeasible) = (0.0, 0.0, 0.0, 0.0);
    let (mut objective, mut duality_gap) = (Sum::default(), Sum::default());
    for (i, row) in terms.iter().enumerate() {
        let ((lo, hi), w) = (lcp.bounds(i, x), row.w());
        let residual = row.scaled_residual(lcp, i, x);
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
        scale: lcp.scale(),
        complementarity_gap: gap,
        bound_violation: outside,
        dual_infeasibility: infeasible,
        objective: objective.value(),
        duality_gap: duality_gap.value(),
        verdict: Verdict::NotASolution {
            row: worst_row,
            amount: scaled_residual,
            why: Refusal::Residual,
        },
        evidence: None,
    }
}

/// NaN is as bad as a residual can be.
fn finite_or_infinite(residual: f64) -> f64 {
    if residual.is_nan() { f64::INFINITY } else { residual }
}
