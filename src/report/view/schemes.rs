//! The schemes side by side, scene by scene.

use super::attempt::listed;
use super::{Document, Outcome, View};
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table, markup};
use crate::report::study::comparison::Sample;
use crate::report::study::schemes::{Case, Finding, Plan, Run, Times};

impl View for Plan {
    const TITLE: &'static str = "One scene, every scheme";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.table("schemes_at_the_end", at_the_end(findings));
        for finding in findings {
            let case = &finding.case;
            let title = markup::literal(&finding.title);
            document.text(format!("**{title}.** {}", case.text));
            document.figure(figure(finding));
            document.table(&format!("formulations_{}", case.name), table(finding));
            if let Some(footage) = &finding.footage {
                let caption = "The same scene, the same instants. Arrows are forces, where the \
                               scheme has them; what lies far outside is no longer drawn.";
                document.footage(footage, caption);
            }
        }
    }

    fn answer(&self, findings: &[Finding]) -> Option<String> {
        let first = findings.first()?;
        let names: Vec<&str> =
            first.runs.iter().filter(|run| run.is_plain()).map(|run| &*run.name).collect();
        let fails = |name: &str| {
            let broken = findings.iter().filter(|finding| {
                finding.runs.iter().any(|run| run.name == name && is_broken(&finding.case, run))
            });
            broken.map(|finding| format!("*{}*", finding.case.name)).collect::<Vec<_>>()
        };
        let (whole, broken): (Vec<&str>, Vec<&str>) =
            names.iter().partition(|name| fails(name).is_empty());
        let told = |name: &&str| format!("{name} ({})", listed(&fails(name)));
        let broken: Vec<String> = broken.iter().map(told).collect();
        let not =
            if broken.is_empty() { String::new() } else { format!("; not {}", listed(&broken)) };
        Some(format!(
            "**Which way to step?** To the end of every scene, with their energy in bounds, come \
             {}{not}. The first table has by how much the energy and the places of each are off at the end.",
            listed(&whole)
        ))
    }

    fn show_times(&self, times: &[Times], document: &mut Document) {
        let row = |case: &str, (name, seconds): &(String, f64)| {
            vec![Cell::text(case), Cell::text(name), Cell::number(1e3 * seconds, 3)]
        };
        let rows = times.iter().flat_map(|t| t.step_seconds.iter().map(|step| row(&t.case, step)));
        let table = Table {
            title: "What a step of each scheme takes".into(),
            how_to_read: "Mean over the run, measuring energy and errors included; runs share the \
                          processor, so these are upper bounds."
                .into(),
            columns: vec![
                Column::words("scene"),
                Column::words("scheme"),
                Column::numbers("a step", "ms"),
            ],
            rows: rows.collect(),
            ..Table::default()
        };
        document.table("formulations_times", table);
    }

    fn outcome(&self, _: &[Finding]) -> Outcome {
        Outcome::undecided()
    }
}

/// A row a scheme, for each scene what energy and place are off by at its end.
fn at_the_end(findings: &[Finding]) -> Table {
    let names = findings.first().map_or(&[][..], |finding| &finding.runs);
    let of = |name: &str, finding: &Finding| -> [Cell; 2] {
        let none = || [Cell::text("–"), Cell::text("–")];
        let Some(run) = finding.runs.iter().find(|run| run.name == name) else { return none() };
        match is_broken(&finding.case, run) {
            true => [Cell::text("out of bounds").marked(Mark::Bad), Cell::text("–")],
            false => [run.energy_at_end(), run.error_at_end().map(|off| 1e3 * off)]
                .map(|value| value.map_or(Cell::text("–"), tiny)),
        }
    };
    let row = |run: &Run| {
        let cells = findings.iter().flat_map(|finding| of(&run.name, finding));
        [Cell::text(&run.name)].into_iter().chain(cells).collect()
    };
    let heads = findings.iter().flat_map(|finding| {
        let name = &finding.case.name;
        [
            Column::numbers(format!("{name}: energy"), "J"),
            Column::numbers(format!("{name}: off"), "mm"),
        ]
    });
    Table {
        title: "Where each scheme ends".into(),
        how_to_read: "For each scene the change of energy from start to end, and the drift or overlap at the end. What \
                      the energy should do stands at each scene below."
            .into(),
        columns: [Column::words("scheme")].into_iter().chain(heads).collect(),
        rows: names.iter().filter(|run| run.is_plain()).map(row).collect(),
        ..Table::default()
    }
}

impl Run {
    /// Whether it is a scheme as it is.
    fn is_plain(&self) -> bool {
        self.name == self.scheme
    }

    /// Drift or overlap at the end (m).
    fn error_at_end(&self) -> Option<f64> {
        self.history.samples.last().map(|sample| sample.drift.max(sample.penetration))
    }

    /// Energy at the end over that of the start (J).
    fn energy_at_end(&self) -> Option<f64> {
        self.history.energy_changes().last().map(|(_, change)| *change)
    }
}

/// Whether it ended early, or its energy is out of bounds.
fn is_broken(case: &Case, run: &Run) -> bool {
    run.history.ending.is_some() || shown(case, run) < run.history.samples.len()
}

/// How many of the samples are shown: up to the first whose energy is out of bounds.
fn shown(case: &Case, run: &Run) -> usize {
    let limit = case.energy_limit.unwrap_or(f64::INFINITY);
    let changes = run.history.energy_changes();
    changes.iter().position(|(_, change)| !(change.abs() <= limit)).unwrap_or(changes.len())
}

fn figure(finding: &Finding) -> Lines {
    let case = &finding.case;
    let panel = |label: &str, unit: &str, curve: &dyn Fn(&Run) -> Vec<(f64, f64)>| {
        let curves = finding.runs.iter().map(|run| {
            let mut points = curve(run);
            points.truncate(shown(case, run));
            (run, points)
        });
        let curves: Vec<_> = curves.collect();
        let ends = curves.iter().filter(|(run, _)| is_broken(case, run));
        let ends: Vec<_> = ends.filter_map(|(_, points)| points.last().copied()).collect();
        let mut series: Vec<Series> =
            curves.into_iter().map(|(run, p)| Series::measured(run.name.clone(), p)).collect();
        if !ends.is_empty() {
            series.push(Series::points("broken off", ends));
        }
        Panel { y: Axis::linear(label, unit), series }
    };
    let any = |measure: fn(&Run) -> f64| finding.runs.iter().any(|run| measure(run) > 0.0);
    let energy = panel("energy change", "J", &|run| run.history.energy_changes());
    let mut panels = vec![energy];
    if any(|run| run.history.drift) {
        let drift = |run: &Run| run.history.curve(|s: &Sample| 1e3 * s.drift);
        panels.push(panel("constraint drift", "mm", &drift));
    }
    if any(|run| run.history.penetration) {
        let depth = |run: &Run| run.history.curve(|s: &Sample| 1e3 * s.penetration);
        panels.push(panel("penetration", "mm", &depth));
    }
    let cut = case.energy_limit.map_or(String::new(), |limit| {
        let limit = readable(limit, 3);
        format!(" A curve breaks off where the run ended, or its energy changed by over {limit} J.")
    });
    Lines {
        id: format!("formulations_{}", case.name),
        title: finding.title.clone(),
        caption: format!("Energy over that at the start, and the largest errors.{cut}"),
        x: Axis::linear("time", "s"),
        panels,
    }
}

fn table(finding: &Finding) -> Table {
    Table {
        title: format!("{}: the schemes", finding.title),
        how_to_read: "Largest values over the run, and the error of position (drift or overlap) at its end. *passes*: \
                      pivots of the solver, or sweeps over all rows, a step; what a step costs by the clock \
                      stands in the section of times. *unsolved*: solves that ended above the tolerance, by a \
                      solver or by a fixed number of sweeps."
            .into(),
        columns: vec![
            Column::words("scheme"),
            Column::words("outcome"),
            Column::words("solver"),
            Column::numbers("steps", ""),
            Column::numbers("rows", ""),
            Column::numbers("passes", "a step"),
            Column::numbers("unsolved", ""),
            Column::numbers("energy gain", "J"),
            Column::numbers("energy loss", "J"),
            Column::numbers("drift", "mm"),
            Column::numbers("penetration", "mm"),
            Column::numbers("off at the end", "mm"),
        ],
        rows: finding.runs.iter().map(|run| cells(&finding.case, run)).collect(),
        ..Table::default()
    }
}

fn cells(case: &Case, run: &Run) -> Vec<Cell> {
    let history = &run.history;
    let outcome = match &history.ending {
        Some(why) => Cell::text(why).marked(Mark::Bad),
        None if shown(case, run) < history.samples.len() => {
            Cell::text("its energy is wrong").marked(Mark::Bad)
        }
        None => Cell::text("to the end"),
    };
    let mut cells = vec![
        Cell::text(&run.name),
        outcome,
        Cell::text(run.solver.clone().unwrap_or("none".into())),
        Cell::count(history.steps),
        Cell::count(history.rows),
        Cell::number(history.passes as f64 / history.steps.max(1) as f64, 3),
        Cell::count(history.unsolved),
    ];
    let measures = [history.gain, history.loss, 1e3 * history.drift, 1e3 * history.penetration];
    cells.extend(measures.map(tiny));
    cells.push(run.error_at_end().map_or(Cell::text("–"), |off| tiny(1e3 * off)));
    cells
}

/// Two digits; what is rounding is 0.
fn tiny(value: f64) -> Cell {
    let shown = if value.abs() < 1e-9 { 0.0 } else { value };
    Cell { value: Some(value), ..Cell::number(shown, 2) }
}
