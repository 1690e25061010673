//! A grid as a section of a report: its points are tasks like those of any study.
//!
//! `lcplab grid` does the same points one file each, for machines that share a folder and nothing
//! else.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::error::{Error, Result};
use crate::report::grid::{self, Finding, Grid, measure};
use crate::report::view::attempt::anchor;

/// A grid file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "Settings", into = "Settings")]
pub struct Plan {
    /// The file.
    pub grid: Grid,
    /// Its points.
    pub plan: grid::Plan,
    /// Whether the points are taken one after the other and the report shows how long each took.
    pub timed: bool,
    name: String,
}

/// What a report file says of a grid.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// A grid file, or the name of a shipped grid.
    grid: String,
    /// Take the points one after the other, and show how long each took in the section of times.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    timed: bool,
    /// The file itself; it is written with the results, so that they are drawn again without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    source: Option<String>,
}

/// What was found at a point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// The number of the point, from 1.
    pub task: usize,
    /// What was found.
    pub finding: Finding,
}

/// How long a point took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// The number of the point, from 1.
    pub task: usize,
    /// The wall time of stepping and solving (s); `None` where it was not solved.
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
    type Finding = Found;
    type Times = Option<Seconds>;

    fn alone(&self) -> bool {
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

    fn run(&self, task: usize) -> Result<(Found, Option<Seconds>)> {
        let task = &self.plan.tasks[task];
        let (finding, seconds) = measure::run(task, &self.grid)?;
        let seconds = Some(seconds).filter(|_| finding.status == "solved");
        let times = self.timed.then_some(Seconds { task: task.task, seconds });
        Ok((Found { task: task.task, finding }, times))
    }
}
