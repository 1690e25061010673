//! What a report is to find out, as a file: scenes, studies and their settings.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::study::verification::Size;
use crate::error::{Error, Result};
use crate::solver::ALL;

/// The reports that lcplab ships, by name.
const SHIPPED: [(&str, &str); 2] = [
    ("standard", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/reports/standard.toml"))),
    ("storage", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/reports/storage.toml"))),
];

/// A report's description, read from TOML.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Experiment {
    /// The file's name without its extension; also the folder the report is written to.
    #[serde(default)]
    pub name: String,
    /// The heading.
    pub title: String,
    /// What the report is about, in a few sentences of page markup.
    pub lead: String,
    /// Whether the known numbers are measured, `fast` or `full`.
    #[serde(default)]
    pub verification: Option<Size>,
    /// The solvers to compare, by name; all without it.
    #[serde(default = "all_solvers")]
    pub solvers: Vec<String>,
    /// Scenes stepped by these solvers at both levels.
    #[serde(default)]
    pub comparison: Vec<Stepped>,
    /// LCPs solved in three ways.
    #[serde(default)]
    pub cross_check: Vec<AtStep>,
    /// LCPs solved by sweeps.
    #[serde(default)]
    pub convergence: Vec<Sweeps>,
    /// Columns whose rates have a closed form.
    #[serde(default)]
    pub rates: Option<Rates>,
    /// One LCP that costs each method something else.
    #[serde(default)]
    pub worst_cases: Option<WorstCases>,
    /// A block pushed from all sides under each model of friction.
    #[serde(default)]
    pub friction: Option<Friction>,
    /// LCPs on which the merit functions are compared.
    #[serde(default)]
    pub merits: Vec<AtStep>,
    /// Matrices drawn.
    #[serde(default)]
    pub sparsity: Vec<AtStep>,
    /// Scenes run with shorter and shorter steps.
    #[serde(default)]
    pub drift: Vec<Timed>,
    /// The storages of sparse matrices.
    #[serde(default)]
    pub storage: Option<Storage>,
}

/// A scene and how many steps it takes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stepped {
    /// A shipped scene or a file.
    pub scene: String,
    /// The number of steps.
    pub steps: usize,
}

/// A scene and one of its steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AtStep {
    /// A shipped scene or a file.
    pub scene: String,
    /// The number of the step, from 1.
    pub step: usize,
}

/// A scene, one of its steps, and relaxation factors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sweeps {
    /// A shipped scene or a file.
    pub scene: String,
    /// The number of the step, from 1.
    pub step: usize,
    /// The relaxation factors ω; the optimal one is added where theory knows it.
    pub omegas: Vec<f64>,
}

/// Columns of bodies on the ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rates {
    /// Columns of so many equal bodies.
    pub bodies: Vec<usize>,
    /// Two bodies, the upper one so many times as heavy.
    pub ratios: Vec<f64>,
}

/// Murty's and Fathi's matrices.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorstCases {
    /// The numbers of rows.
    pub sizes: Vec<u32>,
}

/// A block on the floor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Friction {
    /// The coefficient of friction, above 0.
    pub mu: f64,
    /// How hard it is pushed, in units of what friction can hold; every model slides above √2.
    pub push: f64,
}

/// What is measured of storages.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Storage {
    /// Rows and columns of the matrix that is filled at random places.
    pub size: usize,
    /// How much of it is filled (%).
    pub fills: Vec<f64>,
    /// Searches among so many entries.
    pub entries: Vec<usize>,
    /// Stacks of so many cubes, assembled and swept.
    pub stacks: Vec<usize>,
    /// Scenes whose J, M⁻¹ and A are kept in every storage.
    #[serde(default)]
    pub structures: Vec<AtStep>,
    /// A scene whose steps are assembled over and over.
    #[serde(default)]
    pub steps: Option<Stepped>,
    /// Scenes whose A is factored.
    #[serde(default)]
    pub factors: Vec<AtStep>,
    /// The patterns of the shipped scenes.
    #[serde(default)]
    pub pictures: Option<Pictures>,
}

/// The shipped scenes' patterns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pictures {
    /// These scenes alone; all without it.
    #[serde(default)]
    pub only: Vec<String>,
    /// Scenes that are shown in a later step than the first.
    #[serde(default)]
    pub later: Vec<AtStep>,
}

/// A scene and how long it runs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timed {
    /// A shipped scene or a file.
    pub scene: String,
    /// Simulated time (s).
    pub duration: f64,
}

/// The names of all registered solvers.
fn all_solvers() -> Vec<String> {
    ALL.iter().map(|entry| entry.name.to_string()).collect()
}

impl Experiment {
    /// Whether anything is solved, or nothing but storages looked at.
    pub fn solves(&self) -> bool {
        let lists = [
            self.comparison.is_empty(),
            self.cross_check.is_empty(),
            self.convergence.is_empty(),
            self.merits.is_empty(),
            self.sparsity.is_empty(),
            self.drift.is_empty(),
        ];
        lists.contains(&false)
            || self.verification.is_some()
            || self.rates.is_some()
            || self.worst_cases.is_some()
            || self.friction.is_some()
            || self.storage.is_none()
    }

    /// Reads a report file, or takes a shipped report by its name.
    ///
    /// # Errors
    /// A name that is neither a file nor shipped, or a file with a defect, with its line.
    pub fn load(path_or_name: &str) -> Result<Self> {
        let path = Path::new(path_or_name);
        if path.is_file() {
            let text = std::fs::read_to_string(path).map_err(|cause| Error::file(path, &cause))?;
            let name = path.file_stem().map_or("report".into(), |name| name.to_string_lossy());
            return Self::parse(&text, path_or_name, &name);
        }
        let shipped = SHIPPED.iter().find(|(name, _)| *name == path_or_name);
        let (name, text) = shipped.ok_or_else(|| Error::Unknown {
            kind: "report file or shipped report",
            name: path_or_name.into(),
            known: SHIPPED.iter().map(|(name, _)| (*name).into()).collect(),
        })?;
        Self::parse(text, path_or_name, name)
    }

    fn parse(text: &str, input: &str, name: &str) -> Result<Self> {
        let mut experiment: Experiment = toml::from_str(text).map_err(|cause| {
            let line = cause.span().map_or(1, |span| 1 + text[..span.start].matches('\n').count());
            Error::invalid(input, format!("line {line}"), cause.message())
        })?;
        experiment.name = name.to_string();
        Ok(experiment)
    }
}
