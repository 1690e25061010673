//! The page of a grid: each measure across the first axis, a curve for each point of the others.
//! Nothing is solved here.

use super::collect::{Collection, Point};
use super::file::{Grid, REPEAT, SUBJECT};
use super::measure::{MEASURES, Measure};
use super::plan::{Plan, Task, plain};
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Scale, Series};
use crate::report::page::{Block, Cell, Column, Mark, Origin, Page, Table};
use crate::report::view::Document;

/// More curves than this no eye can follow.
const MOST_CURVES: usize = 12;
/// Rows of a table on a page; all are in the CSV file.
const MOST_ROWS: usize = 500;
/// The files of a collected grid.
const WHOLE: [(&str, &str); 3] = [
    ("results (CSV)", "results.csv"),
    ("results (JSON)", "results.json"),
    ("times (CSV)", "times.csv"),
];
/// Values that spread over this ratio are drawn on a logarithmic axis.
const WIDE: f64 = 50.0;

/// The page with its figures and tables.
pub fn document(grid: &Grid, plan: &Plan, collection: &Collection) -> Document {
    let page = Page {
        title: grid.title.clone(),
        lead: grid.text.trim().to_string(),
        facts: facts(plan, collection),
        ..Page::default()
    };
    let mut document = Document { page, figures: Vec::new(), tables: Vec::new() };
    document.open("results", "What was measured");
    show(grid, plan, &collection.points(), "", &mut document);
    let origin = origin(grid);
    document.page.sections.iter_mut().for_each(|section| section.obtained(&origin));
    if let Some(Block::Table(table)) =
        document.page.sections.iter_mut().flat_map(|s| &mut s.blocks).last()
    {
        table.files = WHOLE.map(|(name, file)| (name.into(), file.into())).to_vec();
    }
    document
}

/// Adds figures and tables of these points to the section that is open; the names of their files begin with `id`.
pub fn show(grid: &Grid, plan: &Plan, points: &[Point<'_>], id: &str, document: &mut Document) {
    let curves = curves(grid, plan, points);
    for measure in &grid.measures {
        if let Some(figure) = curves.as_ref().and_then(|curves| figure(grid, curves, measure)) {
            document.figure(Lines { id: format!("{id}{}", figure.id), ..figure });
        }
    }
    if let Some(table) = curves.as_ref().and_then(optima) {
        document.table(&format!("{id}optimum"), table);
    }
    document.table(&format!("{id}tasks"), results_table(grid, plan, points));
}

/// The table that `grid plan` prints: the first tasks with what varies.
pub fn plan_table(grid: &Grid, plan: &Plan, rows: usize) -> Table {
    let columns =
        ["task"].into_iter().map(String::from).chain(plan.axes.iter().map(|p| grid.label(p)));
    let cells = |task: &Task| {
        let values = plan.axes.iter().map(|path| Cell::text(task.shown(path)));
        [Cell::text(task.task.to_string())].into_iter().chain(values).collect()
    };
    let left = plan.tasks.len().saturating_sub(rows);
    let more =
        if left > 0 { format!("and {left} more; plan.json has them all") } else { String::new() };
    Table {
        title: format!("{}: {} tasks, plan {}", plan.grid, plan.tasks.len(), plan.hash),
        how_to_read: more,
        columns: columns.map(|title| Column::numbers(title, "")).collect(),
        rows: plan.tasks.iter().take(rows).map(cells).collect(),
        ..Table::default()
    }
}

/// The results as curves across one axis.
struct Curves<'a> {
    /// The axis' name, and its unit.
    across: (String, &'static str),
    curves: Vec<Curve<'a>>,
}

/// The points that differ in the first axis alone, and in the repetition.
struct Curve<'a> {
    name: String,
    points: Vec<(f64, Point<'a>)>,
}

/// `None` if no axis has numbers.
fn curves<'a>(grid: &Grid, plan: &Plan, points: &[Point<'a>]) -> Option<Curves<'a>> {
    let is_number = |path: &&String| plan.tasks.iter().all(|task| task.number(path).is_some());
    let first = plan.axes.iter().filter(|path| *path != REPEAT).find(is_number)?;
    let zipped = grid.axes.iter().find(|axis| axis.paths.contains(first))?;
    let is_other = |path: &&String| !zipped.paths.contains(path) && *path != REPEAT;
    let others: Vec<&String> = plan.axes.iter().filter(is_other).collect();
    let mut curves: Vec<Curve> = Vec::new();
    for point in points {
        let task = point.task;
        let parts = others.iter().map(|path| match task.number(path) {
            Some(_) => format!("{} = {}", grid.label(path), task.shown(path)),
            None => task.shown(path), // the name of a solver or family has a look of its own
        });
        let name = parts.collect::<Vec<_>>().join(", ");
        let name = if name.is_empty() { "measured".to_string() } else { name };
        let point = (task.number(first)?, *point);
        match curves.iter_mut().find(|curve| curve.name == name) {
            Some(curve) => curve.points.push(point),
            None => curves.push(Curve { name, points: vec![point] }),
        }
    }
    let unit = if first == "step.dt" { "s" } else { "" };
    Some(Curves { across: (grid.label(first), unit), curves })
}

impl Curve<'_> {
    /// A measure by place, ascending; of repetitions the median, NaN where it was not taken.
    fn of(&self, measure: &str) -> Vec<(f64, f64)> {
        let value = |point: &Point| point.get(measure).unwrap_or(f64::NAN);
        let mut points: Vec<(f64, f64)> =
            self.points.iter().map(|(x, point)| (*x, value(point))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let groups = points.chunk_by(|a, b| a.0 == b.0);
        groups.map(|group| group[(group.len() - 1) / 2]).collect()
    }
}

fn figure(grid: &Grid, curves: &Curves, measure: &Measure) -> Option<Lines> {
    let shown = &curves.curves[..curves.curves.len().min(MOST_CURVES)];
    let drawn: Vec<Series> = shown
        .iter()
        .map(|curve| Series::measured(curve.name.clone(), curve.of(measure.name)))
        .collect();
    let all = || drawn.iter().flat_map(|series| series.points.iter().copied());
    let (x, y) = (spread(all().map(|(x, _)| x)), spread(all().map(|(_, y)| y)));
    y.most.is_finite().then_some(())?;
    let y_wide = grid.scale.map_or(y.wide, |scale| scale == Scale::Log);
    let floor = if y_wide { y.smallest } else { y.least };
    let mut series = drawn.clone();
    let mut words = vec![format!("{}: {}.", measure.name, measure.about)];
    if grid.theory.is_some_and(|theory| theory.measure() == measure.name) {
        series.extend(joined(
            "theory",
            shown.iter().map(|curve| curve.of("predicted")),
            Series::theory,
        ));
        let bars = shown.iter().filter_map(optimum).map(|best| vec![(best, floor), (best, y.most)]);
        series.extend(joined("optimum by theory", bars, Series::reference));
        words.push("Dashed grey: the closed form.".into());
    }
    if grid.axes.iter().any(|axis| axis.paths == [REPEAT]) {
        words.push("Each point is the median of its repetitions.".into());
    }
    if shown.len() < curves.curves.len() {
        words.push(format!("The first {} of {} curves.", shown.len(), curves.curves.len()));
    }
    let axis = |wide: bool, label: &str, unit: &str| match wide {
        true => Axis::log(label, unit),
        false => Axis::linear(label, unit),
    };
    Some(Lines {
        id: measure.name.into(),
        title: format!(
            "{}: {} across {}",
            grid.title,
            measure.name.replace('_', " "),
            curves.across.0
        ),
        caption: words.join(" "),
        x: axis(x.wide && x.least > 0.0, &curves.across.0, curves.across.1),
        panels: vec![Panel {
            y: axis(y_wide, &measure.name.replace('_', " "), measure.unit),
            series,
        }],
    })
}

/// Several curves as one series, with a gap after each; none if there are no points.
fn joined(
    name: &str,
    curves: impl Iterator<Item = Vec<(f64, f64)>>,
    series: fn(String, Vec<(f64, f64)>) -> Series,
) -> Option<Series> {
    let gap = (f64::NAN, f64::NAN);
    let points: Vec<(f64, f64)> = curves.flat_map(|curve| curve.into_iter().chain([gap])).collect();
    points.iter().any(|(_, y)| y.is_finite()).then(|| series(name.into(), points))
}

/// How values spread.
struct Spread {
    least: f64,
    most: f64,
    /// The least above 0.
    smallest: f64,
    /// Whether they ask for a logarithmic axis.
    wide: bool,
}

fn spread(values: impl Iterator<Item = f64> + Clone) -> Spread {
    let finite = || values.clone().filter(|value| value.is_finite());
    let (least, most) =
        (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    let smallest = finite().filter(|value| *value > 0.0).fold(f64::INFINITY, f64::min);
    let wide = least >= 0.0 && most / smallest >= WIDE;
    Spread { least, most, smallest, wide }
}

/// Where theory says that the least is.
fn optimum(curve: &Curve) -> Option<f64> {
    curve.points.iter().find_map(|(_, point)| point.get("optimum"))
}

/// Where each curve has its least, beside where theory says.
fn optima(curves: &Curves) -> Option<Table> {
    let across = &curves.across.0;
    let row = |curve: &Curve| {
        let best = optimum(curve)?;
        let points = curve.of("iterations");
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
        title: "The fewest iterations, and where theory has them".into(),
        how_to_read: format!(
            "Of the points that were tried the one with the fewest iterations, beside the {across} \
             at which the spectral radius is least."
        ),
        columns: vec![
            Column::words("curve"),
            Column::numbers(format!("{across} of the fewest"), ""),
            Column::numbers("iterations", ""),
            Column::numbers(format!("{across} by theory"), ""),
        ],
        rows,
        ..Table::default()
    })
}

fn results_table(grid: &Grid, plan: &Plan, points: &[Point<'_>]) -> Table {
    let findings = || points.iter().filter_map(|point| point.finding);
    let shown = |measure: &&Measure| {
        let asked = grid.measures.contains(measure)
            || ["predicted", "iterations", "scaled_residual"].contains(&measure.name);
        asked && findings().any(|finding| finding.values.contains_key(measure.name))
    };
    let measures: Vec<&Measure> = MEASURES.iter().filter(shown).collect();
    let mut columns = vec![Column::numbers("task", "")];
    columns.extend(plan.axes.iter().map(|path| Column::numbers(grid.label(path), "")));
    columns.extend(measures.iter().map(|m| Column::numbers(m.name.replace('_', " "), m.unit)));
    columns.extend(["status", "verdict", "reason"].map(Column::words));
    let rows = points.iter().take(MOST_ROWS).map(|point| {
        let mut row = vec![Cell::count(point.task.task)];
        row.extend(plan.axes.iter().map(|path| setting(point.task, path)));
        row.extend(measures.iter().map(|measure| cell(point, measure)));
        let [status, verdict, reason] = point.words();
        let mark = if point.get("refuted") > Some(0.0) { Mark::Bad } else { Mark::Plain };
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
    Table {
        title: "What was found at each point".into(),
        how_to_read: format!(
            "Status: the solver's word. Verdict: the judge's, on the worst answer.{more}"
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

fn cell(point: &Point, measure: &Measure) -> Cell {
    match point.get(measure.name) {
        None => Cell::text("–"),
        Some(value) if value.fract() == 0.0 && (0.0..1e9).contains(&value) => {
            Cell::count(value as usize)
        }
        Some(value) => Cell::number(value, 4),
    }
}

/// How all of it was obtained.
fn origin(grid: &Grid) -> Origin {
    let fixed = grid.settings.iter().filter(|(path, _)| !SUBJECT[..2].contains(&path.as_str()));
    let subjects = SUBJECT[..2].iter().flat_map(|kind| grid.values_of(kind));
    let words = |values: Vec<String>| values.join(", ");
    Origin {
        scene: words(subjects.map(plain).collect()),
        settings: words(fixed.map(|(path, value)| format!("{path} = {}", plain(value))).collect()),
        command: format!("lcplab grid run {0}; lcplab grid collect {0}", grid.name),
    }
}

fn facts(plan: &Plan, collection: &Collection) -> Vec<(String, String)> {
    let mut facts = vec![
        ("lcplab".to_string(), env!("CARGO_PKG_VERSION").to_string()),
        ("grid".into(), plan.grid.clone()),
        ("plan".into(), plan.hash.clone()),
        ("tasks".into(), format!("{} of {}", collection.done.len(), plan.tasks.len())),
    ];
    if collection.impossible() > 0 {
        facts.push(("impossible points".into(), collection.impossible().to_string()));
    }
    facts
}
