//! `solve` and `judge`: commands on a problem file.

use std::path::PathBuf;

use clap::Args;
use lcplab::certificate::{Certificate, Demand, judge};
use lcplab::error::Result;
use lcplab::lcp::Lcp;
use lcplab::lcp::file::{Problem, number, read_answer};
use lcplab::report::answer::{Answer, bound, certificate_json, certificate_text};
use lcplab::solver::{by_name, default_for};

use super::{Outcome, SolverArgs, print};

/// Rows up to which `judge` and `solve --exact` prove.
const PROVED_ROWS: usize = 150;
/// Rows of x and w that are printed at most.
const PRINTED_ROWS: usize = 40;

/// Solve a problem file and have the answer judged
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  echo '{\"A\": {\"dense\": [[2, -1], [-1, 2]]}, \"b\": [-1, 2]}' | lcplab solve - --solver dantzig

Exit code 0 if the judge accepts the answer, 1 if not, 2 for bad input.")]
pub struct Solve {
    /// The problem as JSON; - reads standard input
    problem: PathBuf,
    /// The name of a solver; without it dantzig for symmetric A, lemke for any other
    #[arg(long)]
    solver: Option<String>,
    /// Prove problems of up to 150 rows exactly, not only of up to 50
    #[arg(long)]
    exact: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    settings: SolverArgs,
}

impl Solve {
    pub fn run(&self) -> Result<Outcome> {
        let options = self.settings.options();
        let named = self.solver.as_ref().map(|name| by_name(name, &options)).transpose()?;
        let problem = read_problem(&self.problem)?;
        let solver = match named {
            Some(solver) => solver,
            None => by_name(default_for(&problem.lcp), &options)?,
        };
        let mut demand = self.settings.demand();
        if self.exact {
            demand.prove_up_to = PROVED_ROWS;
        }
        let answer = Answer::obtain(&problem.lcp, &*solver, &demand);
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
            text += &certificate_text(&answer.certificate);
            text += &bound_text(answer.error_bound);
            text += &rows(&problem.lcp, &answer.solution.x, &answer.certificate);
            print(&text)?;
        }
        Ok(outcome(&answer.certificate))
    }
}

/// Judge an answer to a problem, whoever found it
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab solve problem.json --json > answer.json; lcplab judge problem.json answer.json

Exit code 0 if the judge accepts the answer, 1 if not, 2 for bad input.")]
pub struct Judge {
    /// The problem as JSON; - reads standard input
    problem: PathBuf,
    /// Any JSON object with a key \"x\"
    answer: PathBuf,
    /// Largest scaled residual that counts as solved
    #[arg(long, default_value_t = Demand::default().tolerance)]
    tolerance: f64,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Judge {
    pub fn run(&self) -> Result<Outcome> {
        let problem = read_problem(&self.problem)?;
        let x = read_answer(&self.answer, problem.lcp.len())?;
        let demand = Demand { tolerance: self.tolerance, prove_up_to: PROVED_ROWS };
        let certificate = judge(&problem.lcp, &x, &demand);
        let bound = bound(&problem.lcp, &x, &certificate);
        if self.json {
            let mut object = certificate_json(&certificate);
            if let Some(bound) = bound {
                object.insert("error_bound".into(), number(bound));
            }
            print(&format!("{}\n", serde_json::Value::Object(object)))?;
        } else {
            let text =
                title(&problem) + "\n" + &certificate_text(&certificate) + &bound_text(bound);
            print(&(text + &rows(&problem.lcp, &x, &certificate)))?;
        }
        Ok(outcome(&certificate))
    }
}

fn outcome(certificate: &Certificate) -> Outcome {
    if certificate.verdict.is_solution() { Outcome::Good } else { Outcome::Refuted }
}

fn read_problem(path: &std::path::Path) -> Result<Problem> {
    let problem = Problem::read(path)?;
    for warning in &problem.warnings {
        eprintln!("warning: {warning}");
    }
    Ok(problem)
}

fn title(problem: &Problem) -> String {
    let name = if problem.name.is_empty() { "problem" } else { &problem.name };
    let n = problem.lcp.len();
    format!("{name}: {n} rows, {} stored entries", problem.lcp.matrix().stored())
}

fn bound_text(bound: Option<f64>) -> String {
    let line = |bound| format!("  error bound      {bound:>10.2e}  no entry of x is further off\n");
    bound.map(line).unwrap_or_default()
}

fn rows(lcp: &Lcp, x: &[f64], certificate: &Certificate) -> String {
    let mut text = format!("{:>5} {:>13} {:>13} {:>13} {:>13}\n", "row", "lo", "x", "hi", "w");
    for i in 0..x.len().min(PRINTED_ROWS) {
        let (lo, hi) = lcp.bounds(i, x);
        text += &format!(
            "{i:>5} {lo:>13.6e} {:>13.6e} {hi:>13.6e} {:>13.6e}\n",
            x[i], certificate.w[i]
        );
    }
    if x.len() > PRINTED_ROWS {
        text += &format!("      and {} more rows; --json prints all\n", x.len() - PRINTED_ROWS);
    }
    text
}
