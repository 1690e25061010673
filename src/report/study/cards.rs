//! Engine cards: how physics engines behave on one scene per phenomenon, compared with its law.
//!
//! Nothing is run here. `python -m lcplab.cards` runs the engines and writes a record; a report
//! shows it, by default the shipped one.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::error::{Error, Result};
use crate::lcp::file::Problem;
use crate::solver::Registry;
use lcplab_lcp::disk;

/// The record that lcplab ships.
const SHIPPED: &str = include_str!("../../../reports/engines.json");

/// An error this close to a tolerance may have been on the other side of it before numbers were
/// rounded to six digits.
const SIX_DIGITS: f64 = 1e-4;

/// The supported format version.
const FORMAT: u32 = 1;

/// The record to show.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// A file written by `python -m lcplab.cards --out FILE`; by default the shipped record.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<PathBuf>,
}

/// The results of all engines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The version of the format.
    pub format: u32,
    /// The engines, in the order of the page.
    pub engines: Vec<Engine>,
    /// Contact problems that engines solve themselves, for engines that export them.
    #[serde(default)]
    pub frames: Vec<Frame>,
    /// The phenomena, in the order of the page.
    pub phenomena: Vec<Phenomenon>,
}

/// An engine that was run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Engine {
    /// Its name in options.
    pub name: String,
    /// Its name for people.
    pub title: String,
    /// Its package at PyPI.
    pub package: String,
    /// The package's version.
    pub version: String,
    /// Its configurations.
    pub settings: Vec<Settings>,
}

/// A configuration of an engine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// `defaults`, `accurate`, or a scheme of lcplab.
    pub name: String,
    /// All settings, as text.
    pub words: String,
    /// The length of a step (s).
    pub dt: f64,
}

/// A contact problem of an engine, and the solvers that solve it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// The engine's name; it runs with its default settings.
    pub engine: String,
    /// The name of the phenomenon.
    pub phenomenon: String,
    /// The simulated time (s).
    pub time: f64,
    /// The problem, as the object of a problem file.
    pub problem: serde_json::Value,
    /// The engine's own answer.
    pub answer: Vec<f64>,
    /// The number of rows.
    pub rows: usize,
    /// The judge's verdict on the engine's own answer.
    pub verdict: String,
    /// Its scaled residual.
    pub residual: f64,
    /// The row with the largest residual, for an answer that is not a solution.
    pub row: Option<usize>,
    /// That residual in the unit of w (for impulses m/s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub missed: Option<f64>,
    /// The results of lcplab's solvers on the same problem.
    pub solvers: Vec<SolverAttempt>,
}

/// A solver on an engine's problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SolverAttempt {
    /// Its name.
    pub solver: String,
    /// Whether the judge accepts its answer.
    pub accepted: bool,
    /// The number of sweeps or pivots.
    pub iterations: usize,
    /// Its cost, if it is counted.
    pub multiplications: Option<f64>,
}

/// A question, its law, and the answers of the engines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Phenomenon {
    /// Its name in options.
    pub name: String,
    /// The question.
    pub question: String,
    /// Why it matters.
    pub matters: String,
    /// The law, as TeX.
    pub law: String,
    /// The allowed deviation, and why.
    pub allowed: String,
    /// What has been reported about engines, and the formula that explains it; may be empty.
    #[serde(default)]
    pub reported: String,
    /// The simulated time (s).
    pub duration: f64,
    /// The scene file.
    pub scene: String,
    /// The fields that were set, for each run.
    pub set: Vec<serde_json::Map<String, serde_json::Value>>,
    /// Whether the horizontal axis is logarithmic.
    pub log: bool,
    /// The horizontal axis.
    pub x: Along,
    /// The vertical axis.
    pub y: Upwards,
    /// The results, one for each engine configuration.
    pub columns: Vec<Column>,
}

/// The horizontal axis of a plot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Along {
    /// The quantity.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The positions of all curves.
    pub values: Vec<f64>,
}

/// The vertical axis of a plot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Upwards {
    /// The quantity.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The value of the law at each position.
    pub law: Vec<f64>,
}

/// The results of an engine configuration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// The engine's name.
    pub engine: String,
    /// The name of its settings.
    pub settings: String,
    /// The missing feature, if that is why nothing was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unsupported: Option<String>,
    /// Why its run failed, if it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed: Option<String>,
    /// What was measured.
    #[serde(default)]
    pub measured: Vec<Measured>,
    /// The curve in the plot.
    #[serde(default)]
    pub y: Vec<f64>,
    /// Wall time per simulated second (s), on the machine that ran it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pace: Option<f64>,
    /// The solver's part in the motion, if something was measured and the engine is an external
    /// one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solver: Option<SolverPart>,
}

/// The error of an engine's solver on its own problems, from receipts of steps of the run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum SolverPart {
    /// Steps were checked.
    Checked {
        /// The number of checked steps.
        steps: usize,
        /// The number of those whose error is above the limit.
        above: usize,
        /// The largest error of the motion in a step, relative to its change in this step.
        #[serde(with = "lcplab_analysis::number::always")]
        error: f64,
        /// The limit of that step.
        limit: f64,
        /// Whether all errors are proved bounds; otherwise some are residuals.
        is_bound: bool,
    },
    /// No step was checked.
    Unchecked {
        /// The reason.
        why: String,
    },
}

/// A measured number next to that of the law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// What it is, as text between the engine's name and the number.
    pub what: String,
    /// The engine's value.
    #[serde(with = "lcplab_analysis::number::always")]
    pub value: f64,
    /// The law's value.
    pub law: f64,
    /// The allowed difference between the two.
    pub tolerance: f64,
    /// Their unit.
    pub unit: String,
    /// Whether the difference is within the tolerance.
    pub holds: bool,
}

impl Record {
    /// Loads a record from a file, or the shipped one.
    ///
    /// # Errors
    /// If the file cannot be read or is not a record of this format.
    pub fn load(file: Option<&Path>) -> Result<Self> {
        let (path, text) = match file {
            None => ("engines.json".into(), SHIPPED.into()),
            Some(path) => (path.display().to_string(), disk::read(path, disk::WRITTEN_BY_HAND)?),
        };
        let fault = |reason: String| Error::invalid(path.as_str(), "record", reason);
        let record: Record =
            serde_json::from_str(&text).map_err(|error| fault(error.to_string()))?;
        match record.format {
            FORMAT => Ok(record),
            other => Err(fault(format!("has the format {other}; this version reads {FORMAT}"))),
        }
    }

    /// The display name of an engine.
    pub fn title<'a>(&'a self, engine: &'a str) -> &'a str {
        self.engines.iter().find(|own| own.name == engine).map_or(engine, |own| &own.title)
    }
}

impl Frame {
    /// The problem.
    ///
    /// # Errors
    /// If it is not a valid problem.
    pub fn problem(&self) -> Result<Problem> {
        Problem::parse(&self.problem.to_string(), "engines.json")
    }
}

impl Measured {
    /// The deviation from the law, in tolerances.
    pub(crate) fn miss(&self) -> f64 {
        (self.value - self.law).abs() / self.tolerance
    }

    /// Whether its verdict contradicts its numbers, of which a record keeps six digits.
    pub(crate) fn is_misjudged(&self) -> bool {
        let miss = self.miss();
        let is_at_the_border = (miss - 1.0).abs() < SIX_DIGITS;
        self.holds != (miss <= 1.0) && !is_at_the_border
    }
}

impl Column {
    /// The measurement that deviates most from the law, relative to its tolerance.
    pub(crate) fn worst(&self) -> Option<&Measured> {
        self.measured.iter().max_by(|a, b| a.miss().total_cmp(&b.miss()))
    }

    /// Whether every law holds.
    pub fn holds(&self) -> bool {
        !self.measured.is_empty() && self.measured.iter().all(|measured| measured.holds)
    }
}

impl Study for Plan {
    const NAME: &'static str = "cards";
    type Finding = Record;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec!["record".into()]
    }

    fn run(&self, _: usize, _: &Registry) -> Result<(Record, ())> {
        Ok((Record::load(self.record.as_deref())?, ()))
    }
}
