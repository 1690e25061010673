//! `hunt --measure`: the smallest problem that breaks a solver.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::hunt::{Catch, Finding, Measure, Search, Trial};
use lcplab::lcp::Lcp;
use lcplab::memory::Memory;
use lcplab::number::readable;
use lcplab::report::methods;
use lcplab::report::study::problems;
use lcplab::solver::{Entry, MatrixClass, Options};
use serde_json::json;

use super::limits::Limits;
use super::{Outcome, bar, print};

/// What to look for, and where.
#[derive(Debug, Args)]
pub struct Quarry {
    /// Search for the smallest problem on which the solver lies, fails, takes many iterations, is accepted far from
    /// the exact solution, or takes many times the iterations of another: lie, failure, iterations, error, or
    /// ratio A:B
    #[arg(long, num_args = 1..=2, value_names = ["MEASURE", "A:B"])]
    measure: Vec<String>,
    /// Rows of the problem
    #[arg(long, value_name = "LEAST..MOST", default_value = "1..6", value_parser = rows, requires = "measure")]
    n: RangeInclusive<usize>,
    /// Only matrices of this class [default: any; with --from semidefinite if those are]
    #[arg(long, value_enum, requires = "measure")]
    class: Option<Class>,
    /// Only problems with friction
    #[arg(long, requires = "measure")]
    friction: bool,
    /// Begin with these problems: a file, a folder or a pattern (repeatable). What they show is made smaller, whatever
    /// their size
    #[arg(long, value_name = "FILES", requires = "measure")]
    from: Vec<String>,
    /// Problems to try before the best one is made smaller
    #[arg(long, default_value_t = 20_000, requires = "measure")]
    evaluations: usize,
    /// Search no further once the measure is so large
    #[arg(long, value_name = "VALUE", requires = "measure")]
    at_least: Option<f64>,
    /// Relaxation factor of sor and ssor [default: in a ratio the best of 25 for each problem, else 1.3]
    #[arg(long, requires = "measure")]
    omega: Option<f64>,
    /// Write the problem to this file
    #[arg(long, value_name = "FILE", requires = "measure")]
    out: Option<PathBuf>,
}

/// Classes of matrices that can be decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Class {
    /// Whatever is found
    Any,
    /// Symmetric positive semidefinite, as of every scene
    Semidefinite,
    /// Symmetric positive definite
    Definite,
    /// All principal minors positive
    P,
}

impl From<Class> for MatrixClass {
    fn from(class: Class) -> Self {
        match class {
            Class::Any => MatrixClass::General,
            Class::Semidefinite => MatrixClass::Semidefinite,
            Class::Definite => MatrixClass::Definite,
            Class::P => MatrixClass::P,
        }
    }
}

impl Quarry {
    /// Whether a measure is given.
    pub fn is_given(&self) -> bool {
        !self.measure.is_empty()
    }

    /// Searches for what breaks the one solver that is named, or the first of a ratio; `command` is a plug-in's.
    pub fn hunt(
        &self,
        names: &[&str],
        options: Options,
        seed: u64,
        json: bool,
        command: Option<&str>,
        limits: &Limits,
    ) -> Result<Outcome> {
        let from = self.given()?;
        let trial = self.trial(names, options, &from)?;
        let search = Search {
            rows: self.n.clone(),
            evaluations: self.evaluations,
            seed,
            at_least: self.at_least,
            from,
        };
        search.validate()?;
        let progress = bar(self.evaluations as u64, "problems");
        let stop = limits.stop();
        let searched = search.run(&trial, stop, &|tried| progress.inc(tried as u64));
        let stopped = stop.reason();
        limits.over();
        progress.finish_and_clear();
        let Some(catch) = searched.catch else {
            let tried = searched.evaluations;
            print(&match json {
                true => format!("{}\n", json!({ "found": false, "evaluations": tried })),
                false => format!("nothing found in {tried} problems, seed {seed}\n"),
            })?;
            return Ok(stopped.map_or(Outcome::Good, Outcome::Stopped));
        };
        let mut finding = Finding::of(&catch, &trial, seed);
        if let Some(path) = &self.out {
            finding.test = finding.test.replace("PROBLEM", &path.display().to_string());
        }
        if let Some(command) = command {
            finding.test = finding.test.replace("COMMAND", command);
        }
        if let Some(path) = &self.out {
            file::write(path, format!("{}\n", finding.problem.to_json()))?;
        }
        print(&match json {
            true => in_json(&catch, &finding, seed),
            false => self.text(&catch, &finding, trial.measure, seed),
        })?;
        Ok(match stopped {
            _ if trial.measure == Measure::Lie => Outcome::Refuted,
            Some(reason) => Outcome::Stopped(reason),
            None => Outcome::Good,
        })
    }

    /// The problems to begin with.
    fn given(&self) -> Result<Vec<Lcp>> {
        let mut given = Vec::new();
        for name in &self.from {
            for (_, problems) in problems::named(name, 1, Memory::default())? {
                given.extend(problems.into_iter().map(|problem| problem.lcp));
            }
        }
        Ok(given)
    }

    fn trial(&self, names: &[&str], mut options: Options, from: &[Lcp]) -> Result<Trial> {
        let wrong = |reason: &str| Error::invalid("options", "--measure", reason);
        let measure: Measure = self.measure[0].parse().map_err(|reason: String| wrong(&reason))?;
        let pair = self.measure.get(1).map(|pair| {
            pair.split_once(':').ok_or_else(|| wrong("a ratio is of two solvers, A:B"))
        });
        options.omega = self.omega.unwrap_or(options.omega);
        options.validate()?;
        let (solver, rival): (Entry, _) = match (pair.transpose()?, names) {
            (Some((a, b)), _) => (methods::entry(a)?, Some(methods::entry(b)?)),
            (None, [name]) => (methods::entry(name)?, None),
            (None, _) => return Err(wrong("one solver is hunted: --solver NAME, or one --plugin")),
        };
        let within = match self.class {
            Some(class) => class.into(),
            None if from.is_empty() => MatrixClass::General,
            None => Trial::class_of(from),
        };
        let best_omega = self.omega.is_none();
        let with_friction = self.friction;
        let trial = Trial { measure, solver, rival, options, within, with_friction, best_omega };
        trial.validate()?;
        Ok(trial)
    }

    fn text(&self, catch: &Catch, finding: &Finding, measure: Measure, seed: u64) -> String {
        let Catch { evaluation, shrinking, rows_at_first, value, value_at_first, .. } = catch;
        let mut text = format!(
            "{measure} found by evaluation {evaluation} of seed {seed}, with {rows_at_first} rows; made smaller \
             in {shrinking} more\n"
        );
        let [value, at_first] = [*value, *value_at_first].map(|measure| readable(measure, 4));
        text += &format!("measure {value}, before that {at_first}\n\n");
        text += &format!("{}\n\n", finding.words);
        text += &finding.equations();
        match &self.out {
            Some(path) => text += &format!("\nproblem    {}\n", path.display()),
            None => text += &format!("\n{}\n", finding.problem.to_json()),
        }
        text + "\n" + &finding.test
    }
}

fn in_json(catch: &Catch, finding: &Finding, seed: u64) -> String {
    let object = json!({
        "found": true,
        "seed": seed,
        "evaluation": catch.evaluation,
        "value": catch.value,
        "value_at_first": catch.value_at_first,
        "rows_at_first": catch.rows_at_first,
        "shrinking": catch.shrinking,
        "words": finding.words,
        "problem": finding.problem.to_json(),
        "test": finding.test,
    });
    format!("{object:#}\n")
}

/// Two whole numbers with .. between them, or one.
fn rows(text: &str) -> std::result::Result<RangeInclusive<usize>, String> {
    let number = |text: &str| text.parse().map_err(|_| format!("{text:?} is no whole number"));
    match text.split_once("..") {
        Some((least, most)) => Ok(number(least)?..=number(most.trim_start_matches('='))?),
        None => number(text).map(|n| n..=n),
    }
}
