//! `compare`: solvers side by side, on the steps of a scene or on problems.

mod problems;
mod profile;
mod scene;

use std::path::Path;

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::files;
use lcplab::lcp::friction::Model;
use lcplab::lcp::library;
use lcplab::scene::catalogue;

use super::Outcome;
use super::limits::Limits;
use super::options::{model_names, with_default};
use super::plugin::{Plugins, repeatable};
use super::scene::{SolveArgs, StepArgs};
use problems::ProblemArgs;
use scene::MotionArgs;

/// The prefix that distinguishes a problem family from a scene of the same name.
const FAMILY: &str = "family:";

/// Compare solvers on every step of a scene, or on problems; the judge checks every answer
#[derive(Debug, Args)]
#[command(
    mut_arg("plugin", repeatable),
    mut_arg("tolerance", |option| with_default(option, "the scene's; for problems 1e-8")),
    mut_arg("max_iterations", |option| with_default(option, "the scene's; for problems 10000")),
    mut_arg("omega", |option| with_default(option, "the scene's; for problems 1.3")),
    mut_arg("order", |option| with_default(option, "the scene's; for problems natural")),
    mut_arg("seed", |option| with_default(option, "the scene's; for problems 1"))
)]
#[command(after_help = "\
Examples:
  lcplab compare stack --steps 20 --out stack-report
  lcplab compare stack --show pgs:5 --show dantzig --out stack-report
  lcplab compare murty fathi --solver dantzig --solver lemke
  lcplab compare pushed-rod --model coulomb-cone --model polygon-16
  lcplab compare problem.mtx                  # any format of `convert --list`
  lcplab compare pd --plugin \"python3 mine.py\" # your solver and built-in ones
  lcplab compare mine --profile mine          # the problems of a folder

A scene: every solver simulates it at the velocity and at the acceleration level; --solver and --scheme \
select some. The table has only one line for a scheme that solves no LCP. lcplab measures the errors of contacts and joints, \
energy, momentum, restitution and the direction of friction, and compares the two levels with each other and \
with runs at half the time step. --out writes a page with the table, the plots and an animation of the solvers side \
by side. If several solvers give the same motion, the animation shows one of them; --show selects others.

Problems: one built-in solver of each kind, or with --all every one, runs on the problems that it supports; clarabel is the reference. \
lcplab solves families with friction under seven friction models, and a problem file under the model that it \
states, or as a coupled box. Tolerance and iteration limit have the same defaults as in `solve`. \
`stack` and `painleve` name both a scene and a family: write family:stack for the family.

If a solver that you name cannot handle the problem or the friction model, its row gives the reason.

Exit codes:
  0  the judge accepts every claim of a solver
  1  the judge rejects a claim, a solver claims a solution where none exists, a solver succeeds where \
theory predicts a failure, or a solver that you name solves nothing
  2  invalid input or usage")]
pub struct Compare {
    /// Scene file or name of a shipped scene; or problems: families that `problems` lists, problem
    /// files, folders of them, or patterns [default: all families]
    inputs: Vec<String>,
    /// Run this solver (repeatable)
    #[arg(long)]
    solver: Vec<String>,
    #[arg(long, help = format!(
        "Friction model (repeatable for problems): {} [default: for a scene, its own; for a \
         family, all; for a file, the one that it states]",
        model_names()
    ))]
    model: Vec<Model>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    plugins: Plugins,
    #[command(flatten)]
    solve: SolveArgs,
    #[command(flatten, next_help_heading = "Options for a scene")]
    step: StepArgs,
    #[command(flatten, next_help_heading = "Options for a scene")]
    motion: MotionArgs,
    #[command(flatten, next_help_heading = "Options for problems")]
    problems: ProblemArgs,
}

impl Compare {
    pub fn run(self, limits: &Limits) -> Result<Outcome> {
        let Some(scene) = self.scene_name() else {
            let given = self.step.given().or(self.motion.given());
            refuse(given, "problems", "applies to a scene, but the inputs are problems")?;
            return self.on_problems(limits);
        };
        refuse(self.problems.given(), &scene, "applies to problems, but the input is a scene")?;
        self.on_scene(scene, limits)
    }

    /// The scene, if the input is one: a single name that is neither a problem family nor a file or
    /// folder of problems.
    fn scene_name(&self) -> Option<String> {
        let [input] = &self.inputs[..] else { return None };
        let path = Path::new(input);
        let is_family = library::by_name(input).is_ok() && catalogue::text(input).is_none();
        let is_missing_folder = input.ends_with('/') || input.contains('/') && !path.exists();
        let is_problem = files::is_problem(path)
            || path.is_dir()
            || input.contains('*')
            || (is_missing_folder && !input.ends_with(".toml"));
        let is_scene = !is_family && !is_problem && !input.starts_with(FAMILY);
        is_scene.then(|| input.clone())
    }
}

/// Rejects a given option that has no meaning for this input.
fn refuse(option: Option<&'static str>, input: &str, reason: &str) -> Result<()> {
    option.map_or(Ok(()), |option| Err(Error::invalid(input, option, reason)))
}
