//! The results of all tasks as one table: the same bits in whichever order, on however many threads
//! or machines they were found. Times are a table of their own.

use serde_json::{Value as Json, json};

use super::file::Grid;
use super::folder::{Folder, Record, pretty};
use super::measure::MEASURES;
use super::page;
use super::plan::Task;
use crate::csv;
use crate::error::Result;
use crate::file;
use crate::report::write;

/// The results of a grid, by task.
#[derive(Debug, Clone, PartialEq)]
pub struct Collection {
    /// Tasks and their results.
    pub done: Vec<(Task, Record)>,
    /// The numbers of the tasks without results.
    pub missing: Vec<usize>,
}

impl Collection {
    /// Claims of solvers that the judge refutes.
    pub fn refuted(&self) -> usize {
        let refuted = |record: &Record| record.finding.as_ref()?.get("refuted");
        self.done.iter().filter_map(|(_, record)| refuted(record)).sum::<f64>() as usize
    }

    /// Tasks whose settings make no scene or problem.
    pub fn impossible(&self) -> usize {
        self.done.iter().filter(|(_, record)| record.finding.is_none()).count()
    }
}

/// Reads the results there are and writes `results.csv`, `results.json`, `times.csv` and a page.
///
/// # Errors
/// If a result cannot be read or belongs to another plan, or a file cannot be written.
pub fn collect(grid: &Grid, folder: &Folder) -> Result<Collection> {
    let mut collection = Collection { done: Vec::new(), missing: Vec::new() };
    for task in &folder.plan().tasks {
        match folder.record(task.task)? {
            Some(record) => collection.done.push((task.clone(), record)),
            None => collection.missing.push(task.task),
        }
    }
    let axes = &folder.plan().axes;
    file::write(&folder.path().join("results.csv"), table(axes, &collection.done))?;
    file::write(&folder.path().join("results.json"), &pretty(&object(folder, &collection.done))?)?;
    file::write(&folder.path().join("times.csv"), times(&collection.done))?;
    write::document(&page::document(grid, folder.plan(), &collection), folder.path())?;
    Ok(collection)
}

fn table(axes: &[String], done: &[(Task, Record)]) -> String {
    let findings = || done.iter().filter_map(|(_, record)| record.finding.as_ref());
    let taken = |name: &&str| findings().any(|finding| finding.values.contains_key(*name));
    let measures: Vec<&str> = MEASURES.iter().map(|measure| measure.name).filter(taken).collect();
    let mut out = String::new();
    let heading = ["task"].into_iter().chain(axes.iter().map(String::as_str));
    let heading = heading.chain(["task_seed"]).chain(measures.iter().copied());
    csv::record(&mut out, heading.chain(["status", "verdict", "reason"]));
    for (task, record) in done {
        let mut row = vec![task.task.to_string()];
        row.extend(axes.iter().map(|path| task.shown(path)));
        row.push(task.seed.to_string());
        let value = |name: &&str| record.finding.as_ref().and_then(|finding| finding.get(name));
        row.extend(measures.iter().map(|name| value(name).map(csv::number).unwrap_or_default()));
        row.extend(words(record));
        csv::record(&mut out, row);
    }
    out
}

/// Status, verdict, and the reason for what went wrong.
pub(super) fn words(record: &Record) -> [String; 3] {
    match (&record.finding, &record.reason) {
        (Some(finding), _) => [
            finding.status.clone(),
            finding.verdict.clone(),
            finding.trouble.clone().unwrap_or_default(),
        ],
        (None, reason) => ["impossible".into(), "none".into(), reason.clone().unwrap_or_default()],
    }
}

fn object(folder: &Folder, done: &[(Task, Record)]) -> Json {
    let plan = folder.plan();
    let tasks = done.iter().map(|(task, record)| {
        json!({
            "task": task.task,
            "seed": task.seed,
            "settings": task.settings,
            "finding": record.finding,
            "reason": record.reason,
        })
    });
    json!({
        "grid": plan.grid,
        "title": plan.title,
        "plan": plan.hash,
        "axes": plan.axes,
        "tasks": tasks.collect::<Vec<_>>(),
    })
}

fn times(done: &[(Task, Record)]) -> String {
    let mut out = "task,seconds,machine\n".to_string();
    for (task, Record { machine, .. }) in done {
        let seconds = csv::number(machine.seconds);
        csv::record(&mut out, [task.task.to_string(), seconds, machine.platform.clone()]);
    }
    out
}
