//! The wall time of a step in each run.

use std::collections::BTreeSet;

use crate::report::page::{Cell, Table};
use crate::report::study::comparison::Timing;

const TITLE: &str = "Wall time of a step";
const ABOUT: &str = "Mean over one simulation: contacts, assembly, solves and motion, without the judge. Several \
                     simulations ran at the same time.";

/// A row for each scheme and a column for each scene, if they have a single run; otherwise a row
/// for each run.
pub(super) fn table(times: &[Timing]) -> Table {
    let runs: BTreeSet<_> = times.iter().map(|own| (&own.scene, &own.scheme)).collect();
    let scenes = unique(times, |own| &own.scene);
    if scenes.len() > 1 && runs.len() == times.len() {
        by_scene(times, &scenes)
    } else {
        list(times)
    }
}

/// The mean time of a step (ms).
fn per_step(timing: &Timing) -> f64 {
    1e3 * timing.seconds / timing.steps.max(1) as f64
}

/// Names in the order in which they are first used.
fn unique(times: &[Timing], name: fn(&Timing) -> &str) -> Vec<&str> {
    let mut seen = BTreeSet::new();
    times.iter().map(name).filter(|name| seen.insert(*name)).collect()
}

fn by_scene(times: &[Timing], scenes: &[&str]) -> Table {
    let cell = |scheme: &str, scene: &str| {
        let time = times.iter().find(|own| own.scheme == scheme && own.scene == scene);
        time.map_or(Cell::text("–"), |time| Cell::number(per_step(time), 3))
    };
    let row = |scheme: &str| {
        let cells = scenes.iter().map(|scene| cell(scheme, scene));
        std::iter::once(Cell::text(scheme)).chain(cells).collect()
    };
    let columns = scenes.iter().map(|scene| format!("#{scene} (ms)"));
    let heads: Vec<String> = std::iter::once("scheme".to_string()).chain(columns).collect();
    let rows = unique(times, |own| &own.scheme).into_iter().map(row).collect();
    Table::new(TITLE, ABOUT, &heads.join(" | "), rows)
}

fn list(times: &[Timing]) -> Table {
    let row = |timing: &Timing| {
        vec![
            Cell::text(&timing.scene),
            Cell::text(&timing.scheme),
            Cell::text(&timing.solver),
            Cell::count(timing.steps),
            Cell::number(per_step(timing), 3),
        ]
    };
    let heads = "scene | level | solver | #steps | #time per step (ms)";
    Table::new(TITLE, ABOUT, heads, times.iter().map(row).collect())
}
