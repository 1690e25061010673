//! Scenes as report files name them.

use serde::{Deserialize, Serialize};

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

/// A scene and how long it runs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timed {
    /// A shipped scene or a file.
    pub scene: String,
    /// Simulated time (s).
    pub duration: f64,
}
