//! `diagnose`: what is wrong with a scene or a problem.

use std::path::{Path, PathBuf};

use clap::Args;
use lcplab::certificate::{Demand, judge};
use lcplab::diagnosis::{Mistake, mistakes, problem, scene, single_precision};
use lcplab::error::{Error, Result};
use lcplab::lcp::exchange;
use lcplab::lcp::file::{Problem, number, read_answers};
use lcplab::lcp::friction::Model;
use lcplab::memory::Memory;
use lcplab::number::readable;
use serde_json::json;

use super::form::Writing;
use super::scene::Changes;
use super::{Outcome, print, read_problem};

/// Explain why a scene or a problem has no solution or several, or which mistake made an answer
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab diagnose fig8                    # three rows that contradict each other, proved
  lcplab diagnose stack --step 10
  lcplab diagnose fig8 --json
  lcplab generate fathi | lcplab diagnose - --format markdown
  lcplab diagnose problem.json answer.json  # which known mistake gives exactly this x?

It reports rank, condition number and degrees of freedom, and lists zero rows, dependent rows, rows that
no forces satisfy, constraints without direction, drift, overlap, and sign errors in A. With an answer it does to
the problem what solvers do wrong (sweeps that were stopped, the clamp after the sweep, b with the other sign,
single precision, compliance, …) and says what gives the same x. INPUT is a problem
file if its ending is one of `convert --list`, or -; otherwise a scene. Exit code 0 if it can be solved,
1 if not, 2 for bad input.")]
pub struct Diagnose {
    /// A scene file, the name of a shipped scene, a problem file by its ending, or - for a problem as
    /// JSON from standard input
    input: String,
    /// An answer to a problem: a file with the key x. Which known mistake gives exactly this?
    #[arg(conflicts_with_all = ["step", "format", "out"])]
    answer: Option<PathBuf>,
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
        if let Some(answer) = &self.answer {
            if !is_problem {
                return Err(Error::invalid(
                    &self.input,
                    "ANSWER",
                    "is for problems, this is a scene",
                ));
            }
            return self.mistake(&read_problem(Path::new(&self.input), Memory::default())?, answer);
        }
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

    /// What a wrong answer looks like.
    fn mistake(&self, problem: &Problem, answer: &Path) -> Result<Outcome> {
        if let Some(model) = problem.model.filter(|model| *model != Model::CoupledBox) {
            let reason = format!("is {model}; mistakes are known of boxes alone");
            return Err(Error::invalid(&self.input, "model", reason));
        }
        let lcp = &problem.lcp;
        let x = read_answers(answer, lcp.len(), Memory::default())?.x;
        let verdict = judge(lcp, &x, &Demand::default()).verdict;
        let found = mistakes(lcp, &x);
        let single = single_precision(lcp, &x);
        if self.json {
            let mistakes: Vec<_> = found
                .iter()
                .map(|own| json!({ "what": own.what, "distance": own.distance }))
                .collect();
            let single =
                single.map(|[own, least]| json!({ "residual": number(own), "rounded_solution": number(least) }));
            let object = json!({ "verdict": verdict.word(), "mistakes": mistakes, "single_precision": single });
            print(&format!("{object:#}\n"))?;
        } else {
            print(&words(&verdict.to_string(), verdict.is_solution(), &found, single))?;
        }
        Ok(if verdict.is_solution() { Outcome::Good } else { Outcome::Refuted })
    }
}

/// What was found, for people.
fn words(verdict: &str, is_right: bool, found: &[Mistake], single: Option<[f64; 2]>) -> String {
    let mut text = format!("{verdict}\n");
    match found {
        [] if is_right => {}
        [] => text += "None of the known mistakes gives this x.\n",
        [first, others @ ..] => {
            let agrees = match first.distance {
                0.0 => "exactly".into(),
                distance => format!("to {} of its largest entry", readable(distance, 2)),
            };
            text += &format!("This x is that of {}, {agrees}.\n", first.what);
            for other in others.iter().take(4) {
                text += &format!(
                    "  so near comes also: {} ({})\n",
                    other.what,
                    readable(other.distance, 2)
                );
            }
        }
    }
    if let Some([own, least]) = single.filter(|_| !is_right) {
        // A solution that single precision can hold says nothing of sums that it rounds.
        let limit = 10.0 * least.max(f64::from(f32::EPSILON));
        let word = if own <= limit { "as good as" } else { "worse than" };
        text += &format!(
            "Its scaled residual {} is {word} single precision can be: the solution rounded to it has {}.\n",
            readable(own, 2),
            readable(least, 2)
        );
    }
    text
}
