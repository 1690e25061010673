//! Is this x a solution of a friction problem under one of the models?
//!
//! Each model has the certificate of what it becomes. Boxes: that of boxed LCPs, *proved* where
//! possible. Polygons: the same, for the unknowns z that x leads to ([`Polyhedral::z`]), so x is
//! judged and not what a solver says of z; *proved* with four corners only, since the directions of more
//! are rounded numbers. Cones: [`judge_cone`], never *proved*.
//!
//! ```
//! use lcplab_judge::{Demand, judge_friction};
//! use lcplab_problem::file::Problem;
//! use lcplab_problem::friction::Model;
//!
//! let text = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, 0],
//!                "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5]}"#;
//! let friction = Problem::parse(text, "push.json")?.friction().expect("friction rows")?;
//! let accepts = |model: Model, x: [f64; 3]| {
//!     let certificate = judge_friction(&model.pose(&friction, None)?, &x, &Demand::default());
//!     lcplab_problem::error::Result::Ok(certificate.verdict.is_solution())
//! };
//! assert!(accepts(Model::CoulombCone, [2.0, 1.0, 0.0])?);
//! assert!(accepts(Model::Polyhedral { directions: 8 }, [2.0, 1.0, 0.0])?);
//! assert!(!accepts(Model::AssociatedCone, [2.0, 1.0, 0.0])?); // that one lifts off: (2.8, 1.4, 0)
//! # Ok::<(), lcplab_problem::error::Error>(())
//! ```

use super::interval::{Interval, add_up, mul_up};
use super::{
    Certificate, Demand, Evidence, Refusal, Refutation, Verdict, accurate_terms, is_near, judge,
    judge_cone,
};
use lcplab_problem::friction::{Polyhedral, Posed};
use lcplab_problem::merit::RowTerms;

/// What the judge found out about x.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionCertificate {
    /// w = A x + b of the friction problem.
    pub w: Vec<f64>,
    /// The largest scaled residual of the model's own problem.
    pub scaled_residual: f64,
    /// The row of x that has it, t1 for a β and n for a γ of a polygon.
    pub worst_row: usize,
    /// The decision; its row is one of x, t1 for a β and n for a γ of a polygon.
    pub verdict: Verdict,
    /// What else was shown in exact arithmetic, of boxes and of polygons with four corners: of these in their own unknowns.
    pub evidence: Option<Evidence>,
}

impl FrictionCertificate {
    /// The same x as the answer to a problem that has no solution.
    pub fn refuted_by(self, refutation: Refutation) -> Self {
        let verdict = self.verdict.refused(self.worst_row, self.scaled_residual);
        FrictionCertificate { verdict, evidence: Some(Evidence::NoSolution(refutation)), ..self }
    }

    /// Why the problem has no solution, if that was shown.
    pub fn refutation(&self) -> Option<&Refutation> {
        self.evidence.as_ref().and_then(Evidence::refutation)
    }
}

impl From<Certificate> for FrictionCertificate {
    fn from(certificate: Certificate) -> Self {
        let Certificate { w, scaled_residual, worst_row, verdict, evidence, .. } = certificate;
        FrictionCertificate { w, scaled_residual, worst_row, verdict, evidence }
    }
}

/// Judges x under a model.
///
/// # Panics
/// If x has not an entry a row.
pub fn judge_friction(problem: &Posed, x: &[f64], demand: &Demand) -> FrictionCertificate {
    match problem {
        Posed::Boxed(lcp) => judge(lcp, x, demand).into(),
        Posed::Polyhedral(polyhedral) => judge_polyhedral(polyhedral, x, demand),
        Posed::Cone(cone) => {
            let certificate = judge_cone(cone, x, demand);
            FrictionCertificate {
                w: certificate.w,
                scaled_residual: certificate.scaled_residual,
                worst_row: certificate.worst_row,
                verdict: certificate.verdict,
                evidence: None,
            }
        }
    }
}

/// The verdict on z, and what z does not show of x: friction without a cause, and how far an
/// exact solution is from x itself.
fn judge_polyhedral(polyhedral: &Polyhedral, x: &[f64], demand: &Demand) -> FrictionCertificate {
    let lcp = polyhedral.friction().lcp();
    let terms: Vec<_> = (0..x.len()).map(|i| accurate_terms(lcp, i, x)).collect();
    let w = terms.iter().map(RowTerms::w).collect();
    let z = polyhedral.z(x);
    let certificate = judge(polyhedral.lcp(), &z, demand);
    let smooth = of_smooth(polyhedral, &terms, x);
    let is_exact = polyhedral.directions() == 4 && smooth.1 == 0.0;
    let (row, stray) = worst([smooth, polyhedral.rubbing(&z, accurate_terms)].into_iter());
    let verdict = match certificate.verdict {
        _ if !(stray <= demand.tolerance) => {
            Verdict::NotASolution { row, amount: stray, why: Refusal::Residual }
        }
        Verdict::NotASolution { row, amount, why } => {
            Verdict::NotASolution { row: polyhedral.row(row), amount, why }
        }
        Verdict::Proved { distance } if is_exact => {
            match distance_from(polyhedral, x, &z, distance) {
                distance if is_near(x, distance) => Verdict::Proved { distance },
                _ => Verdict::WithinTolerance, // near beside z alone, where slips are larger than impulses
            }
        }
        Verdict::Proved { .. } | Verdict::WithinTolerance => Verdict::WithinTolerance,
    };
    let (worst_row, scaled_residual) = match certificate.scaled_residual {
        residual if residual >= stray => (polyhedral.row(certificate.worst_row), residual),
        _ => (row, stray),
    };
    FrictionCertificate { w, scaled_residual, worst_row, verdict, evidence: None }
}

/// The residual of an x_t where there is no friction, which z does not hold: the worst with its row of x.
fn of_smooth(polyhedral: &Polyhedral, terms: &[RowTerms], x: &[f64]) -> (usize, f64) {
    let smooth = polyhedral.friction().contacts().iter().filter(|contact| contact.mu == 0.0);
    let tangents = smooth.flat_map(|contact| [contact.rows[1], contact.rows[2]]);
    let miss = |i: usize| terms[i].miss_between(x[i], 0.0, 0.0, || f64::INFINITY);
    worst(tangents.map(|i| (i, miss(i).residual)))
}

fn worst(residuals: impl Iterator<Item = (usize, f64)>) -> (usize, f64) {
    residuals.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
}

/// How far the impulses of an exact z* are from x at most, |z − z*| being at most `distance`: each of
/// the two components of x_t is a difference of two β, and x is not quite D β.
fn distance_from(polyhedral: &Polyhedral, x: &[f64], z: &[f64], distance: f64) -> f64 {
    let back = polyhedral.x(z);
    let gap = |(x, back): (&f64, &f64)| Interval::from(*x) - Interval::from(*back);
    let gap = x.iter().zip(&back).map(gap).map(Interval::magnitude).fold(0.0, f64::max);
    add_up(mul_up(2.0, distance), gap)
}
