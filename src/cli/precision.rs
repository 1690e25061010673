//! `precision`: whether single precision suffices, and which stage loses most.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use lcplab::error::Result;
use lcplab::lcp::Question;
use lcplab::lcp::friction::Model;
use lcplab::precision::{Precision, TextbookSolver};
use serde_json::Value;

use super::limits::MemoryLimit;
use super::options::model_names;
use super::problem::title;
use super::{Outcome, print, read_problem};

/// Find out whether single precision suffices, and which stage loses most
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab export stack --step 1 | lcplab precision -
  lcplab precision problem.json --solver pgs --sweeps 2000 --json

lcplab solves the problem with textbook versions of the solvers, each stage in single or double precision, and compares \
the motion with the exact one: with one stage alone in single precision, and with it alone in double. \
Without the key motion of the file, the motion is that of the rows, w. Friction limits are frozen at lcplab's solution.

Exit codes:
  0  single precision suffices
  1  it does not, or the method has not converged in double precision
  2  invalid input or usage, or no exact solution is known")]
pub struct SinglePrecision {
    /// Problem file; its extension determines the format; - reads JSON from standard input
    problem: PathBuf,
    /// Method [default: dantzig if A is positive definite, otherwise pgs]
    #[arg(long, value_parser = solvers())]
    solver: Option<TextbookSolver>,
    #[arg(long, help = format!("Friction model: {} [default: the file's]", model_names()))]
    model: Option<Model>,
    /// Number of sweeps of pgs [default: until it has converged in double precision]
    #[arg(long)]
    sweeps: Option<usize>,
    /// Largest motion error that suffices, relative to the effect of the constraints
    #[arg(long, default_value_t = 1e-3)]
    tolerance: f64,
    #[command(flatten)]
    memory: MemoryLimit,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

fn solvers() -> impl TypedValueParser<Value = TextbookSolver> {
    let named = |word: String| TextbookSolver::ALL.into_iter().find(|solver| solver.name() == word);
    PossibleValuesParser::new(TextbookSolver::ALL.map(TextbookSolver::name))
        .try_map(move |word| named(word).ok_or("is no method"))
}

impl SinglePrecision {
    pub fn run(&self) -> Result<Outcome> {
        let problem = read_problem(&self.problem, self.memory.max_memory)?;
        let question = Question::new(&problem, self.model, &self.problem.display().to_string())?;
        let precision = Precision::of(&question, self.solver, self.sweeps, self.tolerance)?;
        print(&match self.json {
            true => format!("{}\n", Value::Object(precision.json())),
            false => format!("{}\n{}", title(&problem), precision.text()),
        })?;
        Ok(if precision.suffices() { Outcome::Good } else { Outcome::Rejected })
    }
}
