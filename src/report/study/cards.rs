//! Engine cards: what physics engines did with one scene a phenomenon, beside its law.
//!
//! Nothing is run here. `python -m lcplab.cards` runs the engines and writes a record; a report
//! draws it, the shipped one unless the file names another.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use crate::body::{Pose, State};
use crate::error::{Error, Result};
use crate::lcp::file::Problem;
use crate::scene::{Description, Scene};
use lcplab_problem::disk;

/// The record that lcplab ships.
const SHIPPED: &str = include_str!("../../../reports/engines.json");

/// A miss this near to one tolerance may be on either side of it before numbers are rounded to six
/// digits.
const SIX_DIGITS: f64 = 1e-4;

/// The format of records that is read.
const FORMAT: u32 = 1;

/// Which record is drawn.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// What `python -m lcplab.cards --out FILE` wrote; the shipped record without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<PathBuf>,
}

/// What was found by all engines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The version of the format.
    pub format: u32,
    /// The engines, in the order of the page.
    pub engines: Vec<Engine>,
    /// Contact problems that engines solve themselves, of those that tell them.
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
    /// The ways in which it was run.
    pub settings: Vec<Settings>,
}

/// A way in which an engine was run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// `defaults`, `accurate`, or a scheme of lcplab.
    pub name: String,
    /// All that was set, in words.
    pub words: String,
    /// The length of a step (s).
    pub dt: f64,
}

/// A contact problem that an engine posed, and who solves it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// The engine's name; it runs as installed.
    pub engine: String,
    /// The name of the phenomenon.
    pub phenomenon: String,
    /// The time in it (s).
    pub time: f64,
    /// The problem, as the object of a problem file.
    pub problem: serde_json::Value,
    /// The engine's own answer.
    pub answer: Vec<f64>,
    /// The number of rows.
    pub rows: usize,
    /// The judge's word on the engine's own answer.
    pub verdict: String,
    /// Its scaled residual.
    pub residual: f64,
    /// The row that is missed most, of an answer that is none.
    pub row: Option<usize>,
    /// How far it is missed, in the unit of w (impulses: m/s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub missed: Option<f64>,
    /// How lcplab's solvers do on the same problem.
    pub solvers: Vec<Tried>,
}

/// A solver on an engine's problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    /// Its name.
    pub solver: String,
    /// Whether the judge accepts its answer.
    pub accepted: bool,
    /// Sweeps or pivots.
    pub iterations: usize,
    /// What it cost, where that is counted.
    pub multiplications: Option<f64>,
}

/// A question, its law, and what each engine answered.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Phenomenon {
    /// Its name in options.
    pub name: String,
    /// What is asked.
    pub question: String,
    /// Why it matters.
    pub matters: String,
    /// The law, as TeX.
    pub law: String,
    /// By how much it may be missed, and why.
    pub allowed: String,
    /// What was reported of engines, and the formula that explains it; empty if nothing.
    #[serde(default)]
    pub reported: String,
    /// The simulated time (s).
    pub duration: f64,
    /// The scene file.
    pub scene: String,
    /// The fields that were set, one run each.
    pub set: Vec<serde_json::Map<String, serde_json::Value>>,
    /// Whether the horizontal axis is logarithmic.
    pub log: bool,
    /// What the plot goes along.
    pub x: Along,
    /// What is plotted.
    pub y: Upwards,
    /// What was found, an engine's settings each.
    pub columns: Vec<Column>,
}

/// The horizontal axis of a plot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Along {
    /// What it is.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The places of all curves.
    pub values: Vec<f64>,
}

/// The vertical axis of a plot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Upwards {
    /// What it is.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// What the law has at each place.
    pub law: Vec<f64>,
}

/// What an engine with its settings did.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// The engine's name.
    pub engine: String,
    /// The name of its settings.
    pub settings: String,
    /// What it lacks, if that is why nothing was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unsupported: Option<String>,
    /// How its run went wrong, if it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed: Option<String>,
    /// What was measured.
    #[serde(default)]
    pub measured: Vec<Measured>,
    /// The curve of the plot.
    #[serde(default)]
    pub y: Vec<f64>,
    /// How long a simulated second takes (s), on the machine that ran it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pace: Option<f64>,
    /// Where the bodies were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<Picture>,
}

/// A number beside the law's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// What it is, as words between the engine's name and the number.
    pub what: String,
    /// The engine's.
    #[serde(with = "lcplab_study::number::always")]
    pub value: f64,
    /// The law's.
    pub law: f64,
    /// How far apart the two may be.
    pub tolerance: f64,
    /// Their unit.
    pub unit: String,
    /// Whether they are closer.
    pub holds: bool,
}

/// Where the bodies were at a time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// The time (s).
    pub time: f64,
    /// Position (m) and quaternion (w, x, y, z) of each body.
    pub poses: Vec<[f64; 7]>,
}

impl Record {
    /// The record in a file, or the shipped one.
    ///
    /// # Errors
    /// A file that cannot be read or is no record of this format.
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

    /// The name of an engine for people.
    pub fn title<'a>(&'a self, engine: &'a str) -> &'a str {
        self.engines.iter().find(|own| own.name == engine).map_or(engine, |own| &own.title)
    }
}

impl Frame {
    /// The problem.
    ///
    /// # Errors
    /// If it is none.
    pub fn problem(&self) -> Result<Problem> {
        Problem::parse(&self.problem.to_string(), "engines.json")
    }
}

impl Measured {
    /// How far it is from the law, in tolerances.
    pub fn miss(&self) -> f64 {
        (self.value - self.law).abs() / self.tolerance
    }

    /// Whether its verdict is not that of its numbers, of which a record keeps six digits.
    pub fn is_misjudged(&self) -> bool {
        let miss = self.miss();
        let is_at_the_border = (miss - 1.0).abs() < SIX_DIGITS;
        self.holds != (miss <= 1.0) && !is_at_the_border
    }
}

impl Column {
    /// What missed the law most, or was nearest to missing it.
    pub fn worst(&self) -> Option<&Measured> {
        self.measured.iter().max_by(|a, b| a.miss().total_cmp(&b.miss()))
    }

    /// Whether every law holds.
    pub fn holds(&self) -> bool {
        !self.measured.is_empty() && self.measured.iter().all(|measured| measured.holds)
    }
}

impl Phenomenon {
    /// The scene, as the last of its variants sets it.
    ///
    /// # Errors
    /// If the text is no scene.
    pub fn scene(&self) -> Result<Scene> {
        let name = format!("{}.toml", self.name);
        Scene::new(&name, &Description::from_toml(&name, &self.scene)?)
    }
}

impl Picture {
    /// The bodies' states, without their velocities.
    pub fn states(&self) -> Vec<State> {
        let state = |&[x, y, z, w, i, j, k]: &[f64; 7]| {
            let q = nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, i, j, k));
            State { pose: Pose { p: [x, y, z].into(), q }, ..State::WORLD }
        };
        self.poses.iter().map(state).collect()
    }
}

impl Study for Plan {
    const NAME: &'static str = "cards";
    type Finding = Record;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec!["record".into()]
    }

    fn run(&self, _: usize) -> Result<(Record, ())> {
        Ok((Record::load(self.record.as_deref())?, ()))
    }
}
