//! `export`: writes the LCP of a step as a problem file.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::Result;
use lcplab::file;

use super::SceneArgs;
use crate::cli::limits::Limits;
use crate::cli::plugin::Plugins;
use crate::cli::{Outcome, print, say};

/// Write the LCP of one step of a scene as a problem file
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab export stack --step 1 --out stack.json; lcplab solve stack.json

The rows are the scene's constraints in order, then the contacts, each with normal, first and second tangent. \
If a step solves several LCPs (an impact, a bounce), the last one is written.

Exit codes:
  0  written
  1  the step cannot be reached, or it solves no LCP
  2  invalid input or usage")]
pub struct Export {
    #[command(flatten)]
    scene: SceneArgs,
    /// Number of the step, counted from 1
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    step: u64,
    /// File to write [default: standard output]
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Export {
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        let (plugins, solvers) = self.scene.plugins.start()?;
        let named = Plugins::sole(self.scene.solver.as_deref(), &plugins)?;
        let scene = self.scene.load(named, solvers)?;
        let mut simulation = self.scene.simulation(&scene)?;
        let (stop, mut last) = (limits.stop(), None);
        for _ in 0..self.step {
            match simulation.step_before(stop) {
                Ok(step) => last = Some(step),
                Err(failure) => {
                    if let Some(reason) = failure.cause.stopped() {
                        return Ok(Outcome::Stopped(reason));
                    }
                    say(&format!("error: {}: {failure}", scene.name));
                    return Ok(Outcome::Rejected);
                }
            }
        }
        limits.over();
        let posed = last.as_ref().map(|step| step.posed(&scene)).transpose();
        let solves = match posed {
            Ok(solves) => solves.unwrap_or_default(),
            Err(cause) => {
                say(&format!("error: {}: step {}: {cause}", scene.name, self.step));
                return Ok(Outcome::Rejected);
            }
        };
        let Some(solve) = solves.last() else {
            say(&format!("error: {}: step {} solves no LCP", scene.name, self.step));
            return Ok(Outcome::Rejected);
        };
        let problem = solve.exported(&scene, self.step as usize);
        let text = format!("{}\n", problem.to_json());
        match &self.out {
            Some(path) => file::write(path, &text)?,
            None => print(&text)?,
        }
        Ok(Outcome::Good)
    }
}
