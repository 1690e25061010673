//! All solvers at both levels, scene by scene.

use super::Document;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Page, Table, markup};
use crate::report::study::comparison::{Comparison, Run, Sample};

pub(super) fn section(document: &mut Document, comparisons: &[Comparison]) {
    if comparisons.is_empty() {
        return;
    }
    document.open("comparison", "Solvers and levels on the same scenes");
    let runs = || comparisons.iter().flat_map(|comparison| &comparison.runs);
    let (solves, claimed) =
        (runs().map(|run| run.solves).sum::<usize>(), runs().map(|run| run.claimed).sum::<usize>());
    let refuted = runs().map(|run| run.refuted_claims).sum::<usize>();
    document.text(format!(
        "Each scene was stepped by each solver, once with impulses (velocity level) and once with \
         forces (acceleration level), every solve starting from the answer of the step before. Of \
         {solves} problems the solvers claim to have solved {claimed}; the judge refutes {refuted} \
         of these claims.",
    ));
    for comparison in comparisons {
        let id = format!("comparison_{}", comparison.scene);
        document.text(format!(
            "**{}.** {}",
            markup::literal(&comparison.title),
            markup::literal(comparison.teaches.trim())
        ));
        document.table(&id, table(comparison));
    }
}

/// One scene's runs as a table.
pub fn table(comparison: &Comparison) -> Table {
    let Comparison { scene, steps, dt, .. } = comparison;
    let mut columns = vec![
        Column::words("level"),
        Column::words("solver"),
        Column::numbers("steps", ""),
        Column::numbers("problems", ""),
        Column::numbers("claims", ""),
        Column::numbers("accepted", ""),
        Column::numbers("iterations", "a problem"),
        Column::numbers("worst residual", ""),
        Column::numbers("energy change", "J"),
        Column::numbers("drift", "m"),
        Column::numbers("penetration", "m"),
    ];
    let trouble = comparison.runs.iter().any(|run| run.trouble.is_some());
    if trouble {
        columns.push(Column::words("trouble"));
    }
    let mut rows: Vec<Vec<Cell>> =
        comparison.runs.iter().map(|run| cells(run, comparison.steps)).collect();
    if trouble {
        for (row, run) in rows.iter_mut().zip(&comparison.runs) {
            row.push(Cell::text(run.trouble.clone().unwrap_or_default()));
        }
    }
    Table {
        title: format!("{scene}: {steps} steps of {dt} s"),
        how_to_read: "*claims* are problems that the solver calls solved, *accepted* those where \
                      the judge agrees; the *worst residual* is the judge's, over all problems."
            .into(),
        columns,
        rows,
        files: Vec::new(),
    }
}

fn cells(run: &Run, steps: usize) -> Vec<Cell> {
    let mark = |good: bool| if good { Mark::Plain } else { Mark::Bad };
    vec![
        Cell::text(&run.formulation),
        Cell::text(&run.solver),
        Cell::count(run.steps).marked(mark(run.steps == steps)),
        Cell::count(run.solves),
        Cell::count(run.claimed).marked(mark(run.claimed == run.solves)),
        Cell::count(run.accepted).marked(mark(run.accepted == run.solves)),
        Cell::number(run.iterations as f64 / run.solves.max(1) as f64, 3),
        Cell::number(run.worst_residual, 2),
        Cell::number(run.energy_change(), 2),
        Cell::number(run.worst(|sample| sample.drift), 2),
        Cell::number(run.worst(|sample| sample.penetration), 2),
    ]
}

/// A page of its own for one scene: the table, and the motion by solver and level.
pub fn document(comparison: &Comparison) -> Document {
    let page = Page {
        title: comparison.title.clone(),
        lead: markup::literal(comparison.teaches.trim()),
        ..Page::default()
    };
    let mut document = Document { page, figures: Vec::new(), tables: Vec::new() };
    document.open("comparison", "Solvers and levels");
    document.table(&format!("comparison_{}", comparison.scene), table(comparison));
    document.figure(motion_figure(comparison));
    document
}

/// Energy, drift and penetration of all runs over time.
fn motion_figure(comparison: &Comparison) -> Lines {
    let panel = |label: &str, unit: &str, measure: fn(&Run, &Sample) -> f64| Panel {
        y: Axis::linear(label, unit),
        series: comparison
            .runs
            .iter()
            .map(|run| {
                let point = |sample: &Sample| (sample.time, measure(run, sample));
                let name = format!("{}, {}", run.solver, run.formulation);
                Series::measured(name, run.motion.iter().map(point).collect())
            })
            .collect(),
    };
    let mut panels = vec![panel("energy change", "J", |run, sample| {
        sample.energy - run.motion.first().map_or(0.0, |first| first.energy)
    })];
    let any = |measure: fn(&Sample) -> f64| {
        comparison.runs.iter().any(|run| run.motion.iter().any(|sample| measure(sample) > 0.0))
    };
    if any(|sample| sample.drift) {
        panels.push(panel("constraint drift", "m", |_, sample| sample.drift));
    }
    if any(|sample| sample.penetration) {
        panels.push(panel("penetration", "m", |_, sample| sample.penetration));
    }
    Lines {
        id: format!("motion_{}", comparison.scene),
        title: format!("{}: energy and errors", comparison.title),
        caption: "Solvers that solve every step draw the same curve; levels differ.".into(),
        x: Axis::linear("time", "s"),
        panels,
    }
}
