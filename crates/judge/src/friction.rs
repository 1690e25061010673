//! Is this x a solution of a friction problem under one of the models?
//!
//! Each model has the certificate of what it becomes. Boxes: that of boxed LCPs, *proved* where
//! possible. Polygons: the same, for the unknowns z that x leads to ([`Polyhedral::z`]), so x is
//! judged and not what a solver says of z; *proved* with four corners only, since the directions of more
//! are rounded numbers. Cones: [`judge_cone`], *proved* only where no contact slides.
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
use super::neighbor;
use super::residual::polygon::friction_residual;
use super::residual::{Rows, Wide};
use super::{
    Certificate, Demand, Evidence, Refusal, Refutation, Verdict, distance, is_near, judge,
    judge_cone,
};
use lcplab_problem::friction::{Polyhedral, Posed};

/// What the judge found out about x.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionCertificate {
    /// w = A x + b of the friction problem.
    pub w: Vec<f64>,
    /// The scaled residual of each row of x in the model's own problem: for polygons t1 has those
    /// of its β, n that of γ.
    pub residuals: Vec<f64>,
    /// The largest scaled residual of the model's own problem.
    pub scaled_residual: f64,
    /// The row of x that has it, t1 for a β and n for a γ of a polygon.
    pub worst_row: usize,
    /// The decision; its row is one of x, t1 for a β and n for a γ of a polygon.
    pub verdict: Verdict,
    /// As in [`Certificate::rounded_by`]; the residuals are those of x.
    pub rounded_by: Option<f64>,
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
                residuals: certificate.residuals,
                scaled_residual: certificate.scaled_residual,
                worst_row: certificate.worst_row,
                verdict: certificate.verdict,
                rounded_by: certificate.rounded_by,
                evidence: None,
            }
        }
    }
}

/// The verdict on the unknowns z that x leads to; an x that misses by rounding alone is judged at
/// its rounded neighbor.
fn judge_polyhedral(polyhedral: &Polyhedral, x: &[f64], demand: &Demand) -> FrictionCertificate {
    let certificate = judge_polyhedral_as_given(polyhedral, x, demand);
    if certificate.verdict.is_solution() || !x.iter().all(|x| x.is_finite()) {
        return certificate;
    }
    let friction = polyhedral.friction();
    let neighbor = neighbor::rounded(friction.lcp(), friction.contacts(), x);
    let Some(neighbor) = neighbor else { return certificate };
    let of_neighbor = judge_polyhedral_as_given(polyhedral, &neighbor, demand).verdict;
    let moved = distance(x, &neighbor);
    match of_neighbor.of_point_at(moved) {
        Some(verdict) => FrictionCertificate { verdict, rounded_by: Some(moved), ..certificate },
        None => certificate,
    }
}

/// The verdict on z, and what z does not show of x: friction without a cause, and how far an
/// exact solution is from x itself.
fn judge_polyhedral_as_given(
    polyhedral: &Polyhedral,
    x: &[f64],
    demand: &Demand,
) -> FrictionCertificate {
    let at = Rows::at(polyhedral.friction().lcp(), x);
    let z = polyhedral.z(x);
    let certificate = judge(polyhedral.lcp(), &z, demand);
    let smooth = of_smooth(polyhedral, &at);
    let is_exact = polyhedral.directions() == 4 && smooth.1 == 0.0;
    let (row, stray) = larger(smooth, friction_residual(polyhedral, &z));
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
                _ => Verdict::WithinTolerance, // z* is near z, which holds slips too
            }
        }
        Verdict::Proved { .. } | Verdict::WithinTolerance => Verdict::WithinTolerance,
    };
    let mut residuals = vec![0.0; x.len()];
    for (unknown, &residual) in certificate.residuals.iter().enumerate() {
        let own: &mut f64 = &mut residuals[polyhedral.row(unknown)];
        *own = own.max(residual);
    }
    residuals[row] = f64::max(residuals[row], stray);
    let of_z = (polyhedral.row(certificate.worst_row), certificate.scaled_residual);
    let (worst_row, scaled_residual) = if of_z.1 >= stray { of_z } else { (row, stray) };
    FrictionCertificate {
        w: at.w(),
        residuals,
        scaled_residual,
        worst_row,
        verdict,
        rounded_by: certificate.rounded_by,
        evidence: None,
    }
}

/// The residual of an x_t where there is no friction, which z does not hold: the worst with its row of x.
fn of_smooth(polyhedral: &Polyhedral, at: &Rows<'_>) -> (usize, f64) {
    let smooth = polyhedral.friction().contacts().iter().filter(|contact| contact.mu == 0.0);
    let tangents = smooth.flat_map(|contact| [contact.rows[1], contact.rows[2]]);
    let residual = |i: usize| at.rows[i].residual(at.x[i], 0.0, 0.0, Wide::INFINITY).relative;
    tangents.map(|i| (i, residual(i))).fold((0, 0.0), larger)
}

fn larger(a: (usize, f64), b: (usize, f64)) -> (usize, f64) {
    if b.1 > a.1 { b } else { a }
}

/// How far the impulses of an exact z* are from x at most, |z − z*| being at most `distance`: each of
/// the two components of x_t is a difference of two β, and x is not quite D β.
fn distance_from(polyhedral: &Polyhedral, x: &[f64], z: &[f64], distance: f64) -> f64 {
    let back = polyhedral.x(z);
    let gap = |(x, back): (&f64, &f64)| Interval::from(*x) - Interval::from(*back);
    let gap = x.iter().zip(&back).map(gap).map(Interval::magnitude).fold(0.0, f64::max);
    add_up(mul_up(2.0, distance), gap)
}
