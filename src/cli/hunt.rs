//! `hunt`: tests solvers for false claims.

use std::sync::Arc;

use clap::{ArgGroup, Args};
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::hunt::{Hunt, KINDS, Progress, Record, Tally, problem_file};
use lcplab::lcp::friction::Model;
use lcplab::number::counted;
use lcplab::plugin::Plugin;
use lcplab::report::page::{Cell, Table};
use lcplab::report::terminal;
use lcplab::solver::{Method, Options, Registry, Settings, Solver, Stop};

use super::limits::Limits;
use super::options::{iterations, model_names};
use super::plugin::{Plugins, quoted, repeatable};
use super::search::{HuntOptions, SearchArgs};
use super::{Outcome, bar, print, say};

/// The defaults of options that a printed command repeats only if they have other values.
const MAX_ITERATIONS: usize = 2000;
const TOLERANCE: f64 = 1e-8;

/// Search for false claims of solvers on difficult random problems, or for the smallest problem on
/// which a solver fails
#[derive(Debug, Args)]
#[command(mut_arg("plugin", repeatable))]
#[command(group(ArgGroup::new("one").args(["measure", "problem"]).multiple(true)))]
#[command(after_help = "\
Examples:
  lcplab hunt --problems 100000 --seed 1              # several minutes
  lcplab hunt --problem 875 --seed 1 --out bug.json   # writes one of these problems to a file
  lcplab hunt --solver dantzig --json
  lcplab hunt --plugin \"python3 mine.py\" --problems 1000
  lcplab hunt --plugin \"python3 mine.py\" --measure false-claim --out bug.json
  lcplab hunt --plugin \"python3 mine.py\" --measure false-claim --from dump.json     # shrinks it
  lcplab hunt --plugin \"python3 mine.py\" --measure false-claim --model coulomb-cone # a solver of cones
  lcplab hunt --measure ratio murty:block-pivoting --n 8

Without --measure lcplab prints a table of the claims of each solver. With --measure lcplab starts from random \
problems, makes small changes that increase the measure (hill climbing), shrinks the worst problem, and prints \
it with the solver's x, the correct x and a regression test. The measure of a false claim is its scaled residual; that of a \
failure is the number of rows, and the smallest wins. The same seed finds the same problem. The options --n, --class, \
--friction, --from, --evaluations, --at-least and --omega apply only with --measure.

A false claim: a solver reports an x as solved that the judge rejects, or reports that no solution exists although one does.

Exit codes:
  0  no false claim, even if a search for another measure found a problem
  1  a claim is false, a solver that you name solves no problem, or the time limit was reached
  2  invalid input or usage
  130  stopped by Ctrl-C; the table of the finished problems is printed")]
pub struct Challenge {
    /// Number of problems; applies only if --measure is not given
    #[arg(long, default_value_t = 10_000)]
    problems: usize,
    /// Use only the problem with this number, which the table shows for a false claim; --out writes
    /// it to a file
    #[arg(long, value_name = "NUMBER", conflicts_with_all = ["problems", "measure"])]
    problem: Option<usize>,
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
    #[arg(long, visible_alias = "sweeps", allow_negative_numbers = true, value_parser = iterations, default_value_t = MAX_ITERATIONS)]
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
                command: self.plugins.commands().next(),
                solvers: &solvers,
            };
            return self.search.hunt(all, self.json, limits);
        }
        let count = if self.problem.is_some() { 1 } else { self.problems };
        let bar = bar(count as u64, "problems");
        let (stop, progress) = (limits.stop(), Arc::new(Progress::default()));
        let report = self.report(count, &plugins);
        let (forced, so_far) = (report.clone(), Arc::clone(&progress));
        limits.last_words(move || forced.print(&so_far.record()));
        let record = self.record(&names, &solvers, &options, stop, &progress, &|| bar.inc(1))?;
        limits.over();
        bar.finish_and_clear();
        report.print(&record)?;
        if let (Some(number), Some(path)) = (self.problem, self.search.out()) {
            let problem = problem_file(self.seed, number, self.model);
            file::write(path, format!("{}\n", problem.to_json()))?;
        }
        if let Some(reason) = stop.reason().filter(|_| record.problems < count) {
            return Ok(Outcome::Stopped(reason));
        }
        let useless: Vec<&Tally> = record
            .tallies
            .iter()
            .filter(|tally| names.contains(&&*tally.solver) && tally.right() == 0)
            .collect();
        for tally in &useless {
            let problems = counted(record.problems, "problem");
            say(&format!("failed: {} solves none of {problems}", tally.solver));
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
        progress: &Progress,
        tick: &(dyn Fn() + Sync),
    ) -> Result<Record> {
        let numbers = match self.problem {
            Some(number) => number..number.saturating_add(1),
            None => 0..self.problems,
        };
        let hunt = Hunt { numbers, seed: self.seed, tolerance: self.tolerance };
        if let Some(model) = self.model {
            let methods: Vec<Method> = match names {
                [] => registry.methods().filter(|m| m.takes(Some(model))).cloned().collect(),
                names => {
                    let of = |name: &&str| registry.method(name, Some(model)).cloned();
                    names.iter().map(of).collect::<Result<_>>()?
                }
            };
            return Ok(hunt.under(model, stop, &methods, options, progress, tick));
        }
        let solvers: Vec<Box<dyn Solver>> = match names {
            [] => Registry::standard().entries().map(|entry| entry.build(options)).collect(),
            names => {
                let build = |name: &&str| Ok(registry.entry(name)?.build(options));
                names.iter().map(build).collect::<Result<_>>()?
            }
        };
        let record = hunt.until(stop, &solvers, progress, tick);
        if !names.is_empty() || self.problem.is_some() {
            return Ok(record);
        }
        // As many contacts as problems of each kind.
        let contacts = self.problems.div_ceil(KINDS.len());
        Ok(hunt.with_cones(contacts, stop, &options.settings, progress))
    }

    fn report(&self, count: usize, plugins: &[Plugin]) -> Report {
        let mut options = format!(" --seed {}", self.seed);
        if self.tolerance != TOLERANCE {
            options += &format!(" --tolerance {:e}", self.tolerance);
        }
        if self.max_iterations != MAX_ITERATIONS {
            options += &format!(" --max-iterations {}", self.max_iterations);
        }
        let commands = plugins.iter().map(|plugin| plugin.name().to_string());
        let commands = commands.zip(self.plugins.commands().map(String::from)).collect();
        Report { json: self.json, model: self.model, seed: self.seed, count, options, commands }
    }
}

/// How the record of a hunt is printed, also when the program is ended.
#[derive(Debug, Clone)]
struct Report {
    json: bool,
    model: Option<Model>,
    seed: u64,
    /// The number of problems that the hunt was to give.
    count: usize,
    /// The options that a command for one problem repeats.
    options: String,
    /// The plug-ins and their commands.
    commands: Vec<(String, String)>,
}

impl Report {
    fn print(&self, record: &Record) -> Result<()> {
        print(&if self.json { json(record)? } else { self.words(record) })
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
        words += &format!(": {}\n", counted(false_claim_count, "false claim"));
        if record.problems < self.count {
            words += &unfinished(record, self.count);
        }
        for tally in &record.tallies {
            for (number, kind, what) in &tally.false_claims {
                words += &format!("  {} on problem {number} ({kind}): {what}\n", tally.solver);
                words += &format!("    {}\n", self.command(&tally.solver, *number));
            }
        }
        words
    }

    /// The command that writes a problem of the hunt to a file.
    fn command(&self, solver: &str, number: usize) -> String {
        let (solver, is_cone) = match solver.strip_suffix(Record::ON_CONES) {
            Some(solver) => (solver, true),
            None => (solver, false),
        };
        let model = if is_cone { Some(Model::CoulombCone) } else { self.model };
        let model = model.map_or(String::new(), |model| format!(" --model {model}"));
        let solver = match self.commands.iter().find(|(name, _)| name == solver) {
            Some((_, command)) => format!("--plugin {}", quoted(command)),
            None => format!("--solver {solver}"),
        };
        format!("lcplab hunt {solver}{model} --problem {number}{} --out bug.json", self.options)
    }
}

/// Which problems a hunt that was stopped has tested, as a sentence.
fn unfinished(record: &Record, count: usize) -> String {
    let Some(last) = record.given.checked_sub(1) else {
        return format!("stopped before the first of {count} problems\n");
    };
    let except: Vec<String> = record.unfinished.iter().map(ToString::to_string).collect();
    let except = match except.as_slice() {
        [] => String::new(),
        numbers => format!(", except {}, which were not finished", numbers.join(", ")),
    };
    format!("stopped: of {count} problems, numbers 0 to {last} were tested{except}\n")
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
