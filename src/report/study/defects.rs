//! Known defects of physics engines, replayed in a defective and in a corrected release.
//!
//! Nothing is run here. `python -m lcplab.defects --out FILE` runs the engines and writes a record;
//! a report shows it, by default the shipped one.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::receipt::Stage;
use crate::error::{Error, Result};
use crate::solver::Registry;
use lcplab_lcp::disk;

/// The record that lcplab ships.
const SHIPPED: &str = include_str!("../../../reports/receipts.json");

/// The record to show.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// A file written by `python -m lcplab.defects --out FILE`; by default the shipped record.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<PathBuf>,
}

/// The results of all defects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The version of Python.
    pub python: String,
    /// The defects, in the order of the page.
    pub defects: Vec<Defect>,
}

/// A defect and the runs of its scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Defect {
    /// The name of its scene.
    pub name: String,
    /// What was wrong.
    pub what: String,
    /// The release that corrected it, and the engine's number of the defect.
    pub source: String,
    /// The stage of an engine's step that was wrong.
    pub stage: Stage,
    /// The run of the defective release.
    pub bad: Replay,
    /// The run of the corrected one.
    pub mended: Replay,
    /// `detected`, `detected by comparison`, `missed`, `false alarm` or `skipped`.
    pub outcome: String,
}

/// The run of a release, or why there is none.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Replay {
    /// The engine and its version.
    pub versions: Vec<String>,
    /// The number of steps, and of those that are rejected.
    pub frames: usize,
    /// The number of rejected steps.
    pub refused: usize,
    /// The stage of the first rejected step, and its error.
    pub stage: Option<Stage>,
    /// What is wrong there.
    pub what: Option<String>,
    /// How the run is worse than that of the corrected release.
    pub worse: Vec<String>,
    /// The largest error of the motion in a step, relative to its change in this step.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_motion_error: Option<f64>,
    /// The packages that cannot be installed or run.
    pub packages: Vec<String>,
    /// Why not.
    pub unavailable: Option<String>,
}

impl Study for Plan {
    const NAME: &'static str = "defects";
    type Finding = Record;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec!["record".into()]
    }

    fn run(&self, _task: usize, _: &Registry) -> Result<(Record, ())> {
        let (path, text) = match &self.record {
            None => ("receipts.json".into(), SHIPPED.into()),
            Some(path) => (path.display().to_string(), disk::read(path, disk::WRITTEN_BY_HAND)?),
        };
        let record = serde_json::from_str(&text);
        let record = record.map_err(|cause| Error::invalid(path, "record", cause.to_string()))?;
        Ok((record, ()))
    }
}

impl Defect {
    /// Whether the defective release is distinguished from the corrected one.
    pub(crate) fn is_detected(&self) -> bool {
        self.outcome.starts_with("detected")
    }

    /// Whether the outcome contradicts the numbers of the runs.
    pub(crate) fn is_misjudged(&self) -> bool {
        let is_at_stage = self.bad.stage == Some(self.stage);
        match self.outcome.as_str() {
            "detected" => self.bad.refused == 0 || !is_at_stage || self.mended.refused > 0,
            "detected by comparison" => self.bad.worse.is_empty() || self.mended.refused > 0,
            "false alarm" => self.mended.refused == 0,
            _ => false,
        }
    }
}
