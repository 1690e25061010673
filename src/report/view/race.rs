//! How the residual falls by iteration, by multiplication and by second.

use super::attempt::{anchor, outcome, tolerance};
use super::{Document, Outcome as Verdict, View};
use crate::number::{count, readable};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Table};
use crate::report::study::attempt::Outcome;
use crate::report::study::race::{Clock, Mark, Plan, Race, Runner};
use crate::solver::Group;

/// A residual of exactly 0 has no place on a logarithmic axis; it is drawn here.
const LEAST: f64 = 1e-17;

impl View for Plan {
    const TITLE: &'static str = "The same problem, many methods";

    fn show(&self, races: &[Race], document: &mut Document) {
        document.text(
            "Counting iterations flatters methods whose iterations are dear: a Newton step solves a \
             linear system, a sweep is one product with A. So each race is shown twice, by iteration \
             and by multiplication, counted by the leading term of each method; \
             by second it stands in the last section. Pivoting methods have no residual worth the name \
             until they end: their end is a marker.",
        );
        for race in races {
            document.figure(by_iteration(race));
            document.figure(by_work(race));
            document.table(&id(&race.problem, "table"), table(race));
        }
    }

    fn outcome(&self, races: &[Race]) -> Verdict {
        let runners = || races.iter().flat_map(|race| &race.runners);
        let refuted = runners().filter(|runner| runner.outcome == Outcome::Refuted).count();
        let solved = runners().filter(|runner| runner.outcome.is_solved()).count();
        let says = format!("{solved} of {} arrived, {refuted} claims refuted", runners().count());
        Verdict { good: refuted == 0, says }
    }

    fn show_times(&self, clocks: &[Clock], document: &mut Document) {
        for clock in clocks {
            document.figure(by_second(clock));
        }
    }
}

fn id(problem: &str, what: &str) -> String {
    format!("race_{}_{what}", anchor(problem))
}

/// The runners as curves, those that only have an end as points; solved or not.
fn series(race: &Race, across: fn(&Mark) -> f64) -> Vec<Series> {
    let took_part = |runner: &&Runner| runner.outcome.is_attempt();
    let points = |runner: &Runner| -> Vec<(f64, f64)> {
        let points = runner.marks.iter().map(|mark| (across(mark), mark.residual.max(LEAST)));
        points.filter(|(across, _)| across.is_finite()).collect()
    };
    let series = |runner: &Runner| curve(&runner.solver, points(runner));
    let series = race.runners.iter().filter(took_part).map(series);
    series.filter(|series| !series.points.is_empty()).collect()
}

fn curve(solver: &str, points: Vec<(f64, f64)>) -> Series {
    match Group::of(solver) {
        Some(Group::Pivoting) => Series::points(solver, points),
        _ => Series::measured(solver, points),
    }
}

/// A line at the residual that was asked for.
fn asked(race: &Race, across: fn(&Mark) -> f64) -> Series {
    let marks = race.runners.iter().flat_map(|runner| &runner.marks).map(across);
    let last = marks.fold(1.0, f64::max);
    let name = format!("asked for: {}", tolerance(race.tolerance));
    Series::reference(name, vec![(1e-3, race.tolerance), (10.0 * last, race.tolerance)])
}

fn by_iteration(race: &Race) -> Lines {
    let across = |mark: &Mark| mark.iteration as f64;
    let mut curves = series(race, across);
    curves.push(asked(race, across));
    Lines {
        id: id(&race.problem, "iterations"),
        title: format!("{}: residual by iteration", race.problem),
        caption: format!(
            "{} rows; ω of SOR is {}. Second-order methods fall off a cliff, most of them after a few steps. Sweeps \
             take the rough part of the error away at once and then crawl: what is left is smooth, and a \
             row sees its neighbours only.",
            count(race.rows),
            readable(race.omega, 3)
        ),
        x: Axis::log("iteration", ""),
        panels: vec![Panel { y: Axis::log("scaled residual", ""), series: curves }],
    }
}

fn by_work(race: &Race) -> Lines {
    let across = |mark: &Mark| mark.work;
    let mut curves = series(race, across);
    curves.push(asked(race, across));
    Lines {
        id: id(&race.problem, "work"),
        title: format!("{}: residual by multiplication", race.problem),
        caption: format!(
            "The same runs; A has {} stored entries, so many multiplications are a product. Further \
             left is cheaper: where a curve crosses the line of the residual asked for is what it \
             cost.",
            count(race.stored)
        ),
        x: Axis::log("multiplications", ""),
        panels: vec![Panel { y: Axis::log("scaled residual", ""), series: curves }],
    }
}

fn by_second(clock: &Clock) -> Lines {
    let curves = clock.runners.iter().map(|(solver, points)| {
        curve(solver, points.iter().map(|(s, residual)| (1e3 * s, residual.max(LEAST))).collect())
    });
    Lines {
        id: id(&clock.problem, "seconds"),
        title: format!("{}: residual by time", clock.problem),
        caption:
            "The same runs by the clock, stop tests included and the time for looking at iterates \
                  taken off. On a machine that does other things too."
                .into(),
        x: Axis::log("time", "ms"),
        panels: vec![Panel { y: Axis::log("scaled residual", ""), series: curves.collect() }],
    }
}

fn table(race: &Race) -> Table {
    let row = |runner: &Runner| {
        let end = runner.marks.last();
        let solved = runner.outcome.is_solved();
        vec![
            Cell::text(&runner.solver),
            outcome(&runner.outcome),
            end.map_or(Cell::text("–"), |end| Cell::count(end.iteration)),
            end.filter(|end| solved && end.work.is_finite())
                .map_or(Cell::text("–"), |end| Cell::number(end.work, 2)),
            end.map_or(Cell::text("–"), |end| Cell::number(end.residual, 2)),
        ]
    };
    Table {
        title: format!("{}: what it took to {}", race.problem, tolerance(race.tolerance)),
        how_to_read:
            "*judge*: what came of the claim, or why there was none. *multiplications*: only of \
                      those that solved it."
                .into(),
        columns: vec![
            Column::words("solver"),
            Column::words("judge"),
            Column::numbers("iterations", ""),
            Column::numbers("multiplications", ""),
            Column::numbers("scaled residual", ""),
        ],
        rows: race.runners.iter().map(row).collect(),
        ..Table::default()
    }
}
