//! Collects the results of all tasks in one table, bitwise identical for any order, number of
//! threads or machines. Times are in a separate table.

use serde_json::{Value as Json, json};

use super::file::Grid;
use super::folder::{Folder, Record, pretty};
use super::measure::{Finding, MEASURES};
use super::page;
use super::plan::Task;
use super::theory::Predicted;
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
    /// The sum of a measure that counts, as `rejected`: the claims that the judge rejects.
    pub(crate) fn sum(&self, measure: &str) -> usize {
        let value = |record: &Record| record.finding.as_ref()?.get(measure);
        self.done.iter().filter_map(|(_, record)| value(record)).sum::<f64>() as usize
    }

    /// The points with their results.
    pub fn points(&self) -> Vec<Point<'_>> {
        let points = self.done.iter().map(|(task, record)| Point {
            task,
            finding: record.finding.as_ref(),
            reason: record.reason.as_deref(),
        });
        points.collect()
    }

    /// The number of tasks whose settings give no scene or problem.
    pub fn impossible(&self) -> usize {
        self.done.iter().filter(|(_, record)| record.finding.is_none()).count()
    }
}

/// A point of a grid, with its result or the reason why there is none.
#[derive(Debug, Clone, Copy)]
pub struct Point<'a> {
    /// The point.
    pub task: &'a Task,
    /// The result.
    pub finding: Option<&'a Finding>,
    /// Why there is no result: the settings give no scene or problem.
    pub reason: Option<&'a str>,
}

impl Point<'_> {
    /// The prediction of the closed form for a measure.
    pub(super) fn predicted(&self, measure: &str) -> Option<&Predicted> {
        self.finding?.predicted(measure)
    }

    /// Whether everything was solved, according to the solver.
    pub(super) fn is_solved(&self) -> bool {
        self.finding.is_some_and(|finding| finding.status == "solved")
    }

    /// A measure, if it was taken.
    pub(super) fn get(&self, measure: &str) -> Option<f64> {
        self.finding?.get(measure)
    }

    /// Status, verdict, and the reason of a failure.
    pub(super) fn words(&self) -> [String; 3] {
        match self.finding {
            Some(Finding { status, verdict, trouble, .. }) => {
                [status.clone(), verdict.clone(), trouble.clone().unwrap_or_default()]
            }
            None => ["impossible".into(), "none".into(), self.reason.unwrap_or_default().into()],
        }
    }
}

/// Reads the available results and writes `results.csv`, `results.json`, `times.csv` and a page.
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
    file::write_in(folder.path(), "results.csv", table(axes, &collection.points()))?;
    file::write_in(folder.path(), "results.json", &pretty(&object(folder, &collection.done))?)?;
    file::write_in(folder.path(), "times.csv", times(&collection.done))?;
    write::document(&page::document(grid, folder.plan(), &collection), folder.path())?;
    Ok(collection)
}

fn table(axes: &[String], points: &[Point<'_>]) -> String {
    let findings = || points.iter().filter_map(|point| point.finding);
    let is_any = |has: &dyn Fn(&Finding) -> bool| findings().any(has);
    let names = MEASURES.iter().map(|measure| measure.name);
    let is_measured = |name: &&str| is_any(&|finding| finding.values.contains_key(*name));
    let has_theory = |name: &&str| is_any(&|finding| finding.predicted(name).is_some());
    let (measures, predicted): (Vec<&str>, Vec<&str>) =
        (names.clone().filter(is_measured).collect(), names.filter(has_theory).collect());
    let mut out = String::new();
    let heading = ["task"].into_iter().chain(axes.iter().map(String::as_str));
    let heading = heading.chain(["task_seed"]).chain(measures.iter().copied()).map(String::from);
    let theory = predicted.iter().map(|name| format!("{name}_by_theory"));
    let words = ["status", "verdict", "reason"].map(String::from);
    csv::record(&mut out, heading.chain(theory).chain(words));
    for point in points {
        let mut row = vec![point.task.task.to_string()];
        row.extend(axes.iter().map(|path| point.task.shown(path)));
        row.push(point.task.seed.to_string());
        let value = |value: Option<f64>| value.map(csv::number).unwrap_or_default();
        row.extend(measures.iter().map(|name| value(point.get(name))));
        let by_theory = |name: &&str| value(point.predicted(name).map(|own| own.value));
        row.extend(predicted.iter().map(by_theory));
        row.extend(point.words());
        csv::record(&mut out, row);
    }
    out
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
