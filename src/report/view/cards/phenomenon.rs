//! A phenomenon: its law, the curves of all engines, and the numbers.

use super::{ACCURATE, DEFAULTS, times};
use crate::number::{capitalized, readable};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Block, Cell, Mark, Table};
use crate::report::study::cards::{Column, Measured, Phenomenon, Record, SolverPart};
use crate::report::view::ReportPage;

/// The beginning of the reason of a run without constraint rows.
pub const NO_ROWS: &str = "no rows";

/// A departure from the law above this part of the extent of a curve is visible.
const VISIBLE: f64 = 0.02;

/// Adds a section.
pub fn show(record: &Record, phenomenon: &Phenomenon, document: &mut ReportPage) {
    document.open(&phenomenon.name, &phenomenon.question);
    document.text(&phenomenon.matters);
    document.equation(&phenomenon.law, "the law");
    match figure(record, phenomenon) {
        Some(figure) => document.figure(figure),
        None => document.text(format!("{}.", title(record, phenomenon))),
    }
    document.fold_rest();
    document.text(format!("**Allowed**: {}", phenomenon.allowed));
    if !phenomenon.reported.is_empty() {
        document.text(&phenomenon.reported);
    }
    document.table(&format!("cards_{}", phenomenon.name), table(record, phenomenon));
    let (language, text) = ("toml".into(), phenomenon.scene.clone());
    document.add(Block::FoldedCode { language, text });
}

/// The law and the engines that break it as installed; nothing if none does.
fn figure(record: &Record, phenomenon: &Phenomenon) -> Option<Lines> {
    let Phenomenon { x, y, .. } = phenomenon;
    let points = |y: &[f64]| x.values.iter().copied().zip(y.iter().copied()).collect::<Vec<_>>();
    let installed = phenomenon.columns.iter().filter(|own| own.settings == DEFAULTS);
    let breaks = installed.filter(|own| !own.holds() && is_apart(&own.y, &y.law));
    let breaks = breaks.map(|own| {
        let name = record.title(&own.engine);
        Series::measured(name, points(&own.y)).labeled(name)
    });
    let law = Series::theory("law", points(&y.law)).labeled("law");
    let series: Vec<Series> = std::iter::once(law).chain(breaks).collect();
    let y = Axis::fitting(capitalized(&y.name), &y.unit, series.iter().map(Series::size));
    let figure = Lines {
        id: format!("cards_{}", phenomenon.name),
        title: title(record, phenomenon),
        caption: "Pale: the law. Lines: the engines that visibly break it as installed.".into(),
        x: match phenomenon.log {
            true => Axis::log(&x.name, &x.unit),
            false => Axis::linear(&x.name, &x.unit),
        },
        panels: vec![Panel { y, series }],
    };
    Some(figure.with_scales_explained()).filter(|figure| figure.panels[0].series.len() > 1)
}

/// Whether a curve departs visibly from the law.
fn is_apart(y: &[f64], law: &[f64]) -> bool {
    let extent = |values: &[f64]| {
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        largest - values.iter().copied().fold(f64::INFINITY, f64::min)
    };
    let apart = y.iter().zip(law).map(|(y, law)| (y - law).abs()).fold(0.0, f64::max);
    apart > VISIBLE * extent(law).max(extent(y))
}

/// The finding: how many engines break the law as installed, the largest violation, and how many
/// break it with accurate settings.
fn title(record: &Record, phenomenon: &Phenomenon) -> String {
    let runs = |settings: &str| -> Vec<&Column> {
        let runs = phenomenon.columns.iter().filter(|own| own.settings == settings);
        runs.filter(|own| own.unsupported.is_none()).collect()
    };
    let broken = |runs: &[&Column], none: &str| {
        let count = runs.iter().filter(|own| !own.holds()).count();
        match count {
            0 => none.into(),
            _ if count == runs.len() => format!("all {count}"),
            _ => format!("{count} of {}", runs.len()),
        }
    };
    let (installed, accurate) = (runs(DEFAULTS), runs(ACCURATE));
    let quantity = capitalized(&phenomenon.name.replace('_', " "));
    let missed = installed.iter().filter_map(|own| Some((own, own.worst()?.miss())));
    let worst = missed.filter(|(own, _)| !own.holds()).max_by(|a, b| a.1.total_cmp(&b.1));
    let worst = worst.map_or(String::new(), |(own, miss)| match miss.is_finite() {
        true => format!(", {} by {} the tolerance", record.title(&own.engine), times(miss)),
        false => format!(", {} without bound", record.title(&own.engine)),
    });
    format!(
        "{quantity}: as installed {} engines break the law{worst}; with accurate settings {}",
        broken(&installed, "no"),
        broken(&accurate, "none")
    )
}

fn table(record: &Record, phenomenon: &Phenomenon) -> Table {
    let nothing = |own: &Column| {
        let (why, mark) = match (&own.unsupported, &own.failed) {
            (Some(why), _) => (why.as_str(), Mark::Plain),
            (None, Some(why)) => (why.as_str(), Mark::Bad),
            (None, None) => ("nothing was measured", Mark::Bad),
        };
        let words = [record.title(&own.engine), &own.settings, why].map(Cell::text);
        let [engine, settings, why] = words;
        let dash = || Cell::text("–");
        vec![engine, settings, why.marked(mark), dash(), dash(), dash(), dash(), dash()]
    };
    let rows = phenomenon.columns.iter().flat_map(|own| match own.measured.is_empty() {
        true => vec![nothing(own)],
        false => own.measured.iter().map(|measured| row(record, own, measured)).collect(),
    });
    Table::new(
        format!("Measured: {}", phenomenon.name.replace('_', " ")),
        "A law is obeyed if the measured number agrees with that of the law within the \
         tolerance. *Solver's part* of a violation: the largest error of the engine's solver in a step, relative to \
         the change of the motion in that step, from receipts of up to 25 steps a run. If it is small, the cause is the \
         engine's contact model, its integrator or the length of its step.",
        "engine | settings | what was measured | #found | #law | #tolerance | verdict | solver's part",
        rows.collect(),
    )
}

fn row(record: &Record, column: &Column, measured: &Measured) -> Vec<Cell> {
    vec![
        Cell::text(record.title(&column.engine)),
        Cell::text(&column.settings),
        Cell::text(format!("{} ({})", measured.what, measured.unit)),
        Cell::number(measured.value, 4),
        Cell::number(measured.law, 4),
        Cell::number(measured.tolerance, 2),
        match measured.holds {
            true => Cell::text("met").marked(Mark::Good),
            false => Cell::text(times(measured.miss())).marked(Mark::Bad),
        },
        match (measured.holds, &column.solver) {
            (false, Some(part)) => solvers_part(part),
            _ => Cell::text(""),
        },
    ]
}

/// How much of a violation is the solver's.
fn solvers_part(part: &SolverPart) -> Cell {
    match part {
        SolverPart::Unchecked { why } => Cell::text(match why.starts_with(NO_ROWS) {
            true => format!("none: {why}"),
            false => format!("not checked: {why}"),
        }),
        SolverPart::Checked { above: 0, error, is_bound, .. } => {
            let at_most = if *is_bound { "at most " } else { "residual " };
            Cell::text(format!("{at_most}{}", readable(*error, 2))).marked(Mark::Good)
        }
        SolverPart::Checked { above, steps, error, limit, .. } => Cell::text(format!(
            "{} in {above} of {steps} steps above {}",
            readable(*error, 2),
            readable(*limit, 2)
        ))
        .marked(Mark::Bad),
    }
}
