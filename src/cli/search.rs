//! `hunt --measure`: searches for the smallest problem on which a solver fails.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::hunt::{Counterexample, Finding, Friction, Given, Measure, Search, Target};
use lcplab::lcp::file::{Problem, number};
use lcplab::lcp::friction::Model;
use lcplab::memory::Memory;
use lcplab::number::readable;
use lcplab::report::study::problems;
use lcplab::solver::{Group, MatrixClass, Options, Registry};
use serde_json::{Value, json};

use super::limits::Limits;
use super::plugin::quoted;
use super::{Outcome, bar, print, say, warn};

/// What to look for, and where.
#[derive(Debug, Args)]
pub struct SearchArgs {
    /// Search for a small problem on which the solver makes a false claim (false-claim), fails
    /// (failure), takes many iterations (iterations), returns an accepted answer far from the exact
    /// solution (error), or takes many times the iterations of another solver (ratio A:B)
    #[arg(long, num_args = 1..=2, value_names = ["MEASURE", "A:B"])]
    measure: Vec<String>,
    /// Number of rows
    #[arg(long, value_name = "MIN..MAX", default_value = "1..6", value_parser = rows, requires = "measure")]
    n: RangeInclusive<usize>,
    /// Class of the matrix, decided in exact arithmetic [default: definite; with --from the
    /// narrowest class of the given problems]
    #[arg(long, value_parser = classes(), requires = "measure")]
    class: Option<MatrixClass>,
    /// Search only problems with friction: contacts with a normal and two tangents; --model implies
    /// this
    #[arg(long, requires = "measure")]
    friction: bool,
    /// Start from these problems: a file, a folder or a pattern (repeatable). They may have more
    /// rows than --n allows; lcplab shrinks the worst of them
    #[arg(long, value_name = "FILES", requires = "measure")]
    from: Vec<String>,
    /// Number of problems to try before the worst one is shrunk
    #[arg(long, default_value_t = 20_000, requires = "measure")]
    evaluations: usize,
    /// Stop searching when the measure reaches this value [default: false-claim and failure stop at
    /// the first problem found; the other measures have no limit]
    #[arg(long, value_name = "VALUE", requires = "measure")]
    at_least: Option<f64>,
    /// Relaxation factor of sor and ssor [default: 1.3; with --measure ratio, the best of 25 values
    /// for each problem]
    #[arg(long, requires = "measure")]
    omega: Option<f64>,
    /// Write the problem to this file
    #[arg(long, value_name = "FILE", requires = "one")]
    out: Option<PathBuf>,
}

/// The solvers to examine, and the options that a search shares with a table of claims.
pub struct HuntOptions<'a> {
    /// The named solvers, and the plug-ins.
    pub names: &'a [&'a str],
    /// All solvers, and the plug-ins.
    pub solvers: &'a Registry,
    /// The requested friction model.
    pub model: Option<Model>,
    /// The options of the solvers.
    pub options: Options,
    /// The seed of the random numbers.
    pub seed: u64,
    /// The command of the first plug-in.
    pub command: Option<&'a str>,
}

/// The classes of matrices, by the names that plug-ins and Python use; any is an old name.
fn classes() -> impl TypedValueParser<Value = MatrixClass> {
    let value = |class: MatrixClass| {
        let value = PossibleValue::new(class.word()).help(class.to_string());
        if class == MatrixClass::General { value.alias("any") } else { value }
    };
    PossibleValuesParser::new(MatrixClass::ALL.map(value)).try_map(|word| match word.as_str() {
        "any" => Ok(MatrixClass::General),
        word => MatrixClass::by_word(word),
    })
}

impl SearchArgs {
    /// Whether a measure was given.
    pub fn is_given(&self) -> bool {
        !self.measure.is_empty()
    }

    /// The file for the problem.
    pub fn out(&self) -> Option<&Path> {
        self.out.as_deref()
    }

    /// Searches for a problem on which the named solver, or the first of a ratio, fails.
    pub fn hunt(&self, all: HuntOptions<'_>, json: bool, limits: &Limits) -> Result<Outcome> {
        let HuntOptions { names, solvers, model, options, seed, command } = all;
        let given = Given::new(&self.problems()?, self.class, model)?;
        given.notes.iter().for_each(|note| say(&format!("note: {note}")));
        let target = self.target(names, solvers, options, &given)?;
        let search = Search {
            rows: self.n.clone(),
            evaluations: self.evaluations,
            seed,
            at_least: self.at_least,
            from: given.problems,
        };
        search.validate(&target)?;
        let progress = bar(self.evaluations as u64, "problems");
        let stop = limits.stop();
        let result = search.run(&target, stop, &|tried| progress.inc(tried as u64));
        let stopped = stop.reason();
        limits.over();
        progress.finish_and_clear();
        let name = target.solver.name();
        let useless = result.useless(name);
        let Some(counterexample) = result.counterexample else {
            let (tried, solved) = (result.evaluations, result.solved);
            print(&match json {
                true => {
                    let object = json!({ "found": false, "evaluations": tried, "solved": solved });
                    format!("{object}\n")
                }
                false => format!(
                    "nothing found in {tried} problems, seed {seed}; {name} solves {solved} of them (others may have \
                     no solution)\n"
                ),
            })?;
            useless.iter().for_each(|reason| say(&format!("failed: {reason}")));
            return Ok(match stopped {
                Some(reason) => Outcome::Stopped(reason),
                None if useless.is_some() => Outcome::Rejected,
                None => Outcome::Good,
            });
        };
        let mut finding = Finding::of(&counterexample, &target, seed);
        let file = self.out.as_ref().map_or("bug.json".into(), |path| path.display().to_string());
        finding.test = finding.test.replace("PROBLEM", &file);
        if let Some(command) = command {
            finding.test = finding.test.replace("\"COMMAND\"", &quoted(command));
        }
        if let Some(path) = &self.out {
            file::write(path, format!("{}\n", finding.problem.to_json()))?;
        }
        print(&match json {
            true => in_json(&counterexample, &finding, seed),
            false => self.text(&counterexample, &finding, &target, seed),
        })?;
        Ok(match stopped {
            _ if target.measure == Measure::FalseClaim => Outcome::Rejected,
            Some(reason) => Outcome::Stopped(reason),
            None => Outcome::Good,
        })
    }

    /// The initial problems, with their names.
    fn problems(&self) -> Result<Vec<(String, Problem)>> {
        let mut given = Vec::new();
        for name in &self.from {
            for (name, problems) in problems::named(name, 1, Memory::default())? {
                problems.iter().for_each(warn);
                given.extend(problems.into_iter().map(|problem| (name.clone(), problem)));
            }
        }
        Ok(given)
    }

    fn target(
        &self,
        names: &[&str],
        solvers: &Registry,
        mut options: Options,
        given: &Given,
    ) -> Result<Target> {
        let wrong = |reason: &str| Error::invalid("options", "--measure", reason);
        let measure: Measure = self.measure[0].parse().map_err(|reason: String| wrong(&reason))?;
        let pair = self.measure.get(1).map(|pair| {
            pair.split_once(':').ok_or_else(|| wrong("a ratio needs two solvers, A:B"))
        });
        options.omega = self.omega.unwrap_or(options.omega);
        options.validate()?;
        let method = |name: &str| solvers.method(name, given.model).cloned();
        let (solver, baseline) = match (pair.transpose()?, names) {
            (Some((a, b)), _) => (method(a)?, Some(method(b)?)),
            (None, [name]) => (method(name)?, None),
            (None, _) => return Err(wrong("give one solver: --solver NAME or one --plugin")),
        };
        let target = Target {
            measure,
            solver,
            baseline,
            options,
            model: given.model,
            within: given.within,
            friction: if self.friction { Friction::Only } else { Friction::Any },
            allows_single_tangents: given.has_single_tangents,
            best_omega: self.omega.is_none(),
        };
        target.validate()?;
        Ok(target)
    }

    fn text(
        &self,
        counterexample: &Counterexample,
        finding: &Finding,
        target: &Target,
        seed: u64,
    ) -> String {
        let Counterexample { evaluation, shrinking, rows_at_first, value, value_at_first, .. } =
            counterexample;
        let measure = target.measure;
        let mut text = format!(
            "{measure} found at evaluation {evaluation} of seed {seed}, with {rows_at_first} rows; shrunk in \
             {shrinking} more evaluations\n"
        );
        let [value, at_first] = [*value, *value_at_first].map(|measure| readable(measure, 4));
        text += &format!("measure {value}; before shrinking {at_first}\n\n");
        text += &format!("{}\n\n", finding.words);
        text += &finding.equations();
        text += &format!("\n{}", finding.answers());
        match &self.out {
            Some(path) => text += &format!("\nproblem    {}\n", path.display()),
            None => text += &format!("\n{}\n", finding.problem.to_json()),
        }
        text += "\n";
        text += &match target.solver.group() {
            Group::Plugin => {
                let save = match self.out {
                    Some(_) => "",
                    None => "; --out bug.json writes the problem",
                };
                format!("test       {}   # exit code 1 until it is fixed{save}\n", finding.test)
            }
            _ => format!("{}\n", finding.test),
        };
        text
    }
}

fn in_json(counterexample: &Counterexample, finding: &Finding, seed: u64) -> String {
    let vector = |x: &[f64]| -> Value { x.iter().map(|&x| number(x)).collect() };
    let right = finding.right.as_ref();
    let object = json!({
        "found": true,
        "seed": seed,
        "evaluation": counterexample.evaluation,
        "value": counterexample.value,
        "value_at_first": counterexample.value_at_first,
        "rows_at_first": counterexample.rows_at_first,
        "shrinking": counterexample.shrinking,
        "words": finding.words,
        "x": finding.answer.as_deref().map(vector),
        "right_x": right.map(|right| vector(&right.x)),
        "right_x_source": right.map(|right| &right.source),
        "problem": finding.problem.to_json(),
        "test": finding.test,
    });
    format!("{object:#}\n")
}

/// Parses two integers separated by .., or one integer.
fn rows(text: &str) -> std::result::Result<RangeInclusive<usize>, String> {
    let number = |text: &str| text.parse().map_err(|_| format!("{text:?} is not a whole number"));
    match text.split_once("..") {
        Some((least, most)) => Ok(number(least)?..=number(most.trim_start_matches('='))?),
        None => number(text).map(|n| n..=n),
    }
}
