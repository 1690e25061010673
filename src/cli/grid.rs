//! `grid`: one scene or problem family at every point of a grid of settings.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use lcplab::error::Result;
use lcplab::report::grid::{Folder, Grid as File, collect, plan_table};
use lcplab::report::terminal;

use super::limits::Limits;
use super::plugin::Declared;
use super::{Outcome, bar, folder_of, print, say, threads};

/// Maximum number of rows of the plan that are printed.
const SHOWN: usize = 40;

/// Measure a scene or a problem family at every point of a grid of settings
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab grid plan omega      # the tasks of a shipped grid or of a grid file
  lcplab grid run omega       # on all cores; continues after an interruption
  lcplab grid collect omega   # grids/omega/results.csv, results.json and index.html

Tasks can run one by one, in any order and on several machines (grid run FILE --task K). On the same processor the \
collected results are bitwise identical; wall times go to a separate file, times.csv. If a point cannot be computed, \
its row gives the reason.

Exit codes:
  0  all results exist, and the judge rejects no claim
  1  the judge rejects a claim, or results are missing
  2  invalid input or usage")]
pub struct Grid {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Subcommand)]
enum Action {
    Plan(Plan),
    Run(Run),
    Collect(Collect),
}

/// Number the tasks and write plan.json
#[derive(Debug, Args)]
struct Plan {
    #[command(flatten)]
    place: Place,
    /// Print the plan as JSON instead of writing it
    #[arg(long)]
    json: bool,
}

/// Run the tasks that have no results yet, or one of them
#[derive(Debug, Args)]
struct Run {
    #[command(flatten)]
    place: Place,
    /// Run only the task of this number, even if it has a result
    #[arg(long)]
    task: Option<usize>,
    /// Number of threads; results are identical for any number [default: one per processor]
    #[arg(long, value_parser = threads())]
    threads: Option<u16>,
    #[command(flatten)]
    plugins: Declared,
}

/// Collect the results in tables and a page
#[derive(Debug, Args)]
struct Collect {
    #[command(flatten)]
    place: Place,
}

/// A grid and where its results are.
#[derive(Debug, Args)]
struct Place {
    /// Grid file, or name of a shipped grid
    grid: String,
    /// Folder for the results [default: grids/NAME]
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Place {
    fn open(&self) -> Result<(File, Folder)> {
        let grid = File::load(&self.grid)?;
        let folder = folder_of(self.out.as_deref(), "grids", &grid.name)?;
        let folder = Folder::new(&folder, &grid)?;
        Ok((grid, folder))
    }
}

impl Grid {
    pub(crate) fn run(&self, limits: &Limits) -> Result<Outcome> {
        match &self.action {
            Action::Plan(plan) => plan.run(),
            Action::Run(run) => run.run(limits),
            Action::Collect(collect) => collect.run(),
        }
    }
}

impl Plan {
    fn run(&self) -> Result<Outcome> {
        if self.json {
            let plan = File::load(&self.place.grid)?.plan()?;
            print(&format!("{}\n", serde_json::json!(plan)))?;
            return Ok(Outcome::Good);
        }
        let (grid, folder) = self.place.open()?;
        let path = folder.write_plan()?;
        print(&terminal::table(&plan_table(&grid, folder.plan(), SHOWN)))?;
        print(&format!("{}\n", path.display()))?;
        Ok(Outcome::Good)
    }
}

impl Run {
    fn run(&self, limits: &Limits) -> Result<Outcome> {
        let (grid, folder) = self.place.open()?;
        let (_running, solvers) = self.plugins.start(&self.place.grid, &grid.plugins)?;
        let folder = folder.with_solvers(solvers);
        if let Some(task) = self.task {
            let record = folder.run_one(task)?;
            let rejected = record.finding.and_then(|finding| finding.get("rejected"));
            return Ok(if rejected > Some(0.0) { Outcome::Rejected } else { Outcome::Good });
        }
        if let Some(threads) = self.threads {
            // Fails only if the pool already exists, and nothing has created it before.
            let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        }
        let plan = folder.plan();
        let progress = bar(plan.tasks.len() as u64, &plan.grid);
        let stop = limits.stop();
        let done = folder.run_missing(&progress, stop)?;
        limits.over();
        let (all, before) = (plan.tasks.len(), progress.position() as usize - done);
        progress.finish_and_clear();
        print(&format!("{done} of {all} tasks run, {before} were done before\n"))?;
        let stopped = stop.reason().filter(|_| done + before < all);
        Ok(stopped.map_or(Outcome::Good, Outcome::Stopped))
    }
}

impl Collect {
    fn run(&self) -> Result<Outcome> {
        let (grid, folder) = self.place.open()?;
        let collection = collect(&grid, &folder)?;
        let (done, missing) = (collection.done.len(), collection.missing.len());
        print(&format!(
            "{done} of {} tasks collected, {} impossible, {} false claims\n{}\n",
            done + missing,
            collection.impossible(),
            collection.sum("rejected"),
            folder.path().join("index.html").display(),
        ))?;
        if missing > 0 {
            let numbers = collection.missing.iter().take(20).map(ToString::to_string);
            let numbers = numbers.collect::<Vec<_>>().join(", ");
            let more = if missing > 20 { ", …" } else { "" };
            say(&format!("error: {missing} tasks have no results: {numbers}{more}"));
        }
        let good = missing == 0 && collection.sum("rejected") == 0;
        Ok(if good { Outcome::Good } else { Outcome::Rejected })
    }
}
