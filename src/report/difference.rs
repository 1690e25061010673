//! Differences between two results files: numbers, words, and added or removed rows.
//!
//! Machine-dependent parts (`machine`) and the versions of libraries are ignored.

use std::path::Path;

use serde_json::{Map, Value};

use super::page::{Cell, Table};
use crate::error::{Error, Result};
use crate::file;
use crate::json;
use crate::memory::Memory;
use crate::number::{counted, readable};

/// Parts of a results file that describe where and with what it was made, not the results.
const CIRCUMSTANCES: [&str; 3] = ["machine", "version", "libraries"];
/// Fields that identify a row of results, in the order in which they are shown.
const NAMES: [&str; 12] = [
    "scene", "name", "case", "id", "quantity", "scheme", "level", "family", "solver", "model",
    "order", "dt",
];

/// One difference.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// The place: `comparisons › fig7 › pgs › iterations`.
    pub place: String,
    /// The old value; `None` if it was added.
    pub old: Option<Value>,
    /// The new value; `None` if it was removed.
    pub new: Option<Value>,
}

impl Change {
    /// |new − old| relative to the larger absolute value; 1 unless both are numbers.
    pub(crate) fn relative(&self) -> f64 {
        self.numbers().map_or(1.0, |(old, new)| (new - old).abs() / old.abs().max(new.abs()))
    }

    /// The old and new value, if they are numbers.
    fn numbers(&self) -> Option<(f64, f64)> {
        let number = |value: &Option<Value>| value.as_ref().and_then(Value::as_f64);
        number(&self.old).zip(number(&self.new))
    }

    /// The change as a table's row: place, old, new, relative change.
    fn row(&self) -> Vec<Cell> {
        let written = |value: &Option<Value>| match value {
            None => Cell::text("–"),
            Some(Value::Number(found)) => match found.as_f64() {
                Some(value) => number(value, 8),
                None => Cell::text(found.to_string()),
            },
            Some(Value::Array(items)) => Cell::text(format!("{} entries", items.len())),
            Some(Value::Object(_)) => Cell::text("a row"),
            Some(Value::String(words)) => Cell::text(words.as_str()),
            Some(other) => Cell::text(other.to_string()),
        };
        let place = Cell::text(self.place.as_str());
        vec![place, written(&self.old), written(&self.new), number(self.relative(), 2)]
    }
}

/// A number without trailing zeros.
fn number(value: f64, digits: usize) -> Cell {
    Cell { text: readable(value, digits), value: Some(value), ..Cell::default() }
}

/// Maximum number of changes listed.
const LISTED: usize = 40;

/// The changes as a table.
pub fn table(changes: &[Change]) -> Table {
    let more = changes.len().saturating_sub(LISTED);
    Table::new(
        counted(changes.len(), "difference"),
        if more > 0 { format!("And {more} more.") } else { String::new() },
        "place | #old | #new | #relative change",
        changes.iter().take(LISTED).map(Change::row).collect(),
    )
}

/// Reads a results file.
///
/// # Errors
/// If it cannot be read, is not JSON or has a key twice.
pub fn read(path: &Path) -> Result<Value> {
    let text = file::read(path, Memory::default())?;
    json::parse(&text).map_err(|cause| {
        let place = format!("line {}", cause.line());
        Error::invalid(path.display().to_string(), place, cause.to_string())
    })
}

/// The tolerance for numbers that count as equal.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tolerance {
    /// Relative to the larger absolute value.
    pub relative: f64,
    /// Absolute, in the number's own unit.
    pub absolute: f64,
}

impl Tolerance {
    fn passes(self, change: &Change) -> bool {
        match change.numbers() {
            Some((old, new)) => {
                (new - old).abs() <= self.absolute + self.relative * old.abs().max(new.abs())
            }
            None => false,
        }
    }
}

/// All changes from old to new results; numbers only if they differ by more than the tolerance.
pub fn between(old: &Value, new: &Value, tolerance: Tolerance) -> Vec<Change> {
    let mut changes = Vec::new();
    compare(&mut changes, "", Some(&outcome(old)), Some(&outcome(new)));
    changes.retain(|change| !tolerance.passes(change));
    changes
}

/// The results without the parts that describe circumstances.
fn outcome(results: &Value) -> Value {
    let Value::Object(fields) = results else { return results.clone() };
    let kept = fields.iter().filter(|(name, _)| !CIRCUMSTANCES.contains(&name.as_str()));
    Value::Object(kept.map(|(name, value)| (name.clone(), value.clone())).collect())
}

fn compare(changes: &mut Vec<Change>, place: &str, old: Option<&Value>, new: Option<&Value>) {
    match (old, new) {
        (Some(Value::Object(before)), Some(Value::Object(after))) => {
            for name in names(before, after) {
                compare(changes, &inside(place, name), before.get(name), after.get(name));
            }
        }
        (Some(Value::Array(before)), Some(Value::Array(after))) => {
            let (before, after) = (labelled(before), labelled(after));
            for label in names(&before, &after) {
                compare(changes, &inside(place, label), before.get(label), after.get(label));
            }
        }
        (old, new) if old != new => {
            let (old, new) = (old.cloned(), new.cloned());
            changes.push(Change { place: place.to_string(), old, new });
        }
        _ => (),
    }
}

/// The names in either, those of the first in its order before the others.
fn names<'a>(before: &'a Map<String, Value>, after: &'a Map<String, Value>) -> Vec<&'a String> {
    let added = after.keys().filter(|name| !before.contains_key(*name));
    before.keys().chain(added).collect()
}

/// The items of a list by name, so that a row is found even if others were inserted before it; by
/// number if they have no name or share one.
fn labelled(items: &[Value]) -> Map<String, Value> {
    let mut labelled = Map::new();
    for (k, item) in items.iter().enumerate() {
        let mut label = label(item).unwrap_or_else(|| (k + 1).to_string());
        if labelled.contains_key(&label) {
            label = format!("{label} ({})", k + 1);
        }
        labelled.insert(label, item.clone());
    }
    labelled
}

fn label(item: &Value) -> Option<String> {
    let said = NAMES.iter().filter_map(|name| match item.get(name)? {
        Value::String(words) => Some(words.clone()),
        Value::Number(number) => Some(format!("{name} {number}")),
        _ => None,
    });
    let said: Vec<String> = said.collect();
    (!said.is_empty()).then(|| said.join(" "))
}

fn inside(place: &str, name: &str) -> String {
    if place.is_empty() { name.to_string() } else { format!("{place} › {name}") }
}
