//! The folder of a grid's results: the plan, and one file per task, each written completely or not
//! at all.

use std::path::{Path, PathBuf};
use std::time::Duration;

use indicatif::ProgressBar;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use super::file::Grid;
use super::measure::{self, Finding};
use super::plan::{Plan, Task};
use crate::error::{Error, Result};
use crate::file;
use crate::json;
use crate::memory::Memory;
use crate::report::methods::with_reference;
use crate::report::tasks::Tasks;
use crate::solver::{Registry, Stop};

/// The file of the plan in the folder.
const PLAN: &str = "plan.json";

/// A folder with the plan and the results of a grid.
#[derive(Debug, Clone)]
pub struct Folder {
    path: PathBuf,
    plan: Plan,
    grid: Grid,
    solvers: Registry,
}

/// The stored result of a task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The number of the task.
    pub task: usize,
    /// The hash of its plan.
    pub plan: String,
    /// The result.
    pub finding: Option<Finding>,
    /// Why there is no result: the settings give no scene or problem.
    pub reason: Option<String>,
    /// The machine-dependent data.
    pub machine: Machine,
}

/// Where a task was run, and how fast.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// System and processor.
    pub platform: String,
    /// Wall time of stepping and solving (s).
    pub seconds: f64,
}

impl Folder {
    /// The folder of a grid, which need not exist yet.
    ///
    /// # Errors
    /// If it contains another plan, or a link instead of the plan, or a scene of the grid cannot be
    /// read.
    pub fn new(path: &Path, grid: &Grid) -> Result<Self> {
        let plan = grid.plan()?;
        let file = file::inside(path, PLAN)?;
        if let Some(found) = read(&file)? {
            check(&file, found["hash"].as_str().unwrap_or("none"), &plan.hash)?;
        }
        let solvers = with_reference().clone();
        Ok(Folder { path: path.into(), plan, grid: grid.clone(), solvers })
    }

    /// The same with the solvers of another registry.
    #[must_use]
    pub(crate) fn with_solvers(self, solvers: Registry) -> Self {
        Folder { solvers, ..self }
    }

    /// The plan.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the plan.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(crate) fn write_plan(&self) -> Result<PathBuf> {
        file::write_in(&self.path, PLAN, &pretty(&self.plan)?)?;
        Ok(self.path.join(PLAN))
    }

    /// Runs one task, even if its result exists, and stores the result.
    ///
    /// # Errors
    /// If there is no such task, or its result cannot be written. If the task's settings give no
    /// problem, that is not an error: the reason is the result.
    pub fn run_one(&self, number: usize) -> Result<Record> {
        let task = self.plan.tasks.iter().find(|task| task.task == number).ok_or_else(|| {
            let reason = format!("there is no task {number}, only 1 to {}", self.plan.tasks.len());
            Error::invalid(&self.plan.grid, "task", reason)
        })?;
        let record = self.done(task);
        self.keep(&record)?;
        Ok(record)
    }

    /// Runs all tasks without a result, on the threads of rayon's pool, until a stop; returns how
    /// many were run.
    ///
    /// # Errors
    /// If a result cannot be written, or an existing one belongs to another plan.
    pub fn run_missing(&self, progress: &ProgressBar, stop: &Stop) -> Result<usize> {
        self.write_plan()?;
        let mut missing = Vec::new();
        for task in &self.plan.tasks {
            if self.record(task.task)?.is_none() {
                missing.push(task.clone());
            }
        }
        progress.set_length(self.plan.tasks.len() as u64);
        progress.set_position((self.plan.tasks.len() - missing.len()) as u64);
        let (folder, mut done) = (self.clone(), 0);
        let tasks = Tasks { together: missing, alone: Vec::new(), grace: Duration::ZERO };
        tasks.run(
            stop,
            move |task| folder.done(task),
            |_, record| {
                self.keep(&record)?;
                progress.inc(1);
                done += 1;
                Ok(())
            },
        )?;
        Ok(done)
    }

    /// The result of a task, if it exists.
    ///
    /// # Errors
    /// If it cannot be read, or belongs to another plan.
    pub fn record(&self, number: usize) -> Result<Option<Record>> {
        let path = file::inside(&self.path, name(number))?;
        let Some(found) = read(&path)? else { return Ok(None) };
        let record: Record =
            serde_json::from_value(found).map_err(|cause| unreadable(&path, &cause))?;
        check(&path, &record.plan, &self.plan.hash)?;
        Ok(Some(record))
    }

    fn done(&self, task: &Task) -> Record {
        let (finding, reason, seconds) = match measure::run(task, &self.grid, &self.solvers) {
            Ok((finding, seconds)) => (Some(finding), None, seconds),
            Err(reason) => (None, Some(reason.to_string()), 0.0),
        };
        let platform = format!("{} on {}", std::env::consts::OS, std::env::consts::ARCH);
        let machine = Machine { platform, seconds };
        let plan = self.plan.hash.clone();
        Record { task: task.task, plan, finding, reason, machine }
    }

    fn keep(&self, record: &Record) -> Result<()> {
        file::write_in(&self.path, name(record.task), &pretty(record)?)
    }
}

/// The file of a task's result in the folder.
fn name(task: usize) -> String {
    format!("tasks/{task}.json")
}

/// The JSON of a file; `None` if there is no such file.
fn read(path: &Path) -> Result<Option<Json>> {
    if !path.try_exists().map_err(|cause| Error::file(path, &cause))? {
        return Ok(None);
    }
    let text = file::read(path, Memory::default())?;
    json::parse(&text).map(Some).map_err(|cause| unreadable(path, &cause))
}

fn check(path: &Path, found: &str, wanted: &str) -> Result<()> {
    if found == wanted {
        return Ok(());
    }
    let reason = format!(
        "belongs to plan {found}, and the grid is now plan {wanted}: its file, a scene or lcplab \
         has changed; take another folder, or delete this one"
    );
    Err(Error::File { path: path.display().to_string(), reason })
}

fn unreadable(path: &Path, cause: &serde_json::Error) -> Error {
    Error::File { path: path.display().to_string(), reason: format!("is not a result: {cause}") }
}

/// Indented JSON with a final line feed.
pub(super) fn pretty(value: &impl Serialize) -> Result<String> {
    let json = serde_json::to_string_pretty(value);
    json.map(|json| json + "\n")
        .map_err(|cause| Error::invalid("grid", "results", cause.to_string()))
}
