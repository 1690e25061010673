//! Measured errors of the stages of a step, compared with their limits.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The stages of a step, in the order in which an engine passes them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stage {
    /// Which shapes touch, and where.
    Collision,
    /// M, J, bias, compliance and the motion without constraints.
    Assembly,
    /// The forces and the motion of the problem that the engine posed.
    Solver,
    /// The new velocity and the reported forces.
    WriteBack,
}

impl Stage {
    /// All stages.
    pub const ALL: [Stage; 4] =
        [Stage::Collision, Stage::Assembly, Stage::Solver, Stage::WriteBack];

    /// The name in reports and files.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Collision => "collision",
            Stage::Assembly => "assembly",
            Stage::Solver => "solver",
            Stage::WriteBack => "write-back",
        }
    }
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A measured error of a stage; rejected if it is above its limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Finding {
    /// The stage.
    pub stage: Stage,
    /// What was compared, as a sentence.
    pub what: String,
    /// The error, without unit.
    #[serde(with = "crate::number::always")]
    pub error: f64,
    /// The largest accepted error.
    #[serde(with = "crate::number::always")]
    pub limit: f64,
    /// The row with the error, if it belongs to one.
    pub row: Option<usize>,
    /// The bodies of the row or of the degree of freedom.
    pub bodies: Vec<String>,
}

impl Finding {
    /// An error that belongs to no row.
    ///
    /// ```
    /// use lcplab_analysis::receipt::{Finding, Stage};
    ///
    /// let drift = Finding::new(Stage::Assembly, "bias", 0.02, 0.01);
    /// assert!(drift.is_rejected());
    /// assert!(!Finding::new(Stage::Assembly, "bias", 0.01, 0.01).is_rejected());
    /// assert!(Finding::new(Stage::Assembly, "bias", f64::NAN, 0.01).is_rejected());
    /// ```
    pub fn new(stage: Stage, what: impl Into<String>, error: f64, limit: f64) -> Self {
        Finding { stage, what: what.into(), error, limit, row: None, bodies: Vec::new() }
    }

    /// Whether the error is above the limit, or not a number.
    pub fn is_rejected(&self) -> bool {
        self.error.is_nan() || self.error > self.limit
    }
}

/// The findings of some stages, and the parts that were not checked.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// The measured errors.
    pub findings: Vec<Finding>,
    /// What the engine does not report, or lcplab cannot check.
    pub not_checked: Vec<String>,
}

impl Report {
    /// Appends another report.
    pub(crate) fn add(&mut self, other: Report) {
        self.findings.extend(other.findings);
        self.not_checked.extend(other.not_checked);
    }
}
