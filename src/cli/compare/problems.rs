//! `compare` on problems: the problem library or problem files × the solvers.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use indicatif::ProgressStyle;
use lcplab::error::{Error, Result};
use lcplab::lcp::Question;
use lcplab::lcp::file::Problem;
use lcplab::lcp::friction::Model;
use lcplab::lcp::library::{self, Family};
use lcplab::memory::Memory;
use lcplab::plugin::Plugin;
use lcplab::report::study::families::{self, Contender, Models, Row};
use lcplab::report::study::problems;
use lcplab::report::{methods, terminal, view};
use lcplab::solver::Registry;

use super::{Compare, FAMILY, profile};
use crate::cli::limits::Limits;
use crate::cli::{Outcome, bar, print, say, warn};

/// Options of a comparison on problems.
#[derive(Debug, Args)]
pub struct ProblemArgs {
    /// Run all solvers instead of one of each kind
    #[arg(long, conflicts_with = "solver")]
    all: bool,
    /// Number of problems of each random family: the seeds 1 to COUNT [default: 3]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    seeds: Option<u32>,
    /// Abandon a solve by a built-in solver after this time [default: no limit]
    #[arg(long, value_name = "SECONDS")]
    solve_time_limit: Option<f64>,
    /// Write a performance profile of the wall times as NAME.svg, NAME.csv and NAME.tex, and all
    /// results as NAME_problems.csv
    #[arg(long, value_name = "NAME")]
    profile: Option<PathBuf>,
}

/// Seeds of each family, if none are stated.
const SEEDS: u32 = 3;

impl ProblemArgs {
    /// The first option that is given.
    pub fn given(&self) -> Option<&'static str> {
        [
            ("--all", self.all),
            ("--seeds", self.seeds.is_some()),
            ("--solve-time-limit", self.solve_time_limit.is_some()),
            ("--profile", self.profile.is_some()),
        ]
        .iter()
        .find_map(|(name, is_given)| is_given.then_some(*name))
    }

    /// How long a solve may take.
    fn each(&self) -> Result<Option<Duration>> {
        let Some(seconds) = self.solve_time_limit else { return Ok(None) };
        match Duration::try_from_secs_f64(seconds) {
            Ok(limit) if !limit.is_zero() => Ok(Some(limit)),
            _ => {
                let reason = format!("must be above 0, is {seconds}");
                Err(Error::invalid("options", "--solve-time-limit", reason))
            }
        }
    }
}

impl Compare {
    pub(super) fn on_problems(&self, limits: &Limits) -> Result<Outcome> {
        let settings = self.solve.with_defaults();
        let mut problems = self.named(settings.memory())?;
        if !self.model.is_empty() {
            problems.retain(|(_, problems)| problems.iter().any(|p| p.friction().is_some()));
        }
        if problems.is_empty() {
            return Err(Error::invalid(
                "options",
                "--model",
                "none of these families has friction",
            ));
        }
        self.check_models(&problems)?;
        for (name, reason) in
            problems.iter().filter(|_| self.model.is_empty()).filter_map(only_boxed)
        {
            say(&format!("note: {name}: compared only as a coupled box, because it {reason}"));
        }
        let (plugins, solvers) = self.plugins.start()?;
        let contenders = self.contenders(&plugins, &solvers)?;
        let methods = contenders.iter().flat_map(|contender| &contender.methods);
        let options = settings.options(methods)?;
        let stop = limits.stop();
        let (library, files): (Vec<_>, Vec<_>) =
            problems.into_iter().partition(|(name, _)| library::by_name(name).is_ok());
        let style = ProgressStyle::with_template("{spinner} {pos} rows of the table")
            .unwrap_or_else(|_| ProgressStyle::default_spinner());
        let progress = bar(0, "").with_style(style);
        let all = families::Limits {
            stop,
            each: self.problems.each()?,
            motion: None,
            search: false,
            tick: &|| progress.inc(1),
        };
        let run = |problems: &[(String, Vec<Problem>)], models: Models<'_>| {
            let models = if self.model.is_empty() { models } else { Models::Stated(&self.model) };
            families::run_on(problems, models, &contenders, &options, &all)
        };
        let mut rows = run(&library, Models::Usual(&Model::ALL));
        // A file states its friction model.
        rows.extend(run(&files, Models::Stated(&[])));
        // A file may lack the forces at which a box is frozen.
        rows.retain(|row| row.problems > 0);
        let stopped = stop.reason();
        limits.over();
        progress.finish_and_clear();
        if rows.is_empty() && stopped.is_none() {
            return Err(self.nothing_to_compare());
        }
        match &self.problems.profile {
            Some(name) if stopped.is_none() => profile::write(name, &rows)?,
            Some(_) => say("warning: no profile was written, because the comparison was stopped"),
            None => {}
        }
        let failures = match stopped {
            None => families::useless(&rows, &contenders),
            Some(_) => Vec::new(),
        };
        if self.json {
            let object = serde_json::json!({ "rows": rows, "failures": failures });
            print(&format!("{object}\n"))?;
        } else {
            print(&terminal::table(&view::families_table(&rows)))?;
            let is_one = rows.windows(2).all(|pair| pair[0].family == pair[1].family);
            if !is_one {
                print(&terminal::table(&view::solvers_table(&rows)))?;
            }
        }
        failures.iter().for_each(|failure| say(&format!("failed: {failure}")));
        Ok(match stopped {
            Some(reason) => Outcome::Stopped(reason),
            None if failures.is_empty() && !rows.iter().any(Row::is_wrong) => Outcome::Good,
            None => Outcome::Rejected,
        })
    }

    /// Reports which problems cannot be stated under a requested model.
    ///
    /// # Errors
    /// If a problem cannot be stated under the model that its own file names.
    fn check_models(&self, problems: &[(String, Vec<Problem>)]) -> Result<()> {
        for (name, problem) in
            problems.iter().flat_map(|(name, all)| all.iter().map(move |p| (name, p)))
        {
            let own = problem.model.iter().filter(|_| self.model.is_empty());
            // Tangents that are not pairs can only form a coupled box.
            let is_open = |model: &&Model| **model != Model::CoupledBox;
            for model in own.filter(is_open) {
                Question::new(problem, Some(*model), name)?;
            }
            for model in self.model.iter().filter(is_open) {
                if let Err(error) = Question::new(problem, Some(*model), name) {
                    say(&format!("note: left out under {model}: {error}"));
                }
            }
        }
        Ok(())
    }

    /// Why there are no rows: because of the given options, or of the problems themselves.
    fn nothing_to_compare(&self) -> Error {
        let (key, reason) = match (self.solver.is_empty(), self.model.is_empty()) {
            (true, true) => ("problems", "no solver can solve any of these"),
            (true, false) => ("--model", "none of these problems can be stated under this model"),
            (false, true) => ("--solver", "can solve none of these problems"),
            (false, false) => (
                "--solver, --model",
                "none of these solvers can solve any of these problems under this model",
            ),
        };
        Error::invalid("options", key, reason)
    }

    /// The problems of each family or file.
    fn named(&self, memory: Memory) -> Result<Vec<(String, Vec<Problem>)>> {
        let names: Vec<&str> = match self.inputs.as_slice() {
            [] => library::all().map(Family::name).collect(),
            names => names.iter().map(|name| name.strip_prefix(FAMILY).unwrap_or(name)).collect(),
        };
        let seeds = self.problems.seeds.unwrap_or(SEEDS);
        let mut problems = Vec::new();
        for name in names {
            problems.extend(problems::named(name, seeds, memory)?);
        }
        problems.iter().flat_map(|(_, problems)| problems).for_each(warn);
        Ok(problems)
    }

    /// The solvers that take part: those that were named, or the usual ones, and the plug-ins.
    fn contenders(&self, plugins: &[Plugin], solvers: &Registry) -> Result<Vec<Contender>> {
        let usual =
            |name: &&str| Ok(Contender { is_named: false, ..Contender::named(name, solvers)? });
        let mut contenders = match (self.problems.all, self.solver.as_slice()) {
            (true, _) => Contender::unnamed(solvers.methods().cloned()),
            (false, []) => methods::USUAL.iter().map(usual).collect::<Result<_>>()?,
            (false, _) => Vec::new(),
        };
        let named = self.solver.iter().map(String::as_str);
        for name in named.chain(plugins.iter().map(|plugin| -> &str { plugin.name() })) {
            contenders.push(Contender::named(name, solvers)?);
        }
        Ok(contenders)
    }
}

/// The name of problems whose friction rows are not pairs of tangents, and what they are instead.
fn only_boxed((name, problems): &(String, Vec<Problem>)) -> Option<(&str, String)> {
    let friction = problems.iter().find_map(|problem| problem.friction()?.err())?;
    Some((name, format!("has no pairs of tangents: {friction}")))
}
