//! The tables of a grid: minima, growth, and every point.

use super::curves::{Curve, Curves};
use crate::number::readable;
use crate::report::grid::collect::Point;
use crate::report::grid::file::Grid;
use crate::report::grid::measure::{ITERATIONS, MEASURES, Measure};
use crate::report::grid::plan::{Plan, Task};
use crate::report::page::{Cell, Column, Mark, Table};

/// Maximum number of rows of a table on a page; the CSV file has all.
const MOST_ROWS: usize = 500;

/// The minimum of each curve, next to that from theory.
pub(super) fn optima(curves: &Curves<'_>) -> Option<Table> {
    let across = &curves.across;
    let row = |curve: &Curve| {
        let best = curves.optimum(curve)?;
        let points = curve.measured(&ITERATIONS);
        let least =
            points.iter().filter(|(_, y)| y.is_finite()).min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(vec![
            Cell::text(&curve.name),
            Cell::number(least.0, 4),
            Cell::count(least.1 as usize),
            Cell::number(best, 4),
        ])
    };
    let rows: Vec<Vec<Cell>> = curves.curves.iter().filter_map(row).collect();
    (!rows.is_empty()).then(|| Table {
        title: "Smallest number of iterations, and its theoretical position".into(),
        how_to_read: format!(
            "The point with the fewest iterations, compared with the {across} at which the spectral radius is \
             smallest."
        ),
        columns: vec![
            Column::words("curve"),
            Column::numbers(format!("best {across}"), ""),
            Column::numbers("iterations", ""),
            Column::numbers(format!("{across} by theory"), ""),
        ],
        rows,
        ..Table::default()
    })
}

/// How the position of the minimum depends on the curve, and what it gains.
pub(super) fn best(curves: &Curves<'_>) -> Option<String> {
    let least = |curve: &Curve| {
        curves.optimum(curve)?;
        let mut points = curve.measured(&ITERATIONS);
        points.retain(|(_, y)| y.is_finite());
        let (x, y) = *points.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let gain = points.first().filter(|(x, _)| *x == 1.0).map(|(_, first)| first / y);
        Some((x, curve.name.clone(), gain))
    };
    let all: Vec<_> = curves.curves.iter().filter_map(least).collect();
    let [(from, first, gain), .., (to, last, most)] = &all[..] else { return None };
    let across = &curves.across;
    let verb = if from < to { "rises" } else { "falls" };
    let gains = match (gain, most) {
        (Some(gain), Some(most)) => format!(
            "; {across} = 1 needs {} to {} times as many sweeps",
            readable(*gain, 2),
            readable(*most, 2)
        ),
        _ => String::new(),
    };
    let [from, to] = [from, to].map(|x| readable(*x, 3));
    Some(format!("The best {across} {verb} from {from} ({first}) to {to} ({last}){gains}."))
}

/// A measure's name in words.
fn words(measure: &Measure) -> String {
    measure.name.replace('_', " ")
}

/// Measures that are always shown.
const ALWAYS: [&str; 3] = ["iterations", "eigenvalue", "scaled_residual"];

/// Every point: its settings, the measures next to theory, and the texts.
pub(super) fn results(grid: &Grid, plan: &Plan, points: &[Point<'_>]) -> Table {
    let findings = || points.iter().filter_map(|point| point.finding);
    let shown = |measure: &&Measure| {
        let asked = grid.measures.contains(measure) || ALWAYS.contains(&measure.name);
        asked && findings().any(|finding| finding.values.contains_key(measure.name))
    };
    let measures: Vec<&Measure> = MEASURES.iter().filter(shown).collect();
    // The claim about the rate is checked on the eigenvalue.
    let is_predicted = |measure: &Measure| {
        let is_checked_elsewhere =
            measure.name == "eigenvalue" && measures.iter().any(|own| own.name == "rate");
        !is_checked_elsewhere && findings().any(|own| own.predicted(measure.name).is_some())
    };
    let has_theory: Vec<bool> = measures.iter().map(|measure| is_predicted(measure)).collect();
    let mut columns = vec![Column::numbers("task", "")];
    let is_number = |path: &String| points.iter().all(|point| point.task.number(path).is_some());
    columns.extend(plan.axes.iter().map(|path| match is_number(path) {
        true => Column::numbers(grid.label(path), ""),
        false => Column::words(grid.label(path)),
    }));
    for (measure, has_theory) in measures.iter().zip(&has_theory) {
        columns.push(Column::numbers(words(measure), measure.unit));
        columns.extend(has_theory.then(|| Column::numbers("by theory", measure.unit)));
    }
    columns.extend(["status", "verdict", "reason"].map(Column::words));
    let rows = points.iter().take(MOST_ROWS).map(|point| {
        let mut row = vec![Cell::count(point.task.task)];
        row.extend(plan.axes.iter().map(|path| setting(point.task, path)));
        for (measure, has_theory) in measures.iter().zip(&has_theory) {
            row.push(measured(point, measure));
            row.extend(has_theory.then(|| by_theory(point, measure)));
        }
        let [status, verdict, reason] = point.words();
        let mark = if point.get("rejected") > Some(0.0) { Mark::Bad } else { Mark::Plain };
        row.extend([
            Cell::text(status),
            Cell::text(verdict.replace('_', " ")).marked(mark),
            Cell::text(reason),
        ]);
        row
    });
    let rows: Vec<Vec<Cell>> = rows.collect();
    let left = points.len() - rows.len();
    let more =
        if left > 0 { format!(" {left} more rows are in results.csv.") } else { String::new() };
    let theory = match has_theory.contains(&true) {
        true => {
            " Marks show whether a value agrees with the closed form. Values without a mark are compared with \
             a rule of thumb, which makes no exact prediction."
        }
        false => "",
    };
    Table {
        title: "Results at each point".into(),
        how_to_read: format!(
            "*Status*: the solver's own claim. *Verdict*: the judge's; if a row covers several problems, the worst one. \
             lcplab attempts no proof of the answers of a simulation, so their best verdict is *within tolerance*.{theory}{more}"
        ),
        columns,
        rows,
        ..Table::default()
    }
}

fn setting(task: &Task, path: &str) -> Cell {
    match task.number(path) {
        Some(value) => Cell { text: readable(value, 6), value: Some(value), ..Cell::default() },
        None => Cell::text(task.shown(path)),
    }
}

fn value(value: f64) -> Cell {
    match value.fract() == 0.0 && (0.0..1e9).contains(&value) {
        true => Cell::count(value as usize),
        false => Cell::number(value, 5),
    }
}

/// A measured value, marked if theory makes a claim about it.
fn measured(point: &Point, measure: &Measure) -> Cell {
    let Some(found) = point.get(measure.name) else { return Cell::text("–") };
    let holds = point.predicted(measure.name).and_then(|own| own.holds(found));
    value(found).marked(match holds {
        Some(true) => Mark::Good,
        Some(false) => Mark::Bad,
        None => Mark::Plain,
    })
}

fn by_theory(point: &Point, measure: &Measure) -> Cell {
    point.predicted(measure.name).map_or(Cell::text("–"), |own| value(own.value))
}
