//! `diagnose`: what is wrong with a scene or a problem.

use std::path::Path;

use clap::Args;
use lcplab::diagnosis::{problem, scene};
use lcplab::error::{Error, Result};
use lcplab::lcp::exchange;
use lcplab::memory::Memory;

use super::form::Writing;
use super::scene::Changes;
use super::{Outcome, print, read_problem};

/// Explain why a scene or a problem has no solution, or more than one
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab diagnose fig8                    # three rows that contradict each other, proved
  lcplab diagnose stack --step 10
  lcplab diagnose fig8 --json
  lcplab generate fathi | lcplab diagnose - --format markdown

It reports rank, condition number and degrees of freedom, and lists zero rows, dependent rows, rows that
no forces satisfy, constraints without direction, drift, overlap, and sign errors in A. INPUT is a problem
file if its ending is one of `convert --list`, or -; otherwise a scene. Exit code 0 if it can be solved,
1 if not, 2 for bad input.")]
pub struct Diagnose {
    /// A scene file, the name of a shipped scene, a problem file by its ending, or - for a problem as
    /// JSON from standard input
    input: String,
    /// The step of a scene at whose beginning it is examined, from 1 [default: 1]
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    step: Option<u64>,
    #[command(flatten)]
    changes: Changes,
    /// Print what was found as JSON
    #[arg(long, conflicts_with_all = ["format", "out"])]
    json: bool,
    #[command(flatten)]
    writing: Writing,
}

impl Diagnose {
    pub fn run(&self) -> Result<Outcome> {
        let is_problem = exchange::is_problem(Path::new(&self.input));
        let found = match (is_problem, self.step) {
            (true, Some(_)) => {
                let reason = "is for scenes, this is a problem";
                return Err(Error::invalid(&self.input, "--step", reason));
            }
            (true, None) if !self.changes.is_empty() => {
                let reason = "is for scenes, this is a problem";
                return Err(Error::invalid(&self.input, "--set", reason));
            }
            (true, None) => problem(&read_problem(Path::new(&self.input), Memory::default())?)?,
            (false, step) => scene(&self.changes.load(&self.input)?, step.unwrap_or(1) as usize)?,
        };
        if !self.json {
            return self.writing.write(&found.document());
        }
        print(&format!("{:#}\n", found.to_json()))?;
        Ok(if found.is_sound() { Outcome::Good } else { Outcome::Refuted })
    }
}
