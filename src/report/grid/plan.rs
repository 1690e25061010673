//! The plan of a grid: its numbered tasks, and the hash of everything that determines them.

use serde::Serialize;
use toml::{Table, Value};

use super::super::hash::fnv;
use super::file::{Grid, REPEAT, SUBJECT};
use crate::csv;
use crate::error::{Error, Result};
use crate::scene;

/// Maximum number of tasks of a grid.
const MOST_TASKS: usize = 1_000_000;

/// All tasks of a grid.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// The grid's name.
    pub grid: String,
    /// Its heading.
    pub title: String,
    /// The hash of the grid file, the scenes that it names and the version of lcplab; results of
    /// another plan are rejected.
    pub hash: String,
    /// The settings that vary.
    pub axes: Vec<String>,
    /// The tasks in the order of their numbers.
    pub tasks: Vec<Task>,
}

/// One point of a grid.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Task {
    /// Its number, from 1.
    pub task: usize,
    /// The seed of its random values, independent of the number.
    pub seed: u32,
    /// All settings, by path.
    pub settings: Table,
}

impl Grid {
    /// The tasks: every combination of the axes' points, the last axis fastest.
    ///
    /// # Errors
    /// If there are more than a million, or a scene cannot be read.
    pub fn plan(&self) -> Result<Plan> {
        let lengths = self.axes.iter().map(|axis| axis.points.len());
        let count = lengths.fold(1, usize::saturating_mul);
        if count > MOST_TASKS {
            let reason = format!("make {count} tasks, at most {MOST_TASKS} are allowed");
            return Err(Error::invalid(&*self.name, "axes", reason));
        }
        Ok(Plan {
            grid: self.name.clone(),
            title: self.title.clone(),
            hash: self.hash()?,
            axes: self.axes.iter().flat_map(|axis| axis.paths.clone()).collect(),
            tasks: (0..count).map(|index| self.task(index)).collect(),
        })
    }

    fn task(&self, index: usize) -> Task {
        let mut points = Vec::new();
        let mut rest = index;
        for axis in self.axes.iter().rev() {
            points.push(&axis.points[rest % axis.points.len()]);
            rest /= axis.points.len();
        }
        let mut settings: Table = self.settings.iter().cloned().collect();
        for (axis, point) in self.axes.iter().zip(points.iter().rev()) {
            settings.extend(axis.paths.iter().cloned().zip(point.iter().cloned()));
        }
        Task { task: index + 1, seed: seed(self.seed, &settings), settings }
    }

    /// The paths of all settings, those that vary last.
    pub(super) fn paths(&self) -> impl Iterator<Item = &String> {
        let fixed = self.settings.iter().map(|(path, _)| path);
        fixed.chain(self.axes.iter().flat_map(|axis| &axis.paths))
    }

    /// Every value that a setting has in some task.
    pub(super) fn values_of(&self, path: &str) -> Vec<&Value> {
        let fixed = self.settings.iter().filter(|(other, _)| other == path).map(|(_, value)| value);
        let varied = self.axes.iter().filter_map(|axis| {
            let place = axis.paths.iter().position(|other| other == path)?;
            Some(axis.points.iter().map(move |point| &point[place]))
        });
        fixed.chain(varied.flatten()).collect()
    }

    fn hash(&self) -> Result<String> {
        let mut text = format!("lcplab {}\n{}", env!("CARGO_PKG_VERSION"), self.source);
        for scene in self.values_of("scene").into_iter().filter_map(Value::as_str) {
            text += &scene::text(scene)?.1;
        }
        Ok(format!("{:016x}", fnv(&text)))
    }
}

impl Task {
    /// A setting that is a text.
    pub fn text(&self, path: &str) -> Option<&str> {
        self.settings.get(path).and_then(Value::as_str)
    }

    /// A setting that is a number.
    pub fn number(&self, path: &str) -> Option<f64> {
        let value = self.settings.get(path)?;
        value.as_float().or(value.as_integer().map(|value| value as f64))
    }

    /// A setting as shown in tables; empty if it is not set.
    pub fn shown(&self, path: &str) -> String {
        self.settings.get(path).map(plain).unwrap_or_default()
    }
}

/// A value as text: 1 and 1.0 give the same.
pub(super) fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => csv::number(*number),
        other => other.to_string(),
    }
}

/// The seed of a task: from the grid's seed and from the settings that define its problem, in the
/// order of their names.
fn seed(grid: u64, settings: &Table) -> u32 {
    let makes_problem = |path: &str| {
        path == REPEAT
            || SUBJECT[..2].contains(&path)
            || !(path == "steps" || path.starts_with("solver.") || path.starts_with("step."))
    };
    let mut lines: Vec<String> = settings
        .iter()
        .filter(|(path, _)| makes_problem(path))
        .map(|(path, value)| format!("{path} = {}", plain(value)))
        .collect();
    lines.sort();
    (mixed(fnv(&format!("{grid}\n{}", lines.join("\n")))) >> 32) as u32
}

/// The finalizer of splitmix64 (Steele, Lea & Flood 2014): every bit depends on every other.
fn mixed(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
