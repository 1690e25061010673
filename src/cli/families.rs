//! `compare-solvers`: the problem library × the solvers.

use clap::Args;
use lcplab::error::Result;
use lcplab::lcp::library::{self, Family};
use lcplab::report::study::families;
use lcplab::report::{text, view};
use lcplab::solver::{ALL, Entry, entry};

use super::{Outcome, SolverArgs, print};

/// Solve the problem library with every solver, and judge every answer
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab compare-solvers murty fathi stack --solver dantzig --solver lemke

Without names all families and all solvers run. Exit code 1 if a claim is refuted, made of a problem
that has no solution, or a failure that must happen does not.")]
pub struct CompareSolvers {
    /// Families that `problems` lists; all without one
    families: Vec<String>,
    /// A solver; may be given more than once
    #[arg(long)]
    solver: Vec<String>,
    /// Problems of each family that has a seed: the seeds 1 to this
    #[arg(long, default_value_t = 3)]
    seeds: u32,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    settings: SolverArgs,
}

impl CompareSolvers {
    pub fn run(&self) -> Result<Outcome> {
        let families: Vec<&dyn Family> = match self.families.as_slice() {
            [] => library::all().collect(),
            names => names.iter().map(|name| library::by_name(name)).collect::<Result<_>>()?,
        };
        let solvers: Vec<Entry> = match self.solver.as_slice() {
            [] => ALL.to_vec(),
            names => names.iter().map(|name| entry(name).copied()).collect::<Result<_>>()?,
        };
        let options = self.settings.options();
        options.validate()?;
        let rows = families::run(&families, &solvers, &options, self.seeds);
        if self.json {
            print(&format!("{}\n", serde_json::json!({ "rows": rows })))?;
        } else {
            print(&text::table(&view::families_table(&rows)))?;
        }
        let wrong = rows.iter().any(families::Row::is_wrong);
        Ok(if wrong { Outcome::Refuted } else { Outcome::Good })
    }
}
