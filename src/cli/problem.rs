//! `solve`: solves a problem file and judges the answer; and prints answers.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::Result;
use lcplab::judge::{Certificate, Demand, Verdict};
use lcplab::lcp::Question;
use lcplab::lcp::file::Problem;
use lcplab::lcp::friction::Model;
use lcplab::number::counted;
use lcplab::report::answer::{Answer, attempts_text, cell, certificate_text};
use lcplab::report::friction::model;
use lcplab::report::loads::Loads;
use lcplab::report::methods;
use lcplab::report::minimum::Descent;
use lcplab::report::motion_error::MotionError;
use lcplab::solver::{
    Method, Observer, Reason, SequenceAnswer, Start, Status, default_for, solve_boxed_by_sequence,
};
use lcplab::trace::Convergence;
use serde_json::Value;

use super::friction;
use super::limits::{Limits, RAISE_MEMORY};
use super::loads;
use super::options::{SolverArgs, model_names};
use super::plugin::Plugins;
use super::proof;
use super::trace::Tracing;
use super::{Outcome, print, read_problem};

/// Maximum number of characters of a problem's name that are printed.
const NAME: usize = 200;
/// Maximum number of rows of x and w that are printed.
const PRINTED_ROWS: usize = 40;

/// Solve a problem file; the judge checks the answer
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  echo '{\"A\": {\"dense\": [[2, -1], [-1, 2]]}, \"b\": [-1, 2]}' | lcplab solve -
  lcplab problems pushed-rod | lcplab solve - --model coulomb-cone --solver cone-pgs
  lcplab problems stack | lcplab solve - --solver pgs --order shuffled --seed 7
  lcplab solve problem.mtx        # reads problem_b.mtx, too; any format of `convert --list`
  lcplab solve stack.json --solver sor --omega 1.7 --trace trace.csv --plot trace.svg
  lcplab solve problem.json --plugin \"python3 mine.py\"   # your own solver, in any language

Friction rows are solved as a coupled box unless --model or the key \"model\" of the file selects another model. \
Without either, --solver cone-pgs selects coulomb-cone.

Exit codes:
  0  the judge accepts the answer
  1  the judge rejects the answer, or proves that no solution exists
  2  invalid input or usage")]
pub struct Solve {
    /// Problem file; its extension determines the format; - reads JSON from standard input
    problem: PathBuf,
    /// Solver [default: try a sequence of methods until one succeeds, starting with dantzig for
    /// symmetric A, lemke for other A, and apgd or cone-pgs for friction cones; docs/solvers.md
    /// explains all solvers]
    #[arg(long)]
    solver: Option<String>,
    #[arg(long, help = format!(
        "Friction model: {}; docs/solvers.md explains them [default: the file's]",
        model_names()
    ))]
    model: Option<Model>,
    /// Attempt a proof in exact arithmetic for up to 150 rows instead of 50
    #[arg(long)]
    exact: bool,
    /// Write the strongest proof to this file, as the command prove does
    #[arg(long, value_name = "FILE")]
    proof: Option<PathBuf>,
    /// Print the forces for each pair of bodies and for each contact, and mark the unique ones.
    /// The file must have the keys motion, rows and bodies, like the files of `export`
    #[arg(long)]
    loads: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    tracing: Tracing,
    #[command(flatten)]
    plugins: Plugins,
    #[command(flatten)]
    settings: SolverArgs,
}

impl Solve {
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        let (plugins, solvers) = self.plugins.start()?;
        let solver = Plugins::sole(self.solver.as_deref(), &plugins)?;
        let problem = read_problem(&self.problem, self.settings.memory())?;
        let mut demand = self.settings.demand();
        if self.exact {
            demand.prove_up_to = Demand::EXACT_ROWS;
        }
        let (input, asked) =
            (self.problem.display().to_string(), model(self.model, solver, &problem, &solvers));
        let question = Question::new(&problem, asked, &input)?;
        if self.loads {
            loads::check(&question, &input)?;
        }
        if let Some(model) = question.model() {
            self.tracing.check(false)?;
            self.proof.as_ref().map_or(Ok(()), |_| proof::check_model(model))?;
            let method = solver.map(|name| solvers.method(name, Some(model))).transpose()?;
            let first = solvers.method(methods::default_for(model), Some(model))?;
            let options = self.settings.options([method.unwrap_or(first)])?;
            let title = title(&problem);
            let (outcome, solution) =
                friction::solve(&question, &title, method, &options, &demand, self.json, limits)?;
            self.prove(&question, &solution.x)?;
            return Ok(outcome);
        }
        // A trace shows one method.
        let traced = self.tracing.is_wanted().then(|| default_for(&problem.lcp));
        let method = solver.or(traced).map(|name| solvers.method(name, None)).transpose()?;
        let first = solvers.method(default_for(&problem.lcp), None)?;
        let options = self.settings.options([method.unwrap_or(first)])?;
        let (stop, start) = (limits.stop(), Start::default());
        let mut trace = Convergence::of(&problem.lcp);
        let observer: &mut dyn Observer =
            if self.tracing.is_wanted() { &mut trace } else { &mut () };
        let observer = &mut stop.watch(observer);
        let SequenceAnswer { solver, solution, attempts } = match method.and_then(Method::boxed) {
            Some(entry) => SequenceAnswer {
                solver: entry.name.to_string(),
                solution: entry.build(&options).solve(&problem.lcp, &start, observer),
                attempts: Vec::new(),
            },
            None => solve_boxed_by_sequence(&problem.lcp, &start, &options, observer),
        };
        let stopped = stop.reason().filter(|_| solution.status == Status::Stopped);
        limits.over();
        self.tracing.write(&problem.lcp, &solver, &options, &solution, &trace.records)?;
        self.prove(&question, &solution.x)?;
        let answer = Answer::judged(&problem.lcp, solver, solution, &demand);
        let answer = answer.searched(&problem.lcp, &demand);
        let answer = answer.stopped(stopped).after(attempts);
        if self.json {
            let mut object = answer.to_json();
            object.extend(MotionError::json(&question, &answer.solution.x));
            if answer.certificate.verdict.is_solution() {
                object.extend(Descent::json(&question, &answer.solution.x));
            }
            let loads = self.loads.then(|| Loads::of(&question, &answer.solution.x)).flatten();
            object.extend(loads.map(|loads| ("loads".to_string(), loads.json())));
            print(&format!("{}\n", Value::Object(object)))?;
        } else {
            let title = title(&problem);
            let iterations = answer.solution.iterations;
            let mut text = format!("{title}\nsolver     {}\n", answer.solver);
            let status = status_text(answer.status_word(), answer.message());
            let hint = match answer.solution.status {
                Status::TooLarge { .. } => RAISE_MEMORY,
                _ => "",
            };
            text += &format!("status     {status}{hint}, {}\n", counted(iterations, "iteration"));
            if let Some(fallback) = answer.solution.fallback {
                text += &format!("fallback   {fallback}\n");
            }
            text += &attempts_text(&answer.attempts);
            text +=
                &certificate_text(&answer.certificate, answer.error_bound, &problem).to_string();
            text += &MotionError::text(&question, &answer.solution.x);
            if answer.certificate.verdict.is_solution() {
                text += &Descent::text(&question, &answer.solution.x);
            }
            let loads = self.loads.then(|| Loads::of(&question, &answer.solution.x)).flatten();
            text += &loads.map(|loads| loads.text()).unwrap_or_default();
            text += &rows(&problem, &answer.solution.x, &answer.certificate);
            print(&text)?;
        }
        Ok(outcome(&answer.certificate.verdict, stopped))
    }
}

impl Solve {
    /// Writes the proof, if requested.
    fn prove(&self, question: &Question, x: &[f64]) -> Result<()> {
        self.proof.as_ref().map_or(Ok(()), |path| proof::write(path, question, x))
    }
}

/// The outcome, which is the judge's verdict unless the solver was stopped.
pub fn outcome(verdict: &Verdict, stopped: Option<Reason>) -> Outcome {
    match stopped {
        Some(reason) => Outcome::Stopped(reason),
        None if verdict.is_solution() => Outcome::Good,
        None => Outcome::Rejected,
    }
}

pub fn title(problem: &Problem) -> String {
    let name = if problem.name.is_empty() { "problem" } else { &on_one_line(&problem.name) };
    let rows = counted(problem.lcp.len(), "row");
    format!("{name}: {rows}, {}", counted(problem.lcp.matrix().stored(), "stored entry"))
}

/// A name that is safe for a terminal: without control characters, and shortened if it is long.
fn on_one_line(name: &str) -> String {
    let shown: String =
        name.chars().take(NAME).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if name.chars().nth(NAME).is_some() { shown + "…" } else { shown }
}

/// The rows in order; for a large problem those with the largest residuals, the largest first.
pub fn rows(problem: &Problem, x: &[f64], certificate: &Certificate) -> String {
    let (lcp, residuals) = (&problem.lcp, &certificate.residuals);
    let mut shown: Vec<usize> = (0..x.len()).collect();
    if x.len() > PRINTED_ROWS {
        shown.sort_by(|&i, &j| residuals[j].total_cmp(&residuals[i]));
        shown.truncate(PRINTED_ROWS);
    }
    let of = |value| cell(value, 7);
    let mut text = format!(
        "{:>5} {:>15} {:>15} {:>15} {:>15} {:>10}\n",
        "row", "lo", "x", "hi", "w", "residual"
    );
    for &i in &shown {
        let ((lo, hi), w) = (lcp.bounds(i, x), certificate.w[i]);
        let residual = cell(residuals[i], 2);
        let label = problem.extra.get("rows").and_then(|rows| rows.get(i)?.get("label")?.as_str());
        text += &format!(
            "{i:>5} {:>15} {:>15} {:>15} {:>15} {residual:>10}{}\n",
            of(lo),
            of(x[i]),
            of(hi),
            of(w),
            label.map(|label| format!("  {}", on_one_line(label))).unwrap_or_default()
        );
    }
    if x.len() > PRINTED_ROWS {
        let more = x.len() - PRINTED_ROWS;
        text += &format!(
            "      the {PRINTED_ROWS} rows with the largest residuals; {more} more are in the JSON output\n"
        );
    }
    text
}

/// A status as text: its word, and the message if that says more.
pub(super) fn status_text(word: &str, message: String) -> String {
    if message.starts_with(&word.replace('_', " ")) {
        message
    } else {
        format!("{word}: {message}")
    }
}
