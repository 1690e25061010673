//! Checks whether x solves a friction problem under one of the models.
//!
//! Boxes are judged as any LCP ([`judge`](super::judge())) and *proved* where possible. For
//! polygons the judge computes the unknowns β and γ that belong to x; it proves answers for four
//! corners only, because the directions of other polygons are rounded numbers. Cones are judged by
//! [`judge_cone`], which proves sliding contacts, too.
//!
//! ```
//! use lcplab_judge::{Demand, judge_friction};
//! use lcplab_lcp::file::Problem;
//! use lcplab_lcp::friction::Model;
//!
//! let text = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, 0],
//!                "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5]}"#;
//! let friction = Problem::parse(text, "push.json")?.friction().expect("friction rows")?;
//! let accepts = |model: Model, x: [f64; 3]| {
//!     let certificate = judge_friction(&model.pose(&friction, None)?, &x, &Demand::default());
//!     lcplab_lcp::error::Result::Ok(certificate.verdict.is_solution())
//! };
//! assert!(accepts(Model::CoulombCone, [2.0, 1.0, 0.0])?);
//! assert!(accepts(Model::Polyhedral { directions: 8 }, [2.0, 1.0, 0.0])?);
//! assert!(!accepts(Model::AssociatedCone, [2.0, 1.0, 0.0])?); // that one lifts off: (2.8, 1.4, 0)
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

use super::polygon::judge_polygon;
use super::refutation::without_cases;
use super::{Certificate, Demand, Evidence, Refutation, Verdict, judge, judge_cone};
use lcplab_lcp::friction::ProblemForm;

/// The judge's result on x.
///
/// ```
/// use lcplab_judge::{Demand, judge_friction, refutation};
/// use lcplab_lcp::friction::ProblemForm;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = −1 for every x. A caller who has a proof of that adds it to the certificate.
/// let lcp = Lcp::new(Matrix::from([[0.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let proof = refutation(&lcp, &[], 1e-8).expect("a proof");
/// let certificate = judge_friction(&ProblemForm::Boxed(lcp), &[1.0], &Demand::default());
/// assert_eq!(certificate.refutation(), None);
/// let certificate = certificate.refuted_by(proof.clone());
/// assert_eq!(certificate.refutation(), Some(&proof));
/// assert!(!certificate.verdict.is_solution());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionCertificate {
    /// w = A x + b of the friction problem.
    pub w: Vec<f64>,
    /// The scaled residual of each row of x in the model's own problem. For polygons, t1 has the
    /// residual of its β and n that of γ.
    pub residuals: Vec<f64>,
    /// The largest scaled residual of the model's own problem.
    pub scaled_residual: f64,
    /// The row of x with the largest scaled residual; for polygons t1 stands for a β and n for a γ.
    pub worst_row: usize,
    /// The verdict; its row is a row of x, for polygons t1 for a β and n for a γ.
    pub verdict: Verdict,
    /// As in [`Certificate::rounded_by`]; the residuals are those of x.
    pub rounded_by: Option<f64>,
    /// Exact evidence for boxes, or a proof that a polygonal problem has no solution.
    pub evidence: Option<Evidence>,
}

impl FrictionCertificate {
    /// The certificate of the same x once it is known that the problem has no solution.
    pub fn refuted_by(self, refutation: Refutation) -> Self {
        let verdict = self.verdict.refused(self.worst_row, self.scaled_residual);
        let evidence = Some(Evidence::NoSolution(refutation));
        FrictionCertificate { verdict, evidence, rounded_by: None, ..self }
    }

    /// Why the problem has no solution, if that was proved.
    pub fn refutation(&self) -> Option<&Refutation> {
        self.evidence.as_ref().and_then(Evidence::refutation)
    }
}

impl From<Certificate> for FrictionCertificate {
    fn from(certificate: Certificate) -> Self {
        let Certificate {
            w,
            residuals,
            scaled_residual,
            worst_row,
            verdict,
            rounded_by,
            evidence,
            ..
        } = certificate;
        FrictionCertificate {
            w,
            residuals,
            scaled_residual,
            worst_row,
            verdict,
            rounded_by,
            evidence,
        }
    }
}

/// Judges x under a model.
///
/// ```
/// use lcplab_judge::{Demand, judge_friction};
/// use lcplab_lcp::friction::{Contact, FrictionProblem, Model};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // A point of 1 kg on the ground slides along t1: w = x + b.
/// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let posed = Model::CoulombCone.pose(&problem, None)?;
/// assert!(judge_friction(&posed, &[2.0, 1.0, 0.0], &Demand::default()).verdict.is_solution());
/// let without_friction = judge_friction(&posed, &[2.0, 0.0, 0.0], &Demand::default());
/// assert!(!without_friction.verdict.is_solution());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Panics
/// If x does not have one entry per row.
pub fn judge_friction(problem: &ProblemForm, x: &[f64], demand: &Demand) -> FrictionCertificate {
    match problem {
        ProblemForm::Boxed(lcp) => judge(lcp, x, demand).into(),
        ProblemForm::Polyhedral(polyhedral) => judge_polygon(polyhedral, x, demand),
        ProblemForm::Cone(cone) => {
            let certificate = judge_cone(cone, x, demand);
            let certificate = FrictionCertificate {
                w: certificate.w,
                residuals: certificate.residuals,
                scaled_residual: certificate.scaled_residual,
                worst_row: certificate.worst_row,
                verdict: certificate.verdict,
                rounded_by: certificate.rounded_by,
                evidence: None,
            };
            let is_unproved = certificate.verdict == Verdict::WithinTolerance;
            let found = (is_unproved && x.len() <= demand.prove_up_to)
                .then(|| without_cases(&cone.friction().coupled_box(), &[x], demand.tolerance));
            match found.flatten() {
                Some(refutation) => certificate.refuted_by(refutation),
                None => certificate,
            }
        }
    }
}
