//! A scene with overridden fields, so that a report file can state a variant in a line.
//!
//! ```
//! use lcplab::report::study::variation::Variation;
//!
//! let variation: Variation = toml::from_str(
//!     "scene = 'stack'
//!      change = { generate = { count = 3 }, step = { dt = 0.02 } }",
//! )?;
//! let scene = variation.scene()?;
//! assert_eq!((scene.bodies.len(), scene.step.dt), (4, 0.02)); // the ground counts
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::error::Result;
use crate::scene::Scene;

/// A scene and its overridden fields.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variation {
    /// A shipped scene or a file.
    pub scene: String,
    /// Fields of the scene format that replace those of the scene; a list replaces the whole list.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    pub change: Table,
}

impl Variation {
    /// A scene with these overridden fields.
    pub(crate) fn of(scene: &str, change: &Table) -> Self {
        Variation { scene: scene.into(), change: change.clone() }
    }

    /// The same with more overridden fields.
    pub(crate) fn and(&self, change: &Table) -> Self {
        let mut all = self.change.clone();
        merge(&mut all, change);
        Variation { scene: self.scene.clone(), change: all }
    }

    /// The scene.
    ///
    /// # Errors
    /// If the scene does not exist, or is invalid with the overridden fields.
    pub fn scene(&self) -> Result<Scene> {
        let mut changes = Vec::new();
        flatten("", &self.change, &mut changes);
        Scene::load_with(&self.scene, &changes)
    }
}

/// The fields of a table, each with its path and its value.
fn flatten(parent: &str, table: &Table, fields: &mut Vec<(String, String)>) {
    for (key, value) in table {
        let path = format!("{parent}{key}");
        match value {
            Value::Table(inner) => flatten(&format!("{path}."), inner, fields),
            value => fields.push((path, value.to_string())),
        }
    }
}

fn merge(into: &mut Table, change: &Table) {
    for (key, value) in change {
        match (into.get_mut(key), value) {
            (Some(Value::Table(old)), Value::Table(new)) => merge(old, new),
            _ => drop(into.insert(key.clone(), value.clone())),
        }
    }
}
