//! Problems of a user's own run: the error of a solver's answers, and its causes.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::diagnosis::unsupported::{ErrorHistory, UserSolver, error_histories, examine_sequence};
use crate::document::Document;
use crate::error::{Error, Result};
use crate::lcp::exchange;
use crate::lcp::file::Problem;
use crate::solver::{Options, Pgs, Registry};

/// The problems, and the solver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Problem files, folders of them, or patterns; each problem is solved from the answer to the
    /// previous one.
    pub files: Vec<String>,
    /// The solver.
    #[serde(default = "usual")]
    pub solver: String,
    /// The maximum number of sweeps or pivots.
    #[serde(default = "limit")]
    pub max_iterations: usize,
}

fn usual() -> String {
    Pgs::NAME.into()
}

fn limit() -> usize {
    10
}

/// The result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The diagnosis as text and tables.
    pub words: Document,
    /// The error after each sweep in the examined problem.
    pub error_histories: Vec<ErrorHistory>,
    /// Whether the error of the answers is negligible, and each problem is known to be solved.
    pub is_good: bool,
}

impl Study for Plan {
    const NAME: &'static str = "frames";
    type Finding = Finding;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec![self.files.join(", ")]
    }

    fn run(&self, _task: usize, solvers: &Registry) -> Result<(Finding, ())> {
        let problems = self.problems()?;
        let mut options = Options::default();
        options.settings.max_iterations = self.max_iterations;
        let user_solver = UserSolver { entry: solvers.entry(&self.solver)?.clone(), options };
        let tolerance = user_solver.options.settings.tolerance;
        let found = examine_sequence(&problems, &user_solver);
        let unsolved = found.unsolved_in_words(tolerance);
        let mut words = Document { lead: unsolved.clone(), ..Document::default() };
        found.open(&mut words);
        let is_short = found.unsupported.as_ref().is_some_and(|own| own.is_short());
        let frame = found.frame.as_ref().filter(|_| is_short);
        let error_histories =
            frame.map_or_else(Vec::new, |frame| error_histories(frame, &user_solver));
        let is_good = !is_short && unsolved.is_empty();
        Ok((Finding { words, error_histories, is_good }, ()))
    }
}

impl Plan {
    /// The problems, each with the name of its file.
    fn problems(&self) -> Result<Vec<Problem>> {
        let mut problems = Vec::new();
        for name in &self.files {
            let files = exchange::several(name, exchange::is_problem)?;
            for file in files.unwrap_or_else(|| vec![name.clone()]) {
                let path = Path::new(&file);
                let mut problem = exchange::read(path, None)?;
                problem.name =
                    path.file_name().map_or(String::new(), |own| own.to_string_lossy().into());
                problems.push(problem);
            }
        }
        if problems.is_empty() {
            return Err(Error::invalid("frames", "files", "there are none"));
        }
        Ok(problems)
    }
}
