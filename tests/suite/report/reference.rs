//! The results of the standard report, compared with the committed ones: a change of behavior shows
//! as a difference here.
//!
//! The committed file has the finding of every task without its section's words and settings, which
//! stand in `reports/standard.toml`. Of a long list without words, such as the instants of a motion
//! or the points of a curve, it has nine items, the first and the last among them, and the number
//! of all: a step that changes changes the instants after it. After an intended change,
//! `LCPLAB_RENEW=1 cargo test --test suite -- reference` writes it anew.

use std::path::Path;
use std::sync::LazyLock;
use std::{env, fs};

use lcplab::report::difference::{self, Tolerance};
use lcplab::report::experiment::Experiment;
use lcplab::report::results::Results;
use serde_json::{Map, Value, json};

use super::standard::run_all;

/// Numbers may differ by so much, relative to their size, or by so much at all: processors add in
/// different orders, and a residual near rounding has no digits to keep.
const TOLERANCE: Tolerance = Tolerance { relative: 1e-6, absolute: 1e-9 };
/// The items that are kept of a long list.
const KEPT: usize = 9;

/// The results of the standard report, found once for all tests.
pub static STANDARD: LazyLock<Results> =
    LazyLock::new(|| run_all(&Experiment::load("standard").unwrap()));

#[test]
fn the_standard_report_is_the_committed_one() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("reports/reference/results.json");
    let found = findings(&serde_json::to_value(&*STANDARD).unwrap());
    if env::var_os("LCPLAB_RENEW").is_some() {
        fs::write(&file, lines(&found)).unwrap();
    }
    let committed = difference::read(&file).unwrap();
    let changes = difference::between(&committed, &found, TOLERANCE);
    assert!(changes.is_empty(), "{} changes, the first: {:?}", changes.len(), changes.first());
}

/// The findings by section and task.
fn findings(results: &Value) -> Value {
    let mut sections = Map::new();
    for section in results["sections"].as_array().unwrap() {
        let tasks = section["tasks"].as_array().into_iter().flatten();
        let by_name = |task: &Value| {
            let mut fields = task.as_object().unwrap().clone();
            let name = fields.remove("name").unwrap();
            (name.as_str().unwrap().to_string(), thinned(Value::Object(fields)))
        };
        let tasks: Map<String, Value> = tasks.map(by_name).collect();
        if !tasks.is_empty() {
            sections.insert(section["id"].as_str().unwrap().into(), Value::Object(tasks));
        }
    }
    Value::Object(sections)
}

/// The value with nine items of each long list without words.
fn thinned(value: Value) -> Value {
    match value {
        Value::Object(fields) => {
            fields.into_iter().map(|(name, value)| (name, thinned(value))).collect()
        }
        Value::Array(items) if items.len() > KEPT && !items.iter().any(is_row) => {
            let last = items.len() - 1;
            let kept = (0..KEPT).map(|k| thinned(items[k * last / (KEPT - 1)].clone()));
            json!({ "items": items.len(), "kept": kept.collect::<Vec<_>>() })
        }
        Value::Array(items) => items.into_iter().map(thinned).collect(),
        value => value,
    }
}

/// Whether an item of a list says in words what it is about.
fn is_row(item: &Value) -> bool {
    item.as_object().is_some_and(|fields| fields.values().any(Value::is_string))
}

/// JSON with a line for each task, so that a change shows its place.
fn lines(sections: &Value) -> String {
    let of_section = |(id, tasks): (&String, &Value)| {
        let line = |(name, finding): (&String, &Value)| format!("{}: {finding}", json!(name));
        let tasks: Vec<String> = tasks.as_object().unwrap().iter().map(line).collect();
        format!("{}: {{\n{}\n}}", json!(id), tasks.join(",\n"))
    };
    let sections: Vec<String> = sections.as_object().unwrap().iter().map(of_section).collect();
    format!("{{\n{}\n}}\n", sections.join(",\n"))
}
