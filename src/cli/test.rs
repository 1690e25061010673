//! `test`: a solver on problems, compared with a recorded run.

use std::path::PathBuf;

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::lcp::Question;
use lcplab::lcp::file::Problem;
use lcplab::lcp::friction::Model;
use lcplab::number::counted;
use lcplab::report::study::ci::Verdict;
use lcplab::report::study::families::{self, Contender, Models};
use lcplab::report::study::problems;
use lcplab::report::study::regression::{Factors, Finding, Run};
use serde_json::json;

use super::limits::Limits;
use super::plugin::{Plugins, repeatable};
use super::{Outcome, bar, baseline_text, from_here, print, say, warn};
use crate::cli::options::SolverArgs;

/// Test your solver on problems, and compare with a recorded run
#[derive(Debug, Args)]
#[command(mut_arg("plugin", repeatable))]
#[command(after_help = "\
Examples:
  lcplab test dumps --plugin \"python3 mine.py\"
  lcplab test dumps --plugin \"python3 mine.py\" --baseline base.json --update  # record this run
  lcplab test dumps --plugin \"python3 mine.py\" --baseline base.json           # in CI
  lcplab test dumps --plugin \"python3 mine32.py\" --motion-error 1e-2           # float32
  lcplab test dumps pd stack --solver pgs --junit test.xml --sarif test.sarif

A problem fails if the solver claims a solution that the judge rejects, or if the solver crashes, exceeds the time limit or \
finds no solution. A problem without a solution passes if the solver answers in time and does not claim to have solved it. If the \
baseline lists a problem, this problem fails only if its result is worse than the recorded one: an answer that was accepted is \
rejected, or needs many more iterations or has a much larger residual; or a solver that gave up now makes a false claim, crashes or \
exceeds the time limit. Record the baseline in the folder in which the test runs, because lcplab matches problems by their paths, \
seen from this folder.

Exit codes:
  0  no problem fails and each problem of the baseline was tested, or the baseline was written
  1  a problem fails, or one of the baseline was not tested
  2  invalid input or usage")]
pub struct Test {
    /// Problem files, folders of them, patterns, or families that `problems` lists
    #[arg(required = true)]
    problems: Vec<String>,
    /// Test this built-in solver (repeatable)
    #[arg(long)]
    solver: Vec<String>,
    #[command(flatten)]
    plugins: Plugins,
    /// Recorded run to compare with
    #[arg(long, value_name = "FILE")]
    baseline: Option<PathBuf>,
    /// Write this run to the baseline file
    #[arg(long, requires = "baseline")]
    update: bool,
    /// Do not fail if problems or solvers of the baseline are not tested
    #[arg(long, requires = "baseline")]
    allow_missing: bool,
    /// Also accept an answer that the judge rejects if its motion error is at most LIMIT, relative
    /// to the constraints' effect: 1e-2 suits single precision. The problem must have the key
    /// motion
    #[arg(long, value_name = "LIMIT", value_parser = limit)]
    motion_error: Option<f64>,
    /// A result is worse if it takes more than FACTOR times the recorded iterations
    #[arg(long, value_name = "FACTOR", default_value_t = 2.0, value_parser = factor)]
    worse_iterations: f64,
    /// A result is worse if its scaled residual is more than FACTOR times the recorded one, and
    /// above a thousandth of the tolerance
    #[arg(long, value_name = "FACTOR", default_value_t = 10.0, value_parser = factor)]
    worse_residual: f64,
    /// Write the results as JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write the failures as SARIF
    #[arg(long, value_name = "FILE")]
    sarif: Option<PathBuf>,
    #[command(flatten)]
    solve: SolverArgs,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// A factor of at least 1.
fn factor(text: &str) -> std::result::Result<f64, String> {
    match text.parse() {
        Ok(factor) if (1.0..f64::INFINITY).contains(&factor) => Ok(factor),
        _ => Err("must be a number of at least 1".into()),
    }
}

/// A positive number below 1.
fn limit(text: &str) -> std::result::Result<f64, String> {
    match text.parse() {
        Ok(limit) if limit > 0.0 && limit < 1.0 => Ok(limit),
        _ => Err("must be a number above 0 and below 1".into()),
    }
}

/// Seeds of a family with random problems.
const SEEDS: u32 = 3;

impl Test {
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        let (plugins, solvers) = self.plugins.start()?;
        let named = self.solver.iter().map(String::as_str);
        let names = named.chain(plugins.iter().map(|plugin| -> &str { plugin.name() }));
        let contenders = names.map(|name| Contender::named(name, &solvers));
        let contenders = contenders.collect::<Result<Vec<_>>>()?;
        if contenders.is_empty() {
            let reason = "name the solver to test with --plugin COMMAND or --solver NAME";
            return Err(Error::invalid("options", "--plugin", reason));
        }
        let baseline = self.recorded()?;
        let problems = self.read()?;
        let Some(run) = self.results(&problems, &contenders, limits)? else {
            let stopped = limits.stop().reason();
            return Ok(stopped.map_or(Outcome::Rejected, Outcome::Stopped));
        };
        if let (Some(path), true) = (&self.baseline, self.update) {
            file::write(path, text_of(&run)?)?;
        }
        let Test { worse_iterations: iterations, worse_residual: residual, .. } = *self;
        let findings = run.findings(baseline.as_ref(), Factors { iterations, residual });
        let missing = baseline.map(|baseline| run.missing(&baseline)).unwrap_or_default();
        let lost: &[_] = if self.allow_missing { &[] } else { &missing };
        if let Some(path) = &self.junit {
            file::write(path, Finding::junit(&findings, lost))?;
        }
        if let Some(path) = &self.sarif {
            file::write(path, Finding::sarif(&findings, lost))?;
        }
        for line in missing_lines(&missing, &run) {
            let word = if self.allow_missing { "warning" } else { "failed" };
            say(&format!("{word}: {line}"));
        }
        let fails = findings.iter().any(|finding| finding.verdict.is_failure()) || !lost.is_empty();
        match self.json {
            true => {
                let object = json!({ "ok": !fails, "problems": findings, "missing": missing });
                print(&format!("{object}\n"))?;
            }
            false => print(&words(&findings, self.update))?,
        }
        Ok(if fails && !self.update { Outcome::Rejected } else { Outcome::Good })
    }

    /// The baseline to compare with; none if this run becomes the baseline.
    fn recorded(&self) -> Result<Option<Run>> {
        let Some(path) = self.baseline.as_ref().filter(|_| !self.update) else { return Ok(None) };
        let input = path.display().to_string();
        let run = Run::from_json(&input, &baseline_text(path)?)?.renamed(from_here);
        let tolerance = self.solve.demand().tolerance;
        if run.tolerance != tolerance {
            let reason = format!("is {:e}, this run has {tolerance:e}", run.tolerance);
            return Err(Error::invalid(input, "tolerance", reason));
        }
        Ok(Some(run))
    }

    /// The problems, each under a name of its own.
    fn read(&self) -> Result<Vec<(String, Vec<Problem>)>> {
        let mut all = Vec::new();
        for name in &self.problems {
            for (name, problems) in problems::named(name, SEEDS, self.solve.memory())? {
                problems.iter().for_each(warn);
                problems.iter().try_for_each(|problem| check_model(problem, &name))?;
                let (is_one, name) = (problems.len() == 1, from_here(&name));
                for (seed, problem) in (1..).zip(problems) {
                    let name = if is_one { name.clone() } else { format!("{name}, seed {seed}") };
                    all.push((name, vec![problem]));
                }
            }
        }
        Ok(all)
    }

    /// The results of all solvers; none if it was time to stop.
    fn results(
        &self,
        problems: &[(String, Vec<Problem>)],
        contenders: &[Contender],
        limits: &Limits,
    ) -> Result<Option<Run>> {
        let methods = contenders.iter().flat_map(|contender| &contender.methods);
        let options = self.solve.options(methods)?;
        let progress = bar((problems.len() * contenders.len()) as u64, "problems");
        let stop = limits.stop();
        let all = families::Limits {
            stop,
            each: None,
            motion: self.motion_error,
            search: true,
            tick: &|| progress.inc(1),
        };
        let rows = families::run_on(problems, Models::Stated(&[]), contenders, &options, &all);
        limits.over();
        progress.finish_and_clear();
        let is_whole = stop.reason().is_none();
        Ok(is_whole.then(|| Run::of(&rows, self.solve.demand().tolerance)))
    }
}

/// Whether the problem can be stated under the model that its file names. Every problem with
/// friction is a coupled box, also where its tangents are no pairs.
fn check_model(problem: &Problem, name: &str) -> Result<()> {
    match problem.model {
        None | Some(Model::CoupledBox) => Ok(()),
        model => Question::new(problem, model, name).map(|_| ()),
    }
}

/// What was not tested of the baseline, a line for each problem, or for a solver that is missing.
fn missing_lines(missing: &[(String, String)], run: &Run) -> Vec<String> {
    let of_solver = |own: &[(String, String)]| {
        let solver = &own[0].0;
        if run.solvers.contains_key(solver) {
            let line = |(_, problem): &(String, String)| {
                format!("{problem} is in the baseline of {solver}, but was not tested")
            };
            return own.iter().map(line).collect();
        }
        let tested: Vec<&str> = run.solvers.keys().map(String::as_str).collect();
        vec![format!(
            "the baseline has {} of {solver}, which was not tested (tested: {}); a plug-in is named with \
             --plugin NAME=COMMAND",
            counted(own.len(), "result"),
            tested.join(", ")
        )]
    };
    missing.chunk_by(|a, b| a.0 == b.0).flat_map(of_solver).collect()
}

/// The run as a baseline file.
fn text_of(run: &Run) -> Result<String> {
    let text = serde_json::to_string_pretty(run);
    text.map(|text| text + "\n")
        .map_err(|cause| Error::invalid("baseline", "record", cause.to_string()))
}

/// The counts of each solver, and a line for each problem that did not simply pass. A run that is
/// recorded is compared with nothing: what is not accepted is known from now on.
fn words(findings: &[Finding], is_recorded: bool) -> String {
    let mut text = String::new();
    for own in findings.chunk_by(|a, b| a.solver == b.solver) {
        let count =
            |word: &str| own.iter().filter(|finding| finding.verdict.word() == word).count();
        let counts = ["passed", "fixed", "known", "failed"].map(|word| (count(word), word));
        let counts = counts.iter().filter(|(count, _)| *count > 0);
        let counts: Vec<String> = counts.map(|(count, word)| format!("{count} {word}")).collect();
        let counts = match is_recorded {
            true => vec![format!("{} accepted; recorded", count("passed"))],
            false => counts,
        };
        let problems = counted(own.len(), "problem");
        text += &format!("{}: {problems}, {}\n", own[0].solver, counts.join(", "));
        for finding in own {
            let why = match &finding.verdict {
                Verdict::Passed => continue,
                Verdict::Fixed => "is accepted now: record the baseline again with --update",
                Verdict::Known(why) | Verdict::Failed(why) => why,
            };
            let word = if is_recorded { "known" } else { finding.verdict.word() };
            text += &format!("  {word:<6}  {}: {why}\n", finding.problem);
        }
    }
    text
}
