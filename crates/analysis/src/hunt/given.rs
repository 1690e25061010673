//! The initial problems given to a search: their matrix class and friction model, and the changes
//! needed first.

use lcplab_lcp::Lcp;
use lcplab_lcp::error::{Defects, Result};
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::{FrictionProblem, Model};
use lcplab_solver::MatrixClass;

use super::membership::{is_of, made_definite};
use super::posing::pose;

/// Initial problems, all of one class and under one model.
#[derive(Debug, Clone)]
pub struct Given {
    /// The problems, changed as described in the notes.
    pub problems: Vec<Lcp>,
    /// The class of matrices that the search keeps to.
    pub within: MatrixClass,
    /// The friction model that the search keeps to.
    pub model: Option<Model>,
    /// Whether a contact may have a single tangent: only if a given one has.
    pub has_single_tangents: bool,
    /// The changes, one sentence each.
    pub notes: Vec<String>,
}

impl Given {
    /// Prepares problems, each with the name that messages use, for a search within a class and
    /// under a model.
    ///
    /// Without `within`, the search keeps to positive definite matrices if there are no problems;
    /// otherwise to the narrowest of definite, semidefinite and general that contains all of them.
    /// A matrix that is semidefinite up to rounding is made exactly definite, and a note reports
    /// it. Without `model`, the search keeps to the model that the problems state.
    ///
    /// # Errors
    /// Lists each problem that is not in the class, cannot be formulated under the model, or has
    /// another model than the first.
    ///
    /// ```
    /// use lcplab_lcp::file::Problem;
    /// use lcplab_solver::MatrixClass;
    /// use lcplab_analysis::hunt::Given;
    ///
    /// let text = r#"{"A": {"dense": [[1, 2], [2, 1]]}, "b": [-1, -1]}"#; // eigenvalues 3 and −1
    /// let given = [("mine.json".to_string(), Problem::parse(text, "mine.json")?)];
    /// let refused = Given::new(&given, Some(MatrixClass::Semidefinite), None).unwrap_err();
    /// assert_eq!(
    ///     refused.to_string(),
    ///     "start: mine.json: A is not symmetric positive semidefinite, even allowing for rounding"
    /// );
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn new(
        problems: &[(String, Problem)],
        within: Option<MatrixClass>,
        model: Option<Model>,
    ) -> Result<Given> {
        let stated = problems.iter().find_map(|(_, problem)| problem.model);
        let asked = model.or(stated);
        let mut defects = Defects::default();
        for (name, problem) in problems {
            if model.is_none() && problem.model != stated {
                let word = |model: Option<Model>| {
                    model.map_or("no friction model".to_string(), |model| model.to_string())
                };
                let reason = format!(
                    "states {}, another one {}; name the model that the search is to use",
                    word(problem.model),
                    word(stated)
                );
                defects.add(name.as_str(), reason);
            } else if let Err(error) = pose(&problem.lcp, asked) {
                defects.add(name.as_str(), error.to_string());
            }
        }
        defects.into_result("start")?;
        let has_pairs = |lcp: &Lcp| lcp.coupling().is_none() || FrictionProblem::of(lcp).is_ok();
        let mut given = Given {
            problems: Vec::new(),
            within: within.unwrap_or(MatrixClass::Definite),
            model: asked,
            has_single_tangents: problems.iter().any(|(_, problem)| !has_pairs(&problem.lcp)),
            notes: Vec::new(),
        };
        match within {
            Some(class) => given.keep_to(class, problems)?,
            None => given.find_class(problems),
        }
        let frozen = problems.iter().filter(|(_, problem)| problem.frozen_at.is_some());
        given.notes.extend(frozen.map(|(name, _)| {
            format!("{name}: frozen_at is not kept: each box is frozen at the normal impulse that its contact \
             would need alone")
        }));
        Ok(given)
    }

    /// Brings the problems into the requested class.
    fn keep_to(&mut self, class: MatrixClass, problems: &[(String, Problem)]) -> Result<()> {
        let mut defects = Defects::default();
        for (name, problem) in problems {
            match self.repaired(class, name, &problem.lcp) {
                Some(lcp) => self.problems.push(lcp),
                None => defects.add(name.as_str(), outside(class)),
            }
        }
        defects.into_result("start")
    }

    /// Brings the problems into the narrowest class that contains all of them.
    fn find_class(&mut self, problems: &[(String, Problem)]) {
        use MatrixClass::{Definite, General, Semidefinite};
        for (name, problem) in problems {
            let lcp = &problem.lcp;
            let repaired = match is_of(Semidefinite, lcp) {
                true => Some(lcp.clone()),
                false => self.repaired(Definite, name, lcp),
            };
            if repaired.is_none() {
                self.within = General;
                let reason = outside(Semidefinite);
                self.notes =
                    vec![format!("{name}: {reason}; the search is not restricted to a class")];
                self.problems = problems.iter().map(|(_, problem)| problem.lcp.clone()).collect();
                return;
            }
            self.problems.extend(repaired);
        }
        let are_definite = self.problems.iter().all(|lcp| is_of(Definite, lcp));
        self.within = if are_definite { Definite } else { Semidefinite };
    }

    /// A problem of the class: this one, or one whose A differs from it by rounding.
    fn repaired(&mut self, class: MatrixClass, name: &str, lcp: &Lcp) -> Option<Lcp> {
        if is_of(class, lcp) {
            return Some(lcp.clone());
        }
        let (lcp, part) = made_definite(lcp)?;
        self.notes.push(format!(
            "{name}: A is {class} only up to rounding; the search uses its symmetric part with the diagonal \
             enlarged by {part:e} of itself, which is exactly positive definite"
        ));
        Some(lcp)
    }
}

/// The message for a problem that is not in a class.
fn outside(class: MatrixClass) -> String {
    format!("A is not {class}, even allowing for rounding")
}
