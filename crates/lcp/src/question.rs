//! A problem together with the friction model under which its answers are judged.
//!
//! The same A, b and contacts have different solutions under different models: a coupled box, a
//! polygon, a cone. Every command that solves, judges, explains or proves takes a [`Question`], so
//! that the model stated in a file is never lost.
//!
//! ```
//! use lcplab_lcp::Question;
//! use lcplab_lcp::file::Problem;
//! use lcplab_lcp::friction::Model;
//!
//! let text = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, -3],
//!                "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5], "model": "coulomb-cone"}"#;
//! let problem = Problem::parse(text, "cone.json")?;
//! let question = Question::new(&problem, None, "cone.json")?;
//! assert_eq!(question.model(), Some(Model::CoulombCone));
//! assert!(question.boxed().is_none()); // x is not the answer to an LCP with these rows
//!
//! let question = Question::new(&problem, Some(Model::CoupledBox), "cone.json")?;
//! assert_eq!(question.boxed().unwrap().bounds(1, &[2.0, 0.0, 0.0]), (-1.0, 1.0));
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

use crate::Lcp;
use crate::error::{Error, Result};
use crate::file::Problem;
use crate::friction::{FrictionProblem, Model, ProblemForm};

/// A problem and the friction model under which its answers are judged.
///
/// ```
/// use lcplab_lcp::Question;
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::friction::{Model, ProblemForm};
///
/// let text = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, -3],
///                "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5]}"#;
/// let problem = Problem::parse(text, "point.json")?;
/// let question = Question::new(&problem, Some(Model::CoulombCone), "point.json")?;
/// assert_eq!(question.problem().lcp.len(), 3);
/// assert!(matches!(question.posed(), ProblemForm::Cone(_)));
/// let error = question.require_boxed("proofs are", "point.json").unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "point.json: model: is coulomb-cone, but proofs are about boxes only"
/// );
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Question {
    problem: Problem,
    under: Option<(Model, FrictionProblem)>,
    posed: ProblemForm,
}

impl Question {
    /// The problem under the requested model; without one, under the model that the problem states;
    /// without that, as an LCP whose friction rows are coupled rows. If the contacts lie in the
    /// plane, each with one tangent, Coulomb's cone and polygons are the coupled box, and the
    /// question has no model.
    ///
    /// `input` is the name of the file in errors.
    ///
    /// # Errors
    /// If a model is requested or stated and the problem has no friction rows or cannot be stated
    /// under that model.
    pub fn new(problem: &Problem, asked: Option<Model>, input: &str) -> Result<Self> {
        let mut problem = problem.clone();
        if let Some(model) = asked.or(problem.model).filter(|_| is_plane(&problem.lcp)) {
            check_plane(model, input)?;
            problem.model = None;
            let posed = ProblemForm::Boxed(problem.lcp.clone());
            return Ok(Question { problem, under: None, posed });
        }
        let Some(model) = asked.or(problem.model) else {
            let posed = ProblemForm::Boxed(problem.lcp.clone());
            return Ok(Question { problem, under: None, posed });
        };
        let friction = problem.friction().ok_or_else(|| {
            let reason = format!("is missing: {model} is a friction model");
            Error::invalid(input, "friction_index", reason)
        })?;
        let friction = friction.map_err(|error| error.within(input))?;
        let posed = model.pose(&friction, problem.frozen_at.as_deref());
        let posed = posed.map_err(|error| error.within(input))?;
        Ok(Question { problem, under: Some((model, friction)), posed })
    }

    /// The problem, with its name and the labels of its rows.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The friction model; `None` if neither the caller nor the problem names one.
    pub fn model(&self) -> Option<Model> {
        self.under.as_ref().map(|(model, _)| *model)
    }

    /// The contacts with friction, if a model is named.
    pub fn friction(&self) -> Option<&FrictionProblem> {
        self.under.as_ref().map(|(_, friction)| friction)
    }

    /// The problem as the model states it.
    pub fn posed(&self) -> &ProblemForm {
        &self.posed
    }

    /// The LCP whose solution is x itself: `None` for cones, and for polygons, which have other
    /// unknowns.
    pub fn boxed(&self) -> Option<&Lcp> {
        match &self.posed {
            ProblemForm::Boxed(lcp) => Some(lcp),
            ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => None,
        }
    }

    /// The LCP, for operations that require one.
    ///
    /// # Errors
    /// If the model is a polygon or a cone; `what` names the unavailable operation, as in "proofs
    /// are".
    pub fn require_boxed(&self, what: &str, input: &str) -> Result<&Lcp> {
        self.boxed().ok_or_else(|| {
            let model = self.model().map(|model| model.to_string()).unwrap_or_default();
            let reason = format!("is {model}, but {what} about boxes only");
            Error::invalid(input, "model", reason)
        })
    }
}

/// Whether a problem has contacts in the plane, which this model states as the coupled box.
pub(crate) fn is_box_in_plane(model: Model, lcp: &Lcp) -> bool {
    is_plane(lcp) && check_plane(model, "").is_ok()
}

/// Whether the friction rows are those of contacts in the plane: each normal row bounds one
/// tangent.
fn is_plane(lcp: &Lcp) -> bool {
    let Some(coupling) = lcp.coupling().filter(|coupling| !coupling.is_empty()) else {
        return false;
    };
    coupling.tangents().iter().all(|tangents| tangents.len() <= 1)
}

/// Checks that a model states contacts in the plane as the coupled box.
fn check_plane(model: Model, input: &str) -> Result<()> {
    let refusal = model.refusal_in_plane();
    refusal.map_or(Ok(()), |reason| Err(Error::invalid(input, "model", reason)))
}
