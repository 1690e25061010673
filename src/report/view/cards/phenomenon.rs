//! A phenomenon: its law, the curves of all engines, and the numbers.

use super::{ACCURATE, DEFAULTS, OWN, answer, times};
use crate::number::{capitalized, readable};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Block, Cell, Mark, Table};
use crate::report::study::cards::{Column, Measured, Phenomenon, Record, SolverPart};
use crate::report::view::ReportPage;

/// The beginning of the reason of a run without constraint rows.
pub const NO_ROWS: &str = "no rows";

/// A departure from the law above this part of the extent of a curve is visible.
const VISIBLE: f64 = 0.02;

/// The laws that have a section of their own, each with what should hold in its scene and, if the
/// record's words do not fit a sentence about it, what happens instead.
const SHOWN: [(&str, &str, &str); 5] = [
    ("creep", "A cube that friction should hold", "slides at"),
    ("lift", "A cube that should slide on the floor", ""),
    ("stopping", "A sliding cube", ""),
    ("mass_ratio", "A cube", ""),
    ("top", "A top that should precess steadily", ""),
];

/// The section of the other laws.
const OTHERS: &str = "other_laws";

fn shown(phenomenon: &Phenomenon) -> Option<&'static (&'static str, &'static str, &'static str)> {
    SHOWN.iter().find(|(name, ..)| *name == phenomenon.name)
}

/// The section with a law's numbers.
pub fn section(phenomenon: &Phenomenon) -> &str {
    if shown(phenomenon).is_some() { &phenomenon.name } else { OTHERS }
}

/// Adds a section for each of the most telling laws, and one for all others.
pub fn show_all(record: &Record, document: &mut ReportPage) {
    let (own, others): (Vec<_>, Vec<_>) =
        record.phenomena.iter().partition(|phenomenon| shown(phenomenon).is_some());
    for phenomenon in own {
        document.open(&phenomenon.name, &phenomenon.question);
        document.text(&phenomenon.matters);
        document.equation(&phenomenon.law, "the law");
        if let Some(figure) = figure(record, phenomenon) {
            document.figure(figure);
        }
        document.fold_rest();
        details(record, phenomenon, document);
    }
    if others.is_empty() {
        return;
    }
    document.open(OTHERS, "The other laws");
    document.fold_rest();
    for phenomenon in others {
        document.text(format!("**{}** {}", phenomenon.question, phenomenon.matters));
        document.equation(&phenomenon.law, "the law");
        details(record, phenomenon, document);
    }
}

/// The tolerance, the measurements and the scene.
fn details(record: &Record, phenomenon: &Phenomenon, document: &mut ReportPage) {
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
    let Phenomenon { x, y, allowed, .. } = phenomenon;
    let allowed = allowed.split_once(". ").map_or(allowed.as_str(), |(first, _)| first);
    // In the unit of the title.
    let mut measured = phenomenon.columns.iter().flat_map(|own| &own.measured);
    let (unit, scale) = match y.unit == "m" && measured.any(|own| own.unit == "mm") {
        true => ("mm", 1e3),
        false => (y.unit.as_str(), 1.0),
    };
    let points = |y: &[f64]| -> Vec<(f64, f64)> {
        x.values.iter().copied().zip(y.iter().map(|y| scale * y)).collect()
    };
    let installed = phenomenon.columns.iter().filter(|own| own.settings == DEFAULTS);
    let breaks = installed.filter(|own| !own.holds() && is_apart(&own.y, &y.law));
    let breaks = breaks.map(|own| {
        let name = record.title(&own.engine);
        Series::measured(name, points(&own.y)).labeled(name)
    });
    let law = Series::theory("law", points(&y.law)).labeled("law");
    let series: Vec<Series> = std::iter::once(law).chain(breaks).collect();
    let y = Axis::fitting(capitalized(&y.name), unit, series.iter().map(Series::size));
    let figure = Lines {
        id: format!("cards_{}", phenomenon.name),
        title: title(record, phenomenon),
        caption: format!("Allowed: {}.", allowed.trim_end_matches('.')),
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

/// The finding: the largest violation as installed, and how many engines obey the law.
fn title(record: &Record, phenomenon: &Phenomenon) -> String {
    let obeyed = |settings: &str| {
        let runs = phenomenon.columns.iter().filter(|own| own.engine != OWN);
        let runs = runs.filter(|own| own.settings == settings && own.unsupported.is_none());
        (runs.clone().filter(|own| own.holds()).count(), runs.count())
    };
    let ((installed, all), (accurate, _)) = (obeyed(DEFAULTS), obeyed(ACCURATE));
    let installed_runs = phenomenon.columns.iter().filter(|own| own.settings == DEFAULTS);
    let missed = installed_runs.filter_map(|own| Some((own, own.worst()?)));
    let worst = missed.filter(|(_, worst)| !worst.holds);
    let worst = worst.max_by(|a, b| a.1.miss().total_cmp(&b.1.miss()));
    let happens = match (worst, shown(phenomenon)) {
        (Some((column, worst)), Some((_, what, verb))) => {
            let verb = if verb.is_empty() { &worst.what } else { *verb };
            let engine = record.title(&column.engine);
            format!("{what} {verb} {} in {engine}; ", answer::found(worst))
        }
        _ => String::new(),
    };
    format!(
        "{happens}{installed}\u{a0}of\u{a0}{all} engines obey the law as installed, {accurate} with accurate settings"
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
