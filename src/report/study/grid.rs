//! A grid as a section of a report, with its points as tasks.
//!
//! `lcplab grid` runs the same points with one file each, for machines that share only a folder.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Study, clock};
use crate::error::{Error, Result};
use crate::report::grid::{self, Finding, Grid, measure};
use crate::report::view::attempt::anchor;
use crate::solver::Registry;

/// A grid file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "Settings", into = "Settings")]
pub struct Plan {
    /// The file.
    pub grid: Grid,
    /// Its points.
    pub plan: grid::Plan,
    /// Whether the points are run one after the other and the report shows their times.
    pub timed: bool,
    name: String,
}

/// The settings of a grid in a report file.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// A grid file, or the name of a shipped grid.
    grid: String,
    /// Run the points one after the other, and show their times in the section of times.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    timed: bool,
    /// The content of the file; it is stored with the results, so that they can be drawn again
    /// without the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    source: Option<String>,
}

/// The result at a point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointResult {
    /// The number of the point, from 1.
    pub task: usize,
    /// The result.
    pub finding: Finding,
}

/// The time of a point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// The number of the point, from 1.
    pub task: usize,
    /// The wall time of stepping and solving (s); `None` if it was not solved.
    pub seconds: Option<f64>,
}

impl TryFrom<Settings> for Plan {
    type Error = Error;

    fn try_from(Settings { grid: name, timed, source }: Settings) -> Result<Self> {
        let grid = match source {
            Some(text) => Grid::from_toml(&name, &text)?,
            None => Grid::load(&name)?,
        };
        if !grid.plugins.is_empty() {
            let reason = "of a grid in a report must be declared in the report file";
            return Err(Error::invalid(name, "plugins", reason));
        }
        Ok(Plan { plan: grid.plan()?, grid, timed, name })
    }
}

impl From<Plan> for Settings {
    fn from(Plan { name, grid, timed, .. }: Plan) -> Self {
        Settings { grid: name, timed, source: Some(grid.source().into()) }
    }
}

impl Study for Plan {
    const NAME: &'static str = "grid";
    type Finding = PointResult;
    type Times = Option<Seconds>;

    fn alone(&self, _task: usize) -> bool {
        self.timed
    }

    fn named(&self) -> Option<(String, String)> {
        let name = Some(anchor(&self.grid.name)).filter(|name| !name.is_empty());
        Some((name.unwrap_or_else(|| Self::NAME.into()), self.grid.title.clone()))
    }

    fn tasks(&self) -> Vec<String> {
        let setting = |task: &grid::Task, path: &String| {
            format!("{} = {}", self.grid.label(path), task.shown(path))
        };
        let name = |task: &grid::Task| {
            let settings: Vec<String> =
                self.plan.axes.iter().map(|path| setting(task, path)).collect();
            settings.join(", ")
        };
        self.plan.tasks.iter().map(name).collect()
    }

    fn run(&self, task: usize, solvers: &Registry) -> Result<(PointResult, Option<Seconds>)> {
        let task = &self.plan.tasks[task];
        let (finding, mut seconds) = measure::run(task, &self.grid, solvers)?;
        if self.timed {
            clock::repeat(seconds, || {
                let again = measure::run(task, &self.grid, solvers);
                let again = again.map_or(f64::INFINITY, |(_, seconds)| seconds);
                seconds = seconds.min(again);
                again
            });
        }
        let seconds = Some(seconds).filter(|_| finding.status == "solved");
        let times = self.timed.then_some(Seconds { task: task.task, seconds });
        Ok((PointResult { task: task.task, finding }, times))
    }
}
