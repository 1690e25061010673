//! What the last step's answer saves.

use super::attempt::{anchor, section_id};
use super::{Document, Outcome, View};
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::warm_start::{Pair, Plan, Run};

impl View for Plan {
    const TITLE: &'static str = "What a warm start saves";

    fn show(&self, runs: &[Run], document: &mut Document) {
        document.text(
            "A simulation solves nearly the same problem over and over: what carried the stack a step \
             ago carries it now. Each problem below was solved twice by the same method, once from the \
             impulses of the last step and once from 0. The trajectories are those of the warm solves.",
        );
        let id = section_id(document);
        for of_scene in runs.chunk_by(|a, b| a.scene == b.scene) {
            document.figure(figure(&id, of_scene));
        }
        document.table(&id, table(runs));
        document.text(words(runs));
    }

    fn outcome(&self, runs: &[Run]) -> Outcome {
        let whole = runs.iter().filter(|run| run.failure.is_none()).count();
        let unsolved: usize =
            runs.iter().flat_map(|run| &run.steps).map(|pair| pair.unsolved).sum();
        let says = format!(
            "{whole} of {} runs come to their end, {unsolved} solves not claimed solved",
            runs.len()
        );
        Outcome { good: whole == runs.len(), says }
    }
}

/// The number of solves that were done in all steps, one way or the other.
fn total(run: &Run, of: fn(&Pair) -> f64) -> f64 {
    run.steps.iter().map(of).sum()
}

/// Iterations with a warm start, as a part of those without.
fn left(run: &Run) -> f64 {
    total(run, |pair| pair.warm as f64) / total(run, |pair| pair.cold as f64)
}

/// The runs of a scene.
fn figure(section: &str, runs: &[Run]) -> Lines {
    let curve = |run: &Run, of: fn(&Pair) -> f64| -> Vec<(f64, f64)> {
        run.steps.iter().enumerate().map(|(k, pair)| (k as f64 + 1.0, of(pair))).collect()
    };
    let panel = |label: &str, of: fn(&Pair) -> f64| Panel {
        y: Axis::log(label, "a step"),
        series: runs.iter().map(|run| Series::measured(&run.solver, curve(run, of))).collect(),
    };
    let (scene, title) = runs.first().map_or(("", ""), |run| (&run.scene, &run.title));
    Lines {
        id: format!("{section}_{}", anchor(scene)),
        title: format!("{title}: iterations of each step"),
        caption: "Above from 0, below from the last step's impulses. A step that needs no iteration, \
                  because the old answer is within the tolerance, is an open wedge at the foot. Sweeps \
                  keep what they are given; a pivoting method must first undo an active set that is not \
                  the one it would have built."
            .into(),
        x: Axis::linear("step", ""),
        panels: vec![
            panel("iterations, cold", |pair| pair.cold as f64),
            panel("iterations, warm", |pair| pair.warm as f64),
        ],
    }
}

fn table(runs: &[Run]) -> Table {
    let row = |run: &Run| {
        let part = |part: f64| match part.is_finite() {
            true => {
                let cell = Cell::number(100.0 * part, 3);
                cell.marked(if part < 0.5 { Mark::Good } else { Mark::Plain })
            }
            false => Cell::text("–"),
        };
        let unsolved = run.steps.iter().map(|pair| pair.unsolved).sum();
        let work = total(run, |pair| pair.warm_work) / total(run, |pair| pair.cold_work);
        vec![
            Cell::text(&run.scene),
            Cell::text(&run.solver),
            Cell::count(run.steps.len()),
            Cell::number(total(run, |pair| pair.cold as f64) / run.steps.len() as f64, 3),
            Cell::number(total(run, |pair| pair.warm as f64) / run.steps.len() as f64, 3),
            part(left(run)),
            part(work),
            Cell::count(unsolved).marked(if unsolved == 0 { Mark::Plain } else { Mark::Note }),
            Cell::text(run.failure.as_deref().unwrap_or("")),
        ]
    };
    Table {
        title: "Cold and warm, step by step".into(),
        how_to_read: "*cold*, *warm*: iterations a step, on average over all steps. *left*: what the warm \
                      start leaves of them, and of the multiplications. *unsolved*: solves of either kind \
                      that were not claimed solved; they count with the iterations they took."
            .into(),
        columns: vec![
            Column::words("scene"),
            Column::words("solver"),
            Column::numbers("steps", ""),
            Column::numbers("cold", "iterations a step"),
            Column::numbers("warm", "iterations a step"),
            Column::numbers("left", "% of iterations"),
            Column::numbers("left", "% of multiplications"),
            Column::numbers("unsolved", ""),
            Column::words("ended early"),
        ],
        rows: runs.iter().map(row).collect(),
        ..Table::default()
    }
}

fn words(runs: &[Run]) -> String {
    let complete = |run: &&Run| !run.steps.is_empty() && left(run).is_finite();
    let by_left = |a: &&Run, b: &&Run| left(a).total_cmp(&left(b));
    let best = runs.iter().filter(complete).min_by(by_left);
    let worst = runs.iter().filter(complete).max_by(by_left);
    let name = |run: &Run| format!("*{}* on {}", run.solver, run.scene);
    let percent = |run: &Run| readable(100.0 * left(run), 2);
    match (best, worst) {
        (Some(best), Some(worst)) => format!(
            "The warm start is worth most to {} ({} % of the iterations are left) and least to {} ({} %; \
             above 100 it is a hindrance).",
            name(best),
            percent(best),
            name(worst),
            percent(worst)
        ),
        _ => "No simulation came far enough to compare.".into(),
    }
}
