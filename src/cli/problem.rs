//! `solve`: a problem file, solved and judged; and how an answer to one is printed.

use std::path::PathBuf;

use clap::Args;
use lcplab::certificate::{Certificate, Demand, Verdict, upper_bound};
use lcplab::error::Result;
use lcplab::lcp::file::Problem;
use lcplab::lcp::friction::Model;
use lcplab::lcp::{Lcp, Question};
use lcplab::number::readable;
use lcplab::report::answer::{Answer, certificate_text};
use lcplab::report::friction::model;
use lcplab::report::methods;
use lcplab::solver::{Method, Observer, Reason, Start, Status, default_for};
use lcplab::trace::Convergence;

use super::friction;
use super::limits::Limits;
use super::options::SolverArgs;
use super::plugin::Plugins;
use super::proof;
use super::trace::Tracing;
use super::{Outcome, print, read_problem};

/// Characters of a problem's name that are printed at most.
const NAME: usize = 200;
/// Rows of x and w that are printed at most.
const PRINTED_ROWS: usize = 40;

/// Solve a problem file and have the answer judged
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  echo '{\"A\": {\"dense\": [[2, -1], [-1, 2]]}, \"b\": [-1, 2]}' | lcplab solve - --solver dantzig
  lcplab generate pushed-rod | lcplab solve - --model coulomb-cone --solver cone-pgs
  lcplab generate stack | lcplab solve - --solver pgs --order shuffled --seed 7
  lcplab solve problem.mtx        # and problem_b.mtx beside it; any format of `convert --list`
  lcplab solve stack.json --solver sor --omega 1.7 --trace trace.csv --plot trace.svg
  lcplab solve problem.json --plugin \"python3 mine.py\"     # a solver of yours, in any language

A problem with friction rows is solved as it stands, as a coupled box, unless --model, the key
\"model\" of the file or a solver for cones says otherwise. Exit code 0 if the judge accepts the answer, 1 if not, 2 for bad input.")]
pub struct Solve {
    /// The problem: JSON, or another format by its ending; - reads JSON from standard input
    problem: PathBuf,
    /// The name of a solver [default: dantzig for symmetric A, lemke for any other, and for a friction
    /// model one that takes it]
    #[arg(long)]
    solver: Option<String>,
    /// Model of friction: frozen-box, coupled-box, polygon-4 (or 8, 12, …), associated-cone,
    /// coulomb-cone [default: the file's]
    #[arg(long)]
    model: Option<Model>,
    /// Prove problems of up to 150 rows exactly, not only of up to 50
    #[arg(long)]
    exact: bool,
    /// Write the strongest proof that there is, as prove does
    #[arg(long, value_name = "FILE")]
    proof: Option<PathBuf>,
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
        let plugins = self.plugins.start()?;
        let solver = Plugins::sole(self.solver.as_deref(), &plugins)?;
        let problem = read_problem(&self.problem, self.settings.memory())?;
        let mut demand = self.settings.demand();
        if self.exact {
            demand.prove_up_to = Demand::EXACT_ROWS;
        }
        if let Some(model) = model(self.model, solver, &problem) {
            self.tracing.check(false)?;
            self.proof.as_ref().map_or(Ok(()), |_| proof::check_model(model))?;
            let method = methods::by_name(solver.unwrap_or(methods::default_for(model)), model)?;
            let options = self.settings.options(&[method])?;
            let input = self.problem.display().to_string();
            let question = Question::new(&problem, Some(model), &input)?;
            let title = title(&problem);
            let (outcome, solution) =
                friction::solve(&question, &title, &method, &options, &demand, self.json, limits)?;
            self.prove(&problem, &solution.x)?;
            return Ok(outcome);
        }
        let entry = methods::entry(solver.unwrap_or_else(|| default_for(&problem.lcp)))?;
        let options = self.settings.options(&[Method::Boxed(entry)])?;
        let (solver, stop) = ((entry.build)(&options), limits.stop());
        let mut trace = Convergence::of(&problem.lcp);
        let observer: &mut dyn Observer =
            if self.tracing.is_wanted() { &mut trace } else { &mut () };
        let solution = solver.solve(&problem.lcp, &Start::default(), &mut stop.watch(observer));
        let stopped = stop.reason().filter(|_| solution.status == Status::Stopped);
        limits.over();
        self.tracing.write(&problem.lcp, entry.name, &options, &solution, &trace.records)?;
        self.prove(&problem, &solution.x)?;
        let answer = Answer::judged(&problem.lcp, entry.name, solution, &demand).stopped(stopped);
        if self.json {
            print(&format!("{}\n", answer.to_json()))?;
        } else {
            let title = title(&problem);
            let iterations = answer.solution.iterations;
            let mut text = format!("{title}\nsolver     {}\n", answer.solver);
            let status = match (answer.status_word(), answer.message()) {
                (word, message) if word == message => message,
                (word, message) => format!("{word}: {message}"),
            };
            text += &format!("status     {status}, {iterations} iterations\n");
            if let Some(fallback) = answer.solution.fallback {
                text += &format!("fallback   {fallback}\n");
            }
            text += &certificate_text(&answer.certificate, &problem);
            text += &bound_text(answer.error_bound);
            text += &rows(&problem.lcp, &answer.solution.x, &answer.certificate);
            print(&text)?;
        }
        Ok(outcome(&answer.certificate.verdict, stopped))
    }
}

impl Solve {
    /// Writes the proof, if one is asked for.
    fn prove(&self, problem: &Problem, x: &[f64]) -> Result<()> {
        self.proof.as_ref().map_or(Ok(()), |path| proof::write(path, problem, x))
    }
}

/// How it came out: what counts is the judge's word, unless the solver was stopped.
pub fn outcome(verdict: &Verdict, stopped: Option<Reason>) -> Outcome {
    match stopped {
        Some(reason) => Outcome::Stopped(reason),
        None if verdict.is_solution() => Outcome::Good,
        None => Outcome::Refuted,
    }
}

pub fn title(problem: &Problem) -> String {
    let name = if problem.name.is_empty() { "problem" } else { &on_one_line(&problem.name) };
    let n = problem.lcp.len();
    format!("{name}: {n} rows, {} stored entries", problem.lcp.matrix().stored())
}

/// A name as a terminal can take it: without controls, and cut if it is long.
fn on_one_line(name: &str) -> String {
    let shown: String =
        name.chars().take(NAME).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if name.chars().nth(NAME).is_some() { shown + "…" } else { shown }
}

pub fn bound_text(bound: Option<f64>) -> String {
    let line = |bound| {
        format!("  error bound      {:>10}  no entry of x is further off\n", upper_bound(bound))
    };
    bound.map(line).unwrap_or_default()
}

pub fn rows(lcp: &Lcp, x: &[f64], certificate: &Certificate) -> String {
    let of = |value| readable(value, 7);
    let mut text = format!("{:>5} {:>15} {:>15} {:>15} {:>15}\n", "row", "lo", "x", "hi", "w");
    let line = |i: usize| {
        let (lo, hi) = lcp.bounds(i, x);
        format!(
            "{i:>5} {:>15} {:>15} {:>15} {:>15}\n",
            of(lo),
            of(x[i]),
            of(hi),
            of(certificate.w[i])
        )
    };
    text.extend((0..x.len().min(PRINTED_ROWS)).map(line));
    if x.len() > PRINTED_ROWS {
        text += &format!("      and {} more rows; --json prints all\n", x.len() - PRINTED_ROWS);
    }
    if let Verdict::NotASolution { row, .. } = certificate.verdict
        && row >= PRINTED_ROWS
    {
        text += &line(row);
    }
    text
}
