//! `hunt`: are the solvers honest?

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::hunt::{Hunt, KINDS, Record, Tally};
use lcplab::report::page::{Cell, Column, Table};
use lcplab::report::text;
use lcplab::solver::{ALL, Options, Settings, Solver, entry};

use super::limits::Limits;
use super::plugin::Plugins;
use super::search::Quarry;
use super::{Outcome, bar, print};

/// Give random hostile problems to the solvers and look for claims that are not true, or search for the
/// smallest problem that breaks one
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  lcplab hunt --problems 100000 --seed 1
  lcplab hunt --solver dantzig --json
  lcplab hunt --plugin \"python3 mine.py\" --problems 1000
  lcplab hunt --plugin \"python3 mine.py\" --measure lie --out bug.json
  lcplab hunt --plugin \"python3 mine.py\" --measure lie --from dump.json    # makes a problem of yours smaller
  lcplab hunt --measure ratio murty:block-pivoting --n 8

Without --measure it prints a table of what was claimed of so many problems. With it, it climbs from
random problems by small changes, makes the best one as small as it can, and prints it with its exact
solution and a test. The same seed finds the same. Exit code 1 if a solver's claim is false.")]
pub struct Challenge {
    /// How many problems
    #[arg(long, default_value_t = 10_000)]
    problems: usize,
    /// Random seed
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only this solver (repeatable), and the plug-ins [default: all solvers]
    #[arg(long)]
    solver: Vec<String>,
    /// Most sweeps or pivots: enough for an answer, few enough for many problems
    #[arg(long, visible_alias = "sweeps", default_value_t = 2000)]
    max_iterations: usize,
    /// Largest scaled residual that counts as solved
    #[arg(long, default_value_t = Settings::default().tolerance)]
    tolerance: f64,
    #[command(flatten)]
    quarry: Quarry,
    #[command(flatten)]
    plugins: Plugins,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Challenge {
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        let (tolerance, max_iterations) = (self.tolerance, self.max_iterations);
        let settings = Settings { tolerance, max_iterations, ..Settings::default() };
        let options = Options { settings, ..Options::default() };
        options.validate()?;
        let plugins = self.plugins.start()?;
        let named = self.solver.iter().map(String::as_str);
        let names: Vec<&str> =
            named.chain(plugins.iter().map(|plugin| -> &str { plugin.name() })).collect();
        if self.quarry.is_given() {
            return self.quarry.hunt(
                &names,
                options,
                self.seed,
                self.json,
                self.plugins.first(),
                limits,
            );
        }
        let solvers: Vec<Box<dyn Solver>> = match names.as_slice() {
            [] => ALL.iter().map(|entry| (entry.build)(&options)).collect(),
            names => {
                let build = |name: &&str| Ok((entry(name)?.build)(&options));
                names.iter().map(build).collect::<Result<_>>()?
            }
        };
        let hunt = Hunt { problems: self.problems, seed: self.seed, tolerance };
        let progress = bar(self.problems as u64, "problems");
        let stop = limits.stop();
        let mut record = hunt.until(stop, &solvers, &|| progress.inc(1));
        if names.is_empty() && stop.reason().is_none() {
            let contacts = self.problems.div_ceil(KINDS.len()); // as many as problems of a kind
            record = record.with_cones(self.seed, contacts, &options.settings);
        }
        let stopped = stop.reason().filter(|_| record.problems < self.problems);
        limits.over();
        progress.finish_and_clear();
        print(&if self.json { json(&record)? } else { self.words(&record) })?;
        Ok(match stopped {
            _ if !record.is_honest() => Outcome::Refuted,
            Some(reason) => Outcome::Stopped(reason),
            None => Outcome::Good,
        })
    }

    fn words(&self, record: &Record) -> String {
        let mut words = text::table(&table(record));
        words +=
            &format!("{} problems of {} kinds, seed {}", record.problems, KINDS.len(), self.seed);
        if record.contacts > 0 {
            words += &format!(", and {} contacts with a cone", record.contacts);
        }
        let lied: usize = record.tallies.iter().map(|tally| tally.lied).sum();
        words += &format!(": {lied} untrue claims\n");
        for tally in &record.tallies {
            for (number, kind, what) in &tally.lies {
                words += &format!("  {} on problem {number} ({kind}): {what}\n", tally.solver);
            }
        }
        words
    }
}

fn json(record: &Record) -> Result<String> {
    let json = serde_json::to_string_pretty(record);
    json.map(|json| json + "\n")
        .map_err(|cause| Error::invalid("hunt", "record", cause.to_string()))
}

fn table(record: &Record) -> Table {
    let row = |tally: &Tally| {
        let counts = [
            tally.proved,
            tally.within,
            tally.refused,
            tally.impossible,
            tally.unsolved,
            tally.outside,
            tally.lied,
        ];
        std::iter::once(Cell::text(&tally.solver)).chain(counts.map(Cell::count)).collect()
    };
    Table {
        title: "Claims".into(),
        columns: std::iter::once(Column::words("solver"))
            .chain(
                ["proved", "within", "refused", "impossible", "unsolved", "outside", "untrue"]
                    .map(|name| Column::numbers(name, "")),
            )
            .collect(),
        rows: record.tallies.iter().map(row).collect(),
        ..Table::default()
    }
}
