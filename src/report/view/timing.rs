//! What belongs to this machine alone.

use super::Document;
use crate::report::page::{Cell, Column, Table};
use crate::report::results::Results;

pub(super) fn section(document: &mut Document, results: &Results) {
    if results.machine.timings.is_empty() {
        return;
    }
    document.open("machine", "Times, on this machine");
    document.text(
        "This is the only section that differs from run to run and from machine to machine. Times \
         are of whole simulations: contacts, assembly, solves and motion; judging is left out.",
    );
    let steps = |scene: &str, formulation: &str, solver: &str| {
        let comparison = results.comparisons.iter().find(|c| c.scene == scene)?;
        let same = |run: &&crate::report::study::comparison::Run| {
            run.formulation == formulation && run.solver == solver
        };
        comparison.runs.iter().find(same).map(|run| run.steps)
    };
    let rows = results.machine.timings.iter().map(|timing| {
        let steps = steps(&timing.scene, &timing.formulation, &timing.solver).unwrap_or(0);
        vec![
            Cell::text(&timing.scene),
            Cell::text(&timing.formulation),
            Cell::text(&timing.solver),
            Cell::count(steps),
            Cell::number(1e3 * timing.seconds / steps.max(1) as f64, 3),
        ]
    });
    let table = Table {
        title: "Wall time of a step".into(),
        how_to_read: "Mean over the run; runs share the processor with each other.".into(),
        columns: vec![
            Column::words("scene"),
            Column::words("level"),
            Column::words("solver"),
            Column::numbers("steps", ""),
            Column::numbers("time a step", "ms"),
        ],
        rows: rows.collect(),
        ..Table::default()
    };
    document.table("timings", table);
}
