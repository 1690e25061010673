//! Diagnoses a scene or a problem: the causes of failures, as text.
//!
//! A problem may have no solution, many, or one that no iteration reaches in time. [`scene`] and
//! [`problem`] look for the reason before anything is solved: rank, condition and dependent rows
//! ([`regularity`]), rows that contradict each other ([`refutation`](lcplab_judge::refutation())),
//! bodies that violate constraints, constraints without direction. K&M "Debugging" and "Bad
//! Constraints". For a wrong answer, [`find_mistakes`] finds the known mistakes that give exactly
//! that answer.
//!
//! ```
//! use lcplab_analysis::diagnosis::{Cause, Proof, scene};
//! use lcplab_mechanics::scene::Scene;
//!
//! // The distance of the two nails is larger than the length of the rod between them.
//! let found = scene(&Scene::load("fig8")?, 1)?;
//! let is_proof = |cause: &Cause| matches!(cause, Cause::Impossible { proof: Proof::Vector, .. });
//! assert!(found.causes.iter().any(is_proof));
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod cause;
mod contradiction;
mod degrees_of_freedom;
mod immovable;
mod mistake;
mod show;
#[cfg(feature = "mechanics")]
mod situation;
pub mod unsupported;

pub use cause::{Cause, Proof};
pub use degrees_of_freedom::DegreesOfFreedom;
pub use mistake::{
    Conclusion, Mistake, MistakeKind, MistakeSearch, Precision, SweepLimits, find_mistakes,
    single_precision,
};
#[cfg(feature = "mechanics")]
pub use situation::{observed_scene, scene};

use lcplab_judge::regularity::{Regularity, least_eigenvalue, regularity};
use lcplab_judge::{Demand, Refutation, error_bound, refutation};
use lcplab_lcp::Lcp;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::{Model, ProblemForm};
use lcplab_lcp::number::count;
use lcplab_solver::theory;

/// Maximum number of rows.
const LARGEST: usize = 2000;

/// A condition number above this is reported as ill-conditioned.
const ILL: f64 = 1e6;

/// A larger number of sweeps for eight digits is reported.
const MANY_SWEEPS: f64 = 1000.0;

/// Maximum number of rows for which the eigenvalues of a sweep are computed.
const SWEPT: usize = 400;

/// Maximum number of rows for which all answers are enumerated: 3⁸ = 6561 pieces.
const ENUMERATED: usize = 8;

/// An eigenvalue below minus this counts as negative, not as rounding.
const NEGATIVE: f64 = 1e-9;

/// The result of a diagnosis.
///
/// ```
/// use lcplab_analysis::diagnosis::{Cause, observed_scene, scene};
/// use lcplab_mechanics::scene::Scene;
///
/// // The distance of the two nails is larger than the length of the rod between them.
/// let nails = Scene::load("fig8")?;
/// let found = scene(&nails, 1)?;
/// assert!(!found.is_sound());
/// let cause: &Cause = found.causes.iter().find(|cause| cause.is_fatal()).unwrap();
/// assert_eq!(cause.name(), "impossible");
/// assert!(!cause.rows().is_empty()); // which rows contradict each other
/// assert!(found.to_json()["causes"].is_array());
/// assert_eq!(observed_scene(&nails, 1, &|| ())?, found); // with a callback for each step
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The scene or problem that was examined.
    pub subject: String,
    /// The names of the rows.
    pub labels: Vec<String>,
    /// Degrees of freedom, for a scene.
    pub degrees_of_freedom: Option<DegreesOfFreedom>,
    /// Rank, condition and dependent rows of A; `None` if there are no rows, or the numbers are too
    /// large or too small for singular values.
    pub regularity: Option<Regularity>,
    /// Whether x is unique: `true` only if that follows from a theorem whose assumptions were
    /// verified (A symmetric and definite, no friction); otherwise it is unknown.
    pub is_unique: bool,
    /// Whether A is symmetric.
    pub is_symmetric: bool,
    /// The causes, the fatal ones first.
    pub causes: Vec<Cause>,
}

/// Examines a problem file.
///
/// ```
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // The same contact twice: the loads of the two rows are not unique.
/// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let diagnosis = lcplab_analysis::diagnosis::problem(&Problem::new("twice", lcp))?;
/// assert_eq!(diagnosis.regularity.map(|found| found.rank), Some(1));
/// assert!(!diagnosis.is_unique);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Errors
/// If it has more than 2000 rows.
pub fn problem(problem: &Problem) -> Result<Diagnosis> {
    let name = if problem.name.is_empty() { "a problem" } else { &problem.name };
    let label = |i: usize| {
        let row = problem.extra.get("rows").and_then(|rows| rows.get(i));
        match row.and_then(|row| row.get("label")?.as_str()) {
            Some(label) => format!("{i} ({label})"),
            None => i.to_string(),
        }
    };
    let labels = (0..problem.lcp.len()).map(label).collect();
    let mut found = Diagnosis::named(name.to_string(), labels);
    found.examine(&problem.lcp, matches!(problem.model, None | Some(Model::CoupledBox)))?;
    if found.is_sound() {
        found.causes.splice(0..0, impossible_polygons(problem));
    }
    Ok(found)
}

/// The proof that no friction forces from polygons with four corners satisfy the rows, if there is
/// one. The directions of more corners are rounded numbers, so nothing is proved for them.
fn impossible_polygons(problem: &Problem) -> Option<Cause> {
    let model = problem.model.filter(|model| *model == Model::Polyhedral { directions: 4 })?;
    let Ok(ProblemForm::Polyhedral(polygons)) = model.pose(&problem.friction()?.ok()?, None) else {
        return None;
    };
    let proof = match refutation(polygons.lcp(), &[], Demand::default().tolerance)? {
        Refutation::Vector(_) => Proof::Vector,
        Refutation::CaseSplit { pieces } => Proof::CaseSplit { pieces },
    };
    Some(Cause::Impossible { rows: Vec::new(), proof })
}

/// The number of sweeps that theory predicts, if it is large. If Gauss-Seidel does not contract for
/// this matrix, there is no prediction.
fn slow(lcp: &Lcp) -> Option<Cause> {
    let a = lcp.matrix();
    if a.len() > SWEPT || (0..a.len()).any(|i| a.diagonal(i) <= 0.0) {
        return None;
    }
    let radius = theory::gauss_seidel_rate(a)?;
    let sweeps = theory::sweeps_to(1e-8, radius);
    (sweeps > MANY_SWEEPS).then_some(Cause::Slow { radius, sweeps })
}

/// The answers of a small problem with friction or an unsymmetric matrix, if there are several. If
/// A is symmetric and nothing is coupled, the redundant rows already show this.
fn several(lcp: &Lcp) -> Option<Cause> {
    if lcp.len() > ENUMERATED || (lcp.coupling().is_none() && lcp.matrix().is_symmetric()) {
        return None;
    }
    let answers = all_solutions(lcp)?.len();
    (answers > 1).then_some(Cause::Several { answers })
}

impl Diagnosis {
    fn named(subject: String, labels: Vec<String>) -> Self {
        let (degrees_of_freedom, regularity, causes) = (None, None, Vec::new());
        let (is_unique, is_symmetric) = (false, true);
        Diagnosis {
            subject,
            labels,
            degrees_of_freedom,
            regularity,
            is_unique,
            is_symmetric,
            causes,
        }
    }

    /// Whether a step can be taken.
    pub fn is_sound(&self) -> bool {
        !self.causes.iter().any(Cause::is_fatal)
    }

    /// Adds the causes that follow from A and b alone; `is_box` is whether friction rows are those
    /// of the coupled box.
    fn examine(&mut self, lcp: &Lcp, is_box: bool) -> Result<()> {
        if lcp.len() > LARGEST {
            let [rows, most] = [lcp.len(), LARGEST].map(count);
            let reason = format!("has {rows} rows; diagnose examines at most {most}");
            return Err(Error::invalid(&self.subject, "A", reason));
        }
        let found = regularity(lcp.matrix());
        self.is_symmetric = lcp.matrix().is_nearly_symmetric();
        self.definiteness(lcp);
        for &row in found.iter().flat_map(|found| &found.zero_rows) {
            self.causes.push(Cause::ZeroRow { row: self.labels[row].clone() });
        }
        let labels = &self.labels;
        self.causes.extend(immovable::immovable_rows(lcp, |row| labels[row].clone()));
        let dependencies = found.as_ref().map_or(&[][..], |found| &found.dependencies);
        let impossible = contradiction::rows(lcp, dependencies, is_box);
        if let Some((rows, proof)) = impossible {
            self.causes.push(Cause::Impossible { rows: self.names(rows), proof });
        } else if is_box {
            self.causes.extend(several(lcp));
        }
        self.is_unique = lcp.coupling().is_none() && error_bound::is_definite(lcp);
        let is_indefinite = self
            .causes
            .iter()
            .any(|cause| matches!(cause, Cause::Indefinite { .. } | Cause::Unsymmetric));
        if let Some(found) = &found {
            self.redundancy(found);
        }
        match found.as_ref().map(|found| found.condition) {
            Some(condition) if condition > ILL => {
                self.causes.push(Cause::IllConditioned { condition });
            }
            _ if !is_indefinite => self.causes.extend(slow(lcp)),
            _ => {}
        }
        self.regularity = found;
        self.causes.sort_by_key(|cause| !cause.is_fatal());
        Ok(())
    }

    fn definiteness(&mut self, lcp: &Lcp) {
        if !lcp.matrix().is_nearly_symmetric() {
            self.causes.push(Cause::Unsymmetric);
        } else if let Some(eigenvalue) = least_eigenvalue(lcp).filter(|&least| least < -NEGATIVE) {
            self.causes.push(Cause::Indefinite { eigenvalue });
        }
    }

    /// Dependent rows, except rows of zeros.
    fn redundancy(&mut self, found: &Regularity) {
        let depends = |&i: &usize| found.dependencies.iter().any(|d| d[i] != 0.0);
        let rows: Vec<usize> = (0..self.labels.len())
            .filter(depends)
            .filter(|i| !found.zero_rows.contains(i))
            .collect();
        let spare = found.dependencies.len() - found.zero_rows.len().min(found.dependencies.len());
        if spare > 0 {
            self.causes.push(Cause::Redundant { rows: self.names(rows), spare });
        }
    }

    fn names(&self, rows: Vec<usize>) -> Vec<String> {
        rows.into_iter().map(|i| self.labels[i].clone()).collect()
    }
}
