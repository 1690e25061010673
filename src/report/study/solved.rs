//! Problem files × solvers: which answers the judge accepts.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::error::{Error, Result};
use crate::files;
use crate::judge::Demand;
use crate::lcp::Question;
use crate::lcp::file::Problem;
use crate::lcp::friction::Model;
use crate::solver::{Method, Options, Registry, Settings, Status};
use lcplab_analysis::friction;

/// The files and solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Problem files, folders of them, or patterns.
    pub files: Vec<String>,
    /// The solvers, a column each.
    pub solvers: Vec<Column>,
    /// The scaled residual that counts as solved.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
    /// The maximum number of sweeps, steps or pivots.
    #[serde(default = "limit")]
    pub max_iterations: usize,
}

/// A solver under a friction model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// The solver.
    pub solver: String,
    /// The friction model; by default that of each file.
    #[schemars(with = "Option<String>")]
    pub model: Option<Model>,
}

fn tolerance() -> f64 {
    1e-8
}

fn limit() -> usize {
    10_000
}

/// A problem file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct File {
    /// Its name.
    pub name: String,
    /// The number of rows.
    pub rows: usize,
    /// The answer of each solver; none if the solver is not made for the problem.
    pub answers: Vec<Option<Answer>>,
}

/// The answer of a solver, from x = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The solver's own status.
    pub status: String,
    /// Whether the solver claims a solution.
    pub is_claim: bool,
    /// Whether the judge accepts the answer.
    pub is_accepted: bool,
    /// The scaled residual.
    #[serde(with = "lcplab_analysis::number::always")]
    pub residual: f64,
}

impl Study for Plan {
    const NAME: &'static str = "solved";
    type Finding = Vec<File>;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        self.files.clone()
    }

    fn run(&self, task: usize, solvers: &Registry) -> Result<(Vec<File>, ())> {
        let is_unknown = |column: &&Column| solvers.all().all(|own| own.name() != column.solver);
        if let Some(column) = self.solvers.iter().find(is_unknown) {
            return Err(solvers.unknown(&column.solver));
        }
        let pattern = &self.files[task];
        let files = files::several(pattern, files::is_problem)?;
        let files = files.unwrap_or_else(|| vec![pattern.clone()]);
        if files.is_empty() {
            return Err(Error::invalid(pattern.as_str(), "files", "there are none"));
        }
        let file = |file: &String| {
            let path = Path::new(file);
            let problem = files::read(path, None)?;
            let name = path.file_stem().map_or(String::new(), |own| own.to_string_lossy().into());
            let answers =
                self.solvers.iter().map(|column| self.answer(column, solvers, &problem, &name));
            Ok(File { rows: problem.lcp.len(), answers: answers.collect::<Result<_>>()?, name })
        };
        Ok((files.iter().map(file).collect::<Result<_>>()?, ()))
    }
}

impl Plan {
    fn answer(
        &self,
        column: &Column,
        solvers: &Registry,
        problem: &Problem,
        name: &str,
    ) -> Result<Option<Answer>> {
        // Bounds that depend on no other row are the same under every model.
        let has_friction = problem.lcp.coupling().is_some();
        let model = column.model.or_else(|| files::model(problem)).filter(|_| has_friction);
        let question = Question::new(problem, model, name)?;
        let is_asked =
            |method: &&Method| method.name() == column.solver && method.takes(question.model());
        let Some(method) = solvers.all().find(is_asked) else { return Ok(None) };
        let demand = Demand { tolerance: self.tolerance, prove_up_to: 0 };
        let Plan { tolerance, max_iterations, .. } = *self;
        let settings =
            Settings::default().with_tolerance(tolerance).with_max_iterations(max_iterations);
        let options = Options::default().with_settings(settings);
        let (solution, judged) = friction::solve(&question, method, &options, &demand, &mut ());
        Ok(Some(Answer {
            is_claim: solution.status == Status::Solved,
            status: solution.status.to_string(),
            // Without an answer, x is the start, which may be a solution.
            is_accepted: !matches!(solution.status, Status::NoAnswer { .. })
                && judged.certificate.verdict.is_solution(),
            residual: judged.certificate.scaled_residual,
        }))
    }
}
