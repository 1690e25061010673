//! Scenes as report files name them.

use serde::{Deserialize, Deserializer, Serialize, de::Error};

use crate::file;

/// A name that becomes that of a file.
///
/// # Errors
/// If it cannot be one.
pub fn file_name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let name = String::deserialize(deserializer)?;
    file::check_name(&name).map_err(D::Error::custom)?;
    Ok(name)
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

/// A scene and how long it runs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timed {
    /// A shipped scene or a file.
    pub scene: String,
    /// Simulated time (s).
    pub duration: f64,
}
