//! The page of a grid: each measure across the first axis, with one curve for each point of the
//! other axes. Nothing is solved here.

mod curves;
mod figure;
mod tables;

use self::curves::Curves;
use super::collect::{Collection, Point};
use super::file::{Grid, SUBJECT};
use super::measure::{Finding, SECONDS};
use super::plan::{Plan, Task, plain};
use crate::number::{count, readable};
use crate::report::page::{Block, Cell, Column, Fold, Origin, Page, Table, Tile};
use crate::report::results::libraries;
use crate::report::view::ReportPage;

/// The files of a collected grid.
const WHOLE: [(&str, &str); 3] = [
    ("results (CSV)", "results.csv"),
    ("results (JSON)", "results.json"),
    ("times (CSV)", "times.csv"),
];

/// The id of the section.
const RESULTS: &str = "results";
/// The table of all points is collapsed if it has more rows.
const MOST_OPEN: usize = 12;

/// The page with its figures and tables.
pub fn document(grid: &Grid, plan: &Plan, collection: &Collection) -> ReportPage {
    let page = Page {
        title: grid.title.clone(),
        lead: text(grid, plan, &collection.points()),
        facts: facts(grid, plan, collection),
        ..Page::default()
    };
    let mut document = ReportPage { page, figures: Vec::new(), tables: Vec::new() };
    document.open(RESULTS, "");
    show(grid, plan, &collection.points(), "", &mut document);
    document.page.opening.push(Block::Tiles(tiles(plan, collection)));
    document.page.sections.iter_mut().for_each(|section| {
        section.origin = Some(origin(grid));
        if collection.done.len() > MOST_OPEN {
            section.fold = Fold::After(section.blocks.len() - 1);
        }
    });
    if let Some(Block::Table(table)) =
        document.page.sections.iter_mut().flat_map(|s| &mut s.blocks).last()
    {
        table.files = WHOLE.map(|(name, file)| (name.into(), file.into())).to_vec();
    }
    document
}

/// What was measured, whether it agrees with theory, and whether a solver made a false claim.
fn tiles(plan: &Plan, collection: &Collection) -> Vec<Tile> {
    let tile = |part: usize, all: usize, label: &str| Tile {
        value: format!("{} of {}", count(part), count(all)),
        label: label.into(),
        section: RESULTS.into(),
        good: part == all,
    };
    let findings = || collection.done.iter().filter_map(|(_, record)| record.finding.as_ref());
    let claims: Vec<bool> = findings().flat_map(Finding::claims).collect();
    let mut claimed: Vec<_> = findings()
        .flat_map(|finding| &finding.predicted)
        .filter_map(|own| Some((own.measure.as_str(), own.slack?)))
        .collect();
    claimed.dedup();
    let label = match claimed[..] {
        [(measure, slack)] => {
            format!("computed {measure}s agree with the closed form to {}", readable(slack, 1))
        }
        _ => "numbers agree with the closed form".into(),
    };
    let held = claims.iter().filter(|held| **held).count();
    let theory = (!claims.is_empty()).then(|| tile(held, claims.len(), &label));
    let (measured, all) = (collection.done.len() - collection.impossible(), plan.tasks.len());
    let part = (measured < all).then(|| tile(measured, all, "points of the grid measured"));
    let claimed = collection.sum("claimed");
    let accepted = claimed - collection.sum("rejected");
    let judged =
        tile(accepted, claimed, "answers that solvers claim as solutions, accepted by the judge");
    part.into_iter().chain([judged]).chain(theory).collect()
}

/// The text of the file; the best positions, if a closed form has one, follow its first paragraph.
pub fn text(grid: &Grid, plan: &Plan, points: &[Point<'_>]) -> String {
    let best = Curves::of(grid, plan, points).and_then(|curves| tables::best(&curves));
    let text = grid.text.trim();
    match (best, text.split_once("\n\n")) {
        (Some(best), Some((first, rest))) => format!("{first} {best} {rest}"),
        (Some(best), None) => format!("{best} {text}"),
        (None, _) => text.into(),
    }
}

/// Adds figures and tables of these points to the current section; the names of their files begin
/// with `id`.
pub fn show(grid: &Grid, plan: &Plan, points: &[Point<'_>], id: &str, document: &mut ReportPage) {
    if let Some(curves) = Curves::of(grid, plan, points) {
        for measure in &grid.measures {
            if let Some(figure) = figure::figure(grid, &curves, measure, id) {
                document.figure(figure);
            }
        }
        if let Some(table) = tables::optima(&curves) {
            document.table(&format!("{id}optimum"), table);
        }
    }
    document.table(&format!("{id}tasks"), tables::results(grid, plan, points));
}

/// Adds the figure of the wall times of these points.
pub(crate) fn show_seconds(
    grid: &Grid,
    plan: &Plan,
    points: &[Point<'_>],
    id: &str,
    document: &mut ReportPage,
) {
    let curves = Curves::of(grid, plan, points);
    if let Some(figure) = curves.and_then(|curves| figure::figure(grid, &curves, &SECONDS, id)) {
        document.figure(figure);
    }
}

/// The table that `grid plan` prints: the first tasks with their varying settings.
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

/// How the results were obtained.
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

fn facts(grid: &Grid, plan: &Plan, collection: &Collection) -> Vec<(String, String)> {
    let mut facts = vec![
        ("lcplab".to_string(), env!("CARGO_PKG_VERSION").to_string()),
        ("libraries".into(), libraries().join(", ")),
        ("plan".into(), plan.hash.clone()),
        ("tasks".into(), format!("{} of {}", collection.done.len(), plan.tasks.len())),
        ("reproduce".into(), origin(grid).command),
    ];
    if collection.impossible() > 0 {
        facts.push(("impossible points".into(), collection.impossible().to_string()));
    }
    facts
}
