//! Recorded times: the recommended solver, the times by size, and a table by problem.

use std::collections::BTreeSet;

use super::attempt::{listed, rough, tolerance};
use super::{Headline, Outcome, ReportPage, View};
use crate::number::{count, readable};
use crate::plot::{Axis, Lines, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::posed::{FRICTION, Loaded, OfFamily, Source};
use crate::report::study::solver_times::{Frames, NOISE, Plan, Recommended, Record, TimedProblem};
use crate::solver::Pgs;

/// Milliseconds in a second.
const MS: f64 = 1e3;

impl View for Plan {
    const TITLE: &'static str = "Time of each solver by problem";

    fn show(&self, findings: &[Record], document: &mut ReportPage) {
        for record in findings {
            document.text(format!(
                "Recorded on {}, on one thread of {}: the best of several solves in turn, from $x = 0$ to a scaled residual of {}, \
                 for answers that the judge accepts. Each solver uses dense or sparse factors as it does by default; SOR uses ω = {}.",
                record.date,
                record.processor,
                tolerance(record.tolerance),
                readable(record.omega, 3)
            ));
            document.table("solver_times", all_times(record));
            document.table("solved_frames", solved_frames(&record.frames));
        }
    }

    fn headline(&self, findings: &[Record]) -> Headline {
        let Some(record) = findings.first() else { return Headline::default() };
        let Some(recommended) = record.recommended() else { return Headline::default() };
        Headline {
            figure: Some(Box::new(by_size(record, recommended.solver))),
            table: Some(("which_solver".into(), which(record, recommended.solver))),
            ..Headline::of(Some(answer(record, &recommended)))
        }
    }

    fn outcome(&self, findings: &[Record]) -> Outcome {
        let solved = findings.iter().filter_map(Record::recommended);
        let says = solved.map(|own| {
            format!(
                "{} solves all problems, in at most {} times the least time",
                own.solver,
                readable(own.worst.factor, 2)
            )
        });
        let says: Vec<String> = says.collect();
        Outcome { good: !says.is_empty() && says.len() == findings.len(), says: listed(&says) }
    }
}

/// Which solver, at which size, and what the usual sweeps leave.
fn answer(record: &Record, recommended: &Recommended<'_>) -> String {
    let Recommended { solver, worst } = recommended;
    let stacks = || record.problems.iter().filter(|own| stack(own).is_some());
    let budget = stacks().filter_map(|own| Some(own.seconds(solver)? / own.ten_sweeps.seconds));
    let left = |ratio: f64| {
        let of_ratio = stacks().filter(move |own| stack(own).is_some_and(|own| own.ratio == ratio));
        range(of_ratio.filter_map(|own| Some(100.0 * own.ten_sweeps.unsupported?)))
    };
    let heavy = heaviest(record);
    format!(
        "**Use *{solver}*: of the {} solvers that solve all {} measured problems it stays closest to the fastest: it takes at most {} \
         times as long** ({}: *{}*).{}{} On a stack *{solver}* takes {} times as long as ten sweeps of *pgs* (projected Gauss-Seidel), a typical \
         budget of engines, which leave {}\u{a0}% of the weight unsupported in the first step, or {}\u{a0}% with a top \
         box {} times as heavy: a sweep passes load from one contact to the next, and the less of it the heavier the upper body is.",
        record.that_solve_all().count(),
        record.problems.len(),
        readable(worst.factor, 2),
        named(&worst.problem.problem),
        worst.rival,
        by_rows(record, solver).unwrap_or_default(),
        engines(&record.frames, solver),
        range(budget),
        left(1.0),
        left(heavy),
        readable(heavy, 3)
    )
}

/// From which size on it is the fastest on all stacks, and what is faster on smaller ones.
fn by_rows(record: &Record, solver: &str) -> Option<String> {
    let stacks = || record.problems.iter().filter(|own| stack(own).is_some());
    let faster: Vec<(&TimedProblem, &str, f64)> = stacks()
        .filter_map(|own| {
            let (rival, seconds) = own.fastest_or(solver)?;
            (rival != solver).then_some((own, rival, own.seconds(solver)? / seconds))
        })
        .collect();
    let most = faster.iter().map(|own| own.0.rows).max()?;
    let from = stacks().map(|own| own.rows).filter(|rows| *rows > most).min()?;
    let names: BTreeSet<&str> = faster.iter().map(|own| own.1).collect();
    let names: Vec<String> = names.iter().map(|name| format!("*{name}*")).collect();
    let factor = faster.iter().map(|own| own.2).fold(1.0, f64::max);
    Some(format!(
        " On stacks it is the fastest from {} rows on; on smaller ones {} can be up to {} times faster.",
        count(from),
        listed(&names).replace(" and ", " or "),
        readable(factor, 2)
    ))
}

/// What it solves of the recorded frames, and which solvers solve most.
fn engines(frames: &Frames, solver: &str) -> String {
    let with = |number: usize| -> Vec<String> {
        let those = frames.solved.iter().filter(|own| own.1 == number);
        those.map(|own| format!("*{}*", own.0)).collect()
    };
    let own = frames.solved_by(solver).unwrap_or(0);
    let most = frames.solved.iter().map(|own| own.1).max().unwrap_or(0);
    let others =
        if own < most { format!(", {} {most}", listed(&with(most))) } else { String::new() };
    format!(
        " Of {} frames recorded from engines, whose contacts also slide, {} solve {own}{others}.",
        frames.all,
        listed(&with(own))
    )
}

/// The times of all solvers on equal boxes with friction, by size.
fn by_size(record: &Record, recommended: &str) -> Lines {
    let stacks: Vec<_> = stacks_with(record, FRICTION, 1.0).collect();
    let at = |own: &TimedProblem, seconds: f64| (own.rows as f64, MS * seconds);
    let curve = |solver: &String| {
        let points = stacks.iter().filter_map(|own| Some(at(own, own.seconds(solver)?)));
        Series::measured(solver, points.collect()).labeled(solver)
    };
    let solvers = record.problems.first().map_or(&[][..], |own| &own.solvers);
    let names: Vec<String> = solvers.iter().map(|own| own.solver.clone()).collect();
    let mut series: Vec<Series> =
        names.iter().map(curve).filter(|own| !own.points.is_empty()).collect();
    let ten = stacks.iter().map(|own| at(own, own.ten_sweeps.seconds)).collect();
    series.push(Series::reference("ten sweeps of pgs", ten).labeled("ten sweeps of pgs"));
    Lines::new(
        "solver_times_by_size",
        title(&stacks, recommended),
        format!(
            "Equal boxes with friction, {} to a stack: time of a solve to a scaled residual of {}; A is stored as dense up to {} rows. A curve ends where the solver needs more than \
             {} iterations. Ten sweeps of *pgs* leave {}\u{a0}% of the weight unsupported.",
            range(stacks.iter().filter_map(|own| Some(stack(own)?.boxes as f64))),
            tolerance(record.tolerance),
            count(
                stacks.iter().filter(|own| own.is_dense()).map(|own| own.rows).max().unwrap_or(0)
            ),
            count(record.max_iterations),
            range(stacks.iter().filter_map(|own| Some(100.0 * own.ten_sweeps.unsupported?)))
        ),
        Axis::log("rows", ""),
        Axis::log("time", "ms"),
        series,
    )
}

/// The finding: from which size the recommended solver is the fastest, and how much slower PGS is.
fn title(stacks: &[&TimedProblem], recommended: &str) -> String {
    let is_fastest =
        |own: &&TimedProblem| own.fastest_or(recommended).is_some_and(|own| own.0 == recommended);
    let others = stacks.iter().rposition(|own| !is_fastest(own)).map_or(0, |last| last + 1);
    let fastest = stacks.get(others).map_or(String::new(), |own| {
        format!("from {} rows {recommended} is the fastest", count(own.rows))
    });
    let slower = stacks
        .iter()
        .rev()
        .find_map(|own| Some((own.rows, own.seconds(Pgs::NAME)? / own.seconds(recommended)?)));
    let slower = slower.map_or(String::new(), |(rows, times)| {
        format!("; with {} rows pgs takes {} times its time", count(rows), rough(times))
    });
    format!("Stacks with friction: {fastest}{slower}")
}

/// Time and risk by size, mass ratio and friction.
fn which(record: &Record, recommended: &str) -> Table {
    let row = |own: &&TimedProblem| {
        let rival = own.fastest_or(recommended).filter(|(solver, _)| *solver != recommended);
        let mark = if rival.is_none() { Mark::Good } else { Mark::Plain };
        let faster = rival.map(|(solver, seconds)| format!("{solver} {}", rough(MS * seconds)));
        vec![
            Cell::text(named(&own.problem)),
            Cell::count(own.rows),
            time(own.seconds(recommended)).marked(mark),
            Cell::text(faster.unwrap_or("–".into())),
            time(own.seconds(Pgs::NAME)),
            own.ten_sweeps.unsupported.map_or(Cell::text("–"), |part| {
                Cell::text(format!("{}\u{a0}%", readable(100.0 * part, 2)))
            }),
        ]
    };
    Table {
        title: format!("{recommended} by problem, and what is faster"),
        how_to_read: format!(
            "*time*: of a solve with *{recommended}* (ms). *faster*: the fastest solver and its time, if it is more than {}\u{a0}% faster. *1:r*: the top box has \
             r times the mass of each of the others; *μ*: with friction. *pgs*: –, if {} sweeps are not enough. *unsupported*: the weight \
             that ten sweeps of *pgs* leave unsupported in the first step.",
            100.0 * NOISE,
            count(record.max_iterations)
        ),
        columns: vec![
            Column::words("problem"),
            Column::numbers("rows", "").wide(),
            Column::numbers("time", ""),
            Column::numbers("faster", ""),
            Column::numbers(Pgs::NAME, "").wide(),
            Column::numbers("unsupported", "").wide(),
        ],
        rows: shown(record).iter().map(row).collect(),
        ..Table::default()
    }
}

/// Of stacks every second size, without friction only equal boxes; and all other problems.
fn shown(record: &Record) -> Vec<&TimedProblem> {
    let mut sizes: Vec<usize> =
        record.problems.iter().filter_map(|own| Some(stack(own)?.boxes)).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let is_shown = |own: &&TimedProblem| {
        stack(own).is_none_or(|own| {
            (own.friction > 0.0 || own.ratio == 1.0)
                && sizes.iter().step_by(2).any(|size| *size == own.boxes)
        })
    };
    record.problems.iter().filter(is_shown).collect()
}

/// The times of all solvers on all problems.
fn all_times(record: &Record) -> Table {
    let solvers = record.problems.first().map_or(&[][..], |own| &own.solvers);
    let columns = solvers.iter().map(|own| Column::numbers(&*own.solver, "ms"));
    let row = |own: &TimedProblem| {
        let times = own.solvers.iter().map(|own| own.seconds).chain([Some(own.ten_sweeps.seconds)]);
        let first = [Cell::text(named(&own.problem)), Cell::count(own.rows)];
        first.into_iter().chain(times.map(time)).collect()
    };
    let first = [Column::words("problem"), Column::numbers("rows", "")];
    let columns = columns.chain([Column::numbers("ten sweeps", "ms")]);
    Table {
        title: "Time of each solver".into(),
        how_to_read: format!(
            "In ms; –: no accepted answer within {} iterations. *ten sweeps*: of pgs.",
            count(record.max_iterations)
        ),
        columns: first.into_iter().chain(columns).collect(),
        rows: record.problems.iter().map(row).collect(),
        ..Table::default()
    }
}

/// The number of recorded frames that each solver solves.
fn solved_frames(frames: &Frames) -> Table {
    Table {
        title: format!("Solved of {} recorded frames", frames.all),
        how_to_read: format!(
            "Steps recorded from engines (`reports/frames.toml`), under coupled boxes; at most {} iterations.",
            count(frames.max_iterations)
        ),
        columns: frames.solved.iter().map(|own| Column::numbers(&*own.0, "")).collect(),
        rows: vec![frames.solved.iter().map(|own| Cell::count(own.1)).collect()],
        ..Table::default()
    }
}

fn time(seconds: Option<f64>) -> Cell {
    seconds.map_or(Cell::text("–"), |seconds| Cell {
        value: Some(MS * seconds),
        ..Cell::text(rough(MS * seconds))
    })
}

/// `20 boxes, 1:100, μ`.
fn named(problem: &Source) -> String {
    match problem {
        Source::Stack(Loaded { boxes, ratio, friction }) => {
            let friction = if *friction > 0.0 { ", μ" } else { "" };
            format!("{boxes} boxes, 1:{ratio}{friction}")
        }
        Source::Family(OfFamily { family, values }) if family == "contact-graph" => {
            let contacts = values.get("contacts").copied().unwrap_or_default();
            format!("pile, {} contacts", count(contacts as usize))
        }
        Source::Scene(at) => at.scene.clone(),
        other => other.name(),
    }
}

fn stack(own: &TimedProblem) -> Option<&Loaded> {
    match &own.problem {
        Source::Stack(stack) => Some(stack),
        _ => None,
    }
}

/// The stacks with this friction and mass ratio, the smallest first.
fn stacks_with(record: &Record, friction: f64, ratio: f64) -> impl Iterator<Item = &TimedProblem> {
    record.problems.iter().filter(move |own| {
        stack(own).is_some_and(|own| own.friction == friction && own.ratio == ratio)
    })
}

/// The largest mass ratio.
fn heaviest(record: &Record) -> f64 {
    record.problems.iter().filter_map(|own| Some(stack(own)?.ratio)).fold(1.0, f64::max)
}

/// `5 to 100`; one number if both have the same two digits.
fn range(values: impl Iterator<Item = f64>) -> String {
    let [least, most] = values
        .fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], own| [least.min(own), most.max(own)]);
    let (least, most) = (readable(least, 2), readable(most, 2));
    if least == most { least } else { format!("{least} to {most}") }
}
