//! `hunt`: tests solvers for false claims.

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::hunt::{Hunt, KINDS, Record, Tally};
use lcplab::lcp::friction::Model;
use lcplab::number::counted;
use lcplab::report::page::{Cell, Table};
use lcplab::report::terminal;
use lcplab::solver::{Method, Options, Registry, Settings, Solver, Stop};

use super::limits::Limits;
use super::options::model_names;
use super::plugin::{Plugins, repeatable};
use super::search::{HuntOptions, SearchArgs};
use super::{Outcome, bar, print, say};

/// Search for false claims of solvers on difficult random problems, or for the smallest problem on
/// which a solver fails
#[derive(Debug, Args)]
#[command(mut_arg("plugin", repeatable))]
#[command(after_help = "\
Examples:
  lcplab hunt --problems 100000 --seed 1
  lcplab hunt --solver dantzig --json
  lcplab hunt --plugin \"python3 mine.py\" --problems 1000
  lcplab hunt --plugin \"python3 mine.py\" --measure false-claim --out bug.json
  lcplab hunt --plugin \"python3 mine.py\" --measure false-claim --from dump.json     # shrinks it
  lcplab hunt --plugin \"python3 mine.py\" --measure false-claim --model coulomb-cone # friction cones
  lcplab hunt --measure ratio murty:block-pivoting --n 8

Without --measure lcplab prints a table of the claims of each solver. With --measure lcplab starts from random \
problems, makes small changes that increase the measure (hill climbing), shrinks the worst problem, and prints \
it with the solver's x, the correct x and a regression test. The measure of a false claim is its scaled residual; that of a \
failure is the number of rows, and the smallest wins. The same seed finds the same problem. The options --n, --class, \
--friction, --from, --evaluations, --at-least, --omega and --out apply only with --measure.

A false claim: a solver reports an x as solved that the judge rejects, or reports that no solution exists although one does.

Exit codes:
  0  no false claim, even if a search for another measure found a problem
  1  a claim is false, or a solver that you name solves no problem
  2  invalid input or usage")]
pub struct Challenge {
    /// Number of problems; applies only if --measure is not given
    #[arg(long, default_value_t = 10_000)]
    problems: usize,
    /// Random seed
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Examine this solver (repeatable) [default: the plug-ins, or all solvers]
    #[arg(long)]
    solver: Vec<String>,
    #[arg(long, help = format!(
        "Use problems with friction under this model: {} [default with --from: the model of the \
         files]",
        model_names()
    ))]
    model: Option<Model>,
    /// Maximum number of sweeps or pivots
    #[arg(long, visible_alias = "sweeps", default_value_t = 2000)]
    max_iterations: usize,
    /// Largest scaled residual of an accepted answer
    #[arg(long, default_value = "1e-8")]
    tolerance: f64,
    #[command(flatten)]
    search: SearchArgs,
    #[command(flatten)]
    plugins: Plugins,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl Challenge {
    pub fn run(&self, limits: &Limits) -> Result<Outcome> {
        let (tolerance, max_iterations) = (self.tolerance, self.max_iterations);
        let settings =
            Settings::default().with_tolerance(tolerance).with_max_iterations(max_iterations);
        let options = Options::default().with_settings(settings);
        options.validate()?;
        let (plugins, solvers) = self.plugins.start()?;
        let named = self.solver.iter().map(String::as_str);
        let names: Vec<&str> =
            named.chain(plugins.iter().map(|plugin| -> &str { plugin.name() })).collect();
        if self.search.is_given() {
            let all = HuntOptions {
                names: &names,
                model: self.model,
                options,
                seed: self.seed,
                command: self.plugins.first(),
                solvers: &solvers,
            };
            return self.search.hunt(all, self.json, limits);
        }
        let progress = bar(self.problems as u64, "problems");
        let stop = limits.stop();
        let record = self.record(&names, &solvers, &options, stop, &|| progress.inc(1))?;
        let stopped = stop.reason().filter(|_| record.problems < self.problems);
        limits.over();
        progress.finish_and_clear();
        print(&if self.json { json(&record)? } else { self.words(&record) })?;
        let useless: Vec<&Tally> = record
            .tallies
            .iter()
            .filter(|tally| names.contains(&&*tally.solver) && tally.right() == 0)
            .collect();
        if let Some(reason) = stopped.filter(|_| record.has_no_false_claims()) {
            return Ok(Outcome::Stopped(reason));
        }
        for tally in &useless {
            let problems = record.problems;
            say(&format!("failed: {} solves none of {problems} problems", tally.solver));
        }
        Ok(match record.has_no_false_claims() && useless.is_empty() {
            true => Outcome::Good,
            false => Outcome::Rejected,
        })
    }

    /// The claims of the solvers with these names, or of all, on the problems.
    fn record(
        &self,
        names: &[&str],
        registry: &Registry,
        options: &Options,
        stop: &Stop,
        tick: &(dyn Fn() + Sync),
    ) -> Result<Record> {
        let hunt = Hunt { problems: self.problems, seed: self.seed, tolerance: self.tolerance };
        if let Some(model) = self.model {
            let methods: Vec<Method> = match names {
                [] => registry.methods().filter(|m| m.takes(Some(model))).cloned().collect(),
                names => {
                    let of = |name: &&str| registry.method(name, Some(model)).cloned();
                    names.iter().map(of).collect::<Result<_>>()?
                }
            };
            return Ok(hunt.under(model, stop, &methods, options, tick));
        }
        let solvers: Vec<Box<dyn Solver>> = match names {
            [] => Registry::standard().entries().map(|entry| entry.build(options)).collect(),
            names => {
                let build = |name: &&str| Ok(registry.entry(name)?.build(options));
                names.iter().map(build).collect::<Result<_>>()?
            }
        };
        let record = hunt.until(stop, &solvers, tick);
        if !names.is_empty() || stop.reason().is_some() {
            return Ok(record);
        }
        // As many contacts as problems of each kind.
        let contacts = self.problems.div_ceil(KINDS.len());
        Ok(record.with_cones(self.seed, contacts, &options.settings))
    }

    fn words(&self, record: &Record) -> String {
        let mut words = terminal::table(&table(record));
        let kinds = match self.model {
            Some(model) => format!("with friction under {model}"),
            None => format!("of {} kinds", KINDS.len()),
        };
        words += &format!("{} {kinds}, seed {}", counted(record.problems, "problem"), self.seed);
        if record.contacts > 0 {
            words += &format!(", and {} with a cone", counted(record.contacts, "contact"));
        }
        let false_claim_count: usize =
            record.tallies.iter().map(|tally| tally.false_claim_count).sum();
        words += &format!(": {false_claim_count} false claims\n");
        for tally in &record.tallies {
            for (number, kind, what) in &tally.false_claims {
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
            tally.false_claim_count,
        ];
        std::iter::once(Cell::text(&tally.solver)).chain(counts.map(Cell::count)).collect()
    };
    Table::new(
        "Claims",
        "A rejected answer to a problem that has no solution is no false claim.",
        "solver | #proved | #within tolerance | #rejected | #no solution | #unsolved | \
         #outside class | #false claims",
        record.tallies.iter().map(row).collect(),
    )
}
