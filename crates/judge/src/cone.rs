//! Checks whether x solves a friction problem with circular cones.
//!
//! The judge works as for boxed problems: it sums the terms of w in compensated arithmetic and
//! computes two scaled residuals for each contact, the distances of its normal and of its tangents
//! from their projected steps, each relative to its own terms ([`ConeProblem`]). Exact arithmetic
//! proves solutions ([`cone_proof`]): a rational point if no contact slides, otherwise a box that
//! contains the solution, because the friction of a sliding contact is in general irrational.
//!
//! ```
//! use lcplab_judge::{Demand, judge_cone};
//! use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
//! use lcplab_lcp::{Lcp, Matrix};
//!
//! // A unit mass slides along t1: pressed with 2 N s, pushed with 3 N s, μ = ½.
//! let a = Matrix::dense(3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
//! let (lo, hi) = (vec![0.0, -f64::INFINITY, -f64::INFINITY], vec![f64::INFINITY; 3]);
//! let lcp = Lcp::new(a, vec![-2.0, -3.0, 0.0], lo, hi)?;
//! let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
//! let coulomb = ConeProblem::new(problem, Law::Coulomb);
//!
//! // Full friction against the slip w_t1 = 1 − 3 = −2 m/s.
//! let good = judge_cone(&coulomb, &[2.0, 1.0, 0.0], &Demand::default());
//! assert!(good.verdict.is_solution());
//! // Half of it.
//! let bad = judge_cone(&coulomb, &[2.0, 0.5, 0.0], &Demand::default());
//! assert_eq!((bad.verdict.is_solution(), bad.worst_contact), (false, Some(0)));
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod another;
mod definition;
mod enclosure;
mod inside;
mod newton;
mod proof;
mod redundant;
mod state;
mod system;

pub use another::another_cone_solution;
pub use enclosure::Enclosure;
pub use proof::{ConeProof, cone_body_proof, cone_proof};
pub use redundant::Dependence;
pub use state::RowState;

use super::neighbor;
use super::residual::{Residual, cone, improves_on_zero};
use super::{Demand, Refusal, Verdict, near};
use lcplab_lcp::Complementarity;
use lcplab_lcp::friction::{ConeProblem, Contact};

/// The judge's full result on x.
#[derive(Debug, Clone, PartialEq)]
pub struct ConeCertificate {
    /// w = A x + b, without shift.
    pub w: Vec<f64>,
    /// The scaled residual of each row; both tangents of a contact have that of their plane.
    pub residuals: Vec<f64>,
    /// The scaled residual of each contact, the larger one of its normal and its tangents.
    pub contact_residuals: Vec<f64>,
    /// The largest scaled residual of contacts and other rows.
    pub scaled_residual: f64,
    /// The row with the largest scaled residual.
    pub worst_row: usize,
    /// The contact with the largest scaled residual; `None` if another row has it.
    pub worst_contact: Option<usize>,
    /// The largest violation of a cone: max |x_t| − μ x_n over contacts, or 0.
    pub cone_violation: f64,
    /// The verdict.
    pub verdict: Verdict,
    /// As in [`Certificate::rounded_by`](super::Certificate::rounded_by).
    pub rounded_by: Option<f64>,
}

/// Judges x for a cone problem under its law. An x that is off only by rounding is accepted as in
/// [`judge`](super::judge()).
///
/// ```
/// use lcplab_judge::{Demand, judge_cone};
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // A point of 1 kg on the ground slides along t1: w = x + b.
/// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let cone = ConeProblem::new(problem, Law::Coulomb);
/// // Twice the friction that the cone allows: it stops the point.
/// let certificate = judge_cone(&cone, &[2.0, 2.0, 0.0], &Demand::default());
/// assert_eq!((certificate.worst_contact, certificate.cone_violation), (Some(0), 1.0));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Panics
/// If x does not have n entries.
pub fn judge_cone(problem: &ConeProblem, x: &[f64], demand: &Demand) -> ConeCertificate {
    let (lcp, contacts) = (problem.lcp(), problem.friction().contacts());
    assert_eq!(x.len(), lcp.len(), "x needs one entry per row");
    let certificate = judge_as_given(problem, x, demand);
    if certificate.verdict.is_solution() || !x.iter().all(|x| x.is_finite()) {
        return certificate;
    }
    if lcp.len() <= demand.prove_up_to {
        let bounds = neighbor::rounding_of(&neighbor::sizes(lcp, contacts, x));
        if let Some(proof) = cone_proof(problem, x, Some(&bounds)) {
            let distance = proof.distance(x);
            let (verdict, rounded_by) = (Verdict::Proved { distance }, Some(distance));
            return ConeCertificate { verdict, rounded_by, ..certificate };
        }
    }
    let judged = |x: &[f64]| judge_as_given(problem, x, demand).verdict;
    match neighbor::verdict(lcp, contacts, x, judged) {
        Some((verdict, moved)) => {
            ConeCertificate { verdict, rounded_by: Some(moved), ..certificate }
        }
        None => certificate,
    }
}

/// The exact solution that [`judge_cone`] finds near x, otherwise one at any distance.
///
/// ```
/// use lcplab_judge::nearest_cone_proof;
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // A unit mass is pressed with 2 N s and rests: x = (2, 0, 0).
/// let a = Matrix::dense(3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
/// let (lo, hi) = (vec![0.0, -f64::INFINITY, -f64::INFINITY], vec![f64::INFINITY; 3]);
/// let lcp = Lcp::new(a, vec![-2.0, 0.0, 0.0], lo, hi)?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let problem = ConeProblem::new(problem, Law::Coulomb);
/// let proof = nearest_cone_proof(&problem, &[1.0, 0.0, 0.0]).expect("a solution");
/// assert_eq!(proof.distance(&[1.0, 0.0, 0.0]), 1.0);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn nearest_cone_proof(problem: &ConeProblem, x: &[f64]) -> Option<ConeProof> {
    let (lcp, contacts) = (problem.lcp(), problem.friction().contacts());
    let (near, sizes) = (vec![near(x); x.len()], neighbor::sizes(lcp, contacts, x));
    cone_proof(problem, x, Some(&near))
        .or_else(|| cone_proof(problem, x, Some(&neighbor::rounding_of(&sizes))))
        .or_else(|| cone_proof(problem, &neighbor::rounded(lcp, contacts, x)?, Some(&near)))
        .or_else(|| cone_proof(problem, x, None))
}

/// Judges x itself, without its rounded neighbor.
fn judge_as_given(problem: &ConeProblem, x: &[f64], demand: &Demand) -> ConeCertificate {
    let contacts = problem.friction().contacts();
    let (w, all) = cone::residuals(problem, x);
    let residuals: Vec<f64> = all.iter().map(|own| own.relative).collect();
    let (worst_row, scaled_residual) = last_worst(&residuals);
    let outside = contacts.iter().map(|contact| {
        let [n, t1, t2] = contact.of(x);
        lcplab_lcp::hypot(t1, t2) - contact.mu * n
    });
    let of_contact = |contact: &Contact| contact.of(&residuals).into_iter().fold(0.0, f64::max);
    ConeCertificate {
        w,
        contact_residuals: contacts.iter().map(of_contact).collect(),
        residuals,
        scaled_residual,
        worst_row,
        worst_contact: contacts.iter().position(|contact| contact.rows.contains(&worst_row)),
        cone_violation: outside.fold(0.0, f64::max),
        verdict: verdict(problem, x, &all, (worst_row, scaled_residual), demand),
        rounded_by: None,
    }
}

/// The last row with the largest residual, and that residual. Both tangents of a contact have the
/// residual of their plane; this returns t2.
fn last_worst(residuals: &[f64]) -> (usize, f64) {
    let larger =
        |best: (usize, f64), (i, &r): (usize, &f64)| if r >= best.1 { (i, r) } else { best };
    residuals.iter().enumerate().fold((0, 0.0), larger)
}

fn verdict(
    problem: &ConeProblem,
    x: &[f64],
    residuals: &[Residual],
    (row, amount): (usize, f64),
    demand: &Demand,
) -> Verdict {
    if !x.iter().all(|x| x.is_finite()) || !(amount <= demand.tolerance) {
        return Verdict::rejected(x, row, amount, demand.tolerance);
    }
    if x.len() <= demand.prove_up_to
        && let Some(proof) = cone_proof(problem, x, Some(&vec![near(x); x.len()]))
    {
        return Verdict::Proved { distance: proof.distance(x) };
    }
    let mut zero = vec![0.0; x.len()];
    problem.project_all(&mut zero);
    match improves_on_zero(residuals, &cone::residuals(problem, &zero).1, demand.tolerance) {
        true => Verdict::WithinTolerance,
        false => Verdict::NotASolution { row, amount, why: Refusal::NoBetterThanZero },
    }
}
