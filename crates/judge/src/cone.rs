//! Is this x a solution of a friction problem with circular cones?
//!
//! The same judge as for boxed problems: the terms of w in compensated arithmetic, and two scaled
//! residuals a contact, how far its normal and its tangents are from their own projected step, each beside
//! its own terms ([`ConeProblem`]). There is no proof in rational arithmetic, because a disc has irrational
//! points.
//!
//! ```
//! use lcplab_judge::{Demand, judge_cone};
//! use lcplab_problem::friction::{ConeProblem, Contact, FrictionProblem, Law};
//! use lcplab_problem::{Lcp, Matrix};
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
//! # Ok::<(), lcplab_problem::error::Error>(())
//! ```

use super::{Demand, Refusal, Verdict, accurate_terms};
use lcplab_problem::Complementarity;
use lcplab_problem::friction::{ConeProblem, Contact};
use lcplab_problem::merit::RowTerms;

/// Everything the judge found out about x.
#[derive(Debug, Clone, PartialEq)]
pub struct ConeCertificate {
    /// w = A x + b, without shift.
    pub w: Vec<f64>,
    /// The scaled residual of each contact, the larger one of its normal and its tangents.
    pub contact_residuals: Vec<f64>,
    /// The largest scaled residual of contacts and other rows.
    pub scaled_residual: f64,
    /// The row that has it.
    pub worst_row: usize,
    /// The contact that has it, unless it is another row.
    pub worst_contact: Option<usize>,
    /// How far x lies outside the cones: max |x_t| − μ x_n over contacts, or 0.
    pub cone_violation: f64,
    /// The decision: never *proved*.
    pub verdict: Verdict,
}

/// Judges x for a cone problem, under its law.
///
/// # Panics
/// If x has not n entries.
pub fn judge_cone(problem: &ConeProblem, x: &[f64], demand: &Demand) -> ConeCertificate {
    let (lcp, contacts) = (problem.lcp(), problem.friction().contacts());
    assert_eq!(x.len(), lcp.len(), "x needs one entry a row");
    let terms: Vec<_> = (0..x.len()).map(|i| accurate_terms(lcp, i, x)).collect();
    let residuals = problem.residuals(&terms, x);
    let worst = (0..x.len()).max_by(|&i, &j| residuals[i].total_cmp(&residuals[j])).unwrap_or(0);
    let scaled_residual = residuals.iter().copied().fold(0.0, f64::max);
    let worst_contact = contacts.iter().position(|contact| contact.rows.contains(&worst));
    let outside = contacts.iter().map(|contact| {
        let [n, t1, t2] = contact.of(x);
        lcplab_problem::hypot(t1, t2) - contact.mu * n
    });
    let refused = |why| Verdict::NotASolution { row: worst, amount: scaled_residual, why };
    let is_within = x.iter().all(|x| x.is_finite()) && scaled_residual <= demand.tolerance;
    let of_contact = |contact: &Contact| contact.of(&residuals).into_iter().fold(0.0, f64::max);
    ConeCertificate {
        w: terms.iter().map(RowTerms::w).collect(),
        contact_residuals: contacts.iter().map(of_contact).collect(),
        scaled_residual,
        worst_row: worst,
        worst_contact,
        cone_violation: outside.fold(0.0, f64::max),
        verdict: match is_within {
            true if problem.is_worth_something(x, demand.tolerance) => Verdict::WithinTolerance,
            true => refused(Refusal::Worthless),
            false => refused(Refusal::Residual),
        },
    }
}
