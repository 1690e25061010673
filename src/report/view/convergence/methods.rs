//! The residual of several methods by iteration, by multiplication and by second.

use crate::number::{count, readable};
use crate::plot::{Axis, Bar, Bars, Figure, Lines, Series};
use crate::report::page::{Cell, Table};
use crate::report::study::attempt;
use crate::report::study::convergence::methods::{Clock, MethodProgress, Progress};
use crate::report::view::attempt::{
    anchor, iterations_in_words, outcome as outcome_cell, rough, tolerance,
};
use crate::report::view::{Document, Headline, Outcome};
use crate::solver::Group;

/// The value at which a residual of exactly 0 is drawn on a logarithmic axis.
const LEAST: f64 = 1e-17;

pub(super) fn show(problems: &[&Progress], document: &mut Document) {
    document.text(
        "Iterations of different methods have different costs: a Newton step solves a linear system, a sweep \
         is one product with A. The residual is therefore plotted against the number of multiplications (the \
         leading term of each method). The section *Computing times on this machine* has the times.",
    );
    for progress in problems {
        document.figure(by_work(progress));
        document.table(&id(&progress.problem, "methods"), table(progress));
    }
}

pub(super) fn outcome(problems: &[&Progress]) -> Outcome {
    let methods = || problems.iter().flat_map(|progress| &progress.methods);
    let refuted = methods().filter(|method| method.outcome == attempt::Outcome::Refuted).count();
    let solved = methods().filter(|method| method.outcome.is_solved()).count();
    let says = format!("{solved} of {} solvers succeed, {refuted} false claims", methods().count());
    Outcome { good: refuted == 0, says }
}

/// The cheapest solver, and the cost of each as a bar.
pub(super) fn headline(progress: &Progress) -> Headline {
    let mut solved: Vec<&MethodProgress> = progress
        .methods
        .iter()
        .filter(|method| method.outcome.is_solved() && work(method).is_finite())
        .collect();
    solved.sort_by(|a, b| work(a).total_cmp(&work(b)));
    let [first, .., last] = solved[..] else { return Headline::default() };
    let figure: Box<dyn Figure> = Box::new(costs(progress, &solved));
    Headline {
        answer: Some(answer(progress, solved.len(), first, last)),
        figure: Some(figure),
        result: None,
    }
}

fn answer(
    progress: &Progress,
    solved: usize,
    first: &MethodProgress,
    last: &MethodProgress,
) -> String {
    let tried = progress.methods.iter().filter(|method| method.outcome.is_attempt()).count();
    let needs = |method: &MethodProgress| {
        let iterations = method.marks.last().map_or(0, |end| end.iteration);
        iterations_in_words(&method.solver, iterations)
    };
    let beside = match budget(progress) {
        Some(most) if work(first) < most => ", less work than ten sweeps of *pgs*",
        _ => "",
    };
    format!(
        "**Which solver for {}?** *{}* is the cheapest: it needs {}{beside}. The most expensive, \
         *{}*, needs {}, {} times the work. {solved} of {tried} solvers reach a residual of {}, and the judge \
         accepts their answers.",
        progress.problem,
        first.solver,
        needs(first),
        last.solver,
        needs(last),
        rough(work(last) / work(first)),
        tolerance(progress.tolerance)
    )
}

/// The multiplications of the methods that solve the problem, the cheapest first.
fn costs(progress: &Progress, solved: &[&MethodProgress]) -> Bars {
    let bar = |method: &&MethodProgress| Bar { name: method.solver.clone(), value: work(method) };
    Bars {
        id: id(&progress.problem, "costs"),
        title: title(progress),
        caption: format!(
            "Multiplications until the scaled residual is {}: the leading term of each method, for {} rows and \
             a start from x = 0. Ten sweeps of *pgs* per step are a typical budget in engines.",
            tolerance(progress.tolerance),
            count(progress.rows)
        ),
        x: Axis::log("multiplications", ""),
        bars: solved.iter().map(bar).collect(),
        limit: budget(progress).map(|value| (value, "ten sweeps of pgs".into())),
    }
}

/// The multiplications of a method up to its end.
fn work(method: &MethodProgress) -> f64 {
    method.marks.last().map_or(f64::NAN, |end| end.work)
}

fn id(problem: &str, what: &str) -> String {
    format!("convergence_{}_{what}", anchor(problem))
}

/// The methods as curves, those with only a final mark as points; separated into solved and not.
fn series(progress: &Progress) -> Vec<Series> {
    let took_part = |method: &&MethodProgress| method.outcome.is_attempt();
    let points = |method: &MethodProgress| -> Vec<(f64, f64)> {
        let points = method.marks.iter().map(|mark| (mark.work, mark.residual.max(LEAST)));
        points.filter(|(work, _)| work.is_finite()).collect()
    };
    let series = |method: &MethodProgress| curve(&method.solver, points(method));
    let series = progress.methods.iter().filter(took_part).map(series);
    series.filter(|series| !series.points.is_empty()).collect()
}

fn curve(solver: &str, points: Vec<(f64, f64)>) -> Series {
    match Group::of(solver) {
        Some(Group::Pivoting) => Series::points(solver, points),
        _ => Series::measured(solver, points),
    }
}

/// A line at the tolerance.
fn asked(progress: &Progress) -> Series {
    let marks = progress.methods.iter().flat_map(|method| &method.marks).map(|mark| mark.work);
    let last = marks.fold(1.0, f64::max);
    let name = format!("tolerance: {}", tolerance(progress.tolerance));
    Series::reference(name, vec![(1e-3, progress.tolerance), (10.0 * last, progress.tolerance)])
}

fn by_work(progress: &Progress) -> Lines {
    let mut curves = series(progress);
    curves.push(asked(progress));
    curves.extend(ten_sweeps(progress));
    Lines::new(
        id(&progress.problem, "work"),
        title(progress),
        format!(
            "{} rows; SOR uses ω = {}. A product with A takes {} multiplications, one for each stored entry. \
             The cost of a method is where its curve crosses the tolerance; a pivoting method has one \
             marker, at its end. Second-order methods converge within a few steps once they are near the \
             solution. Sweeps remove the oscillating part of the error quickly and then slow down: the \
             remaining error is smooth, and a row is coupled only to its neighbors.",
            count(progress.rows),
            readable(progress.omega, 3),
            count(progress.stored)
        ),
        Axis::log("multiplications", ""),
        Axis::log("scaled residual", ""),
        curves,
    )
}

/// The finding: the cheapest solver, and the cost of the most expensive one.
fn title(progress: &Progress) -> String {
    let cost = |method: &MethodProgress| Some((method.marks.last()?.work, method.solver.clone()));
    let solved = progress.methods.iter().filter(|method| method.outcome.is_solved());
    let mut costs: Vec<(f64, String)> =
        solved.filter_map(cost).filter(|(work, _)| work.is_finite()).collect();
    costs.sort_by(|a, b| a.0.total_cmp(&b.0));
    match &costs[..] {
        [(least, cheapest), .., (most, dearest)] => format!(
            "{}: {cheapest} is cheapest, {dearest} costs {} times as much",
            progress.problem,
            rough(most / least)
        ),
        _ => format!("{}: residual by multiplication", progress.problem),
    }
}

/// The cost of ten sweeps of PGS, a typical budget of an engine.
fn budget(progress: &Progress) -> Option<f64> {
    let pgs = progress.methods.iter().find(|method| method.solver == "pgs")?;
    let end = pgs.marks.last().filter(|end| end.iteration > 0)?;
    Some(10.0 * end.work / end.iteration as f64)
}

fn ten_sweeps(progress: &Progress) -> Option<Series> {
    let budget = budget(progress)?;
    Some(Series::reference("ten sweeps of pgs", vec![(budget, LEAST), (budget, 1e3)]))
}

pub(super) fn by_second(clock: &Clock) -> Lines {
    let curves = clock.methods.iter().map(|(solver, points)| {
        curve(solver, points.iter().map(|(s, residual)| (1e3 * s, residual.max(LEAST))).collect())
    });
    Lines::new(
        format!("timings_{}", anchor(&clock.problem)),
        format!("{}: residual by time", clock.problem),
        "The runs of the section *Convergence of the residual*, plotted against wall time. It includes the \
         stopping tests, but not the recording of iterates; other processes may have run at the same time.",
        Axis::log("time", "ms"),
        Axis::log("scaled residual", ""),
        curves.collect(),
    )
}

fn table(progress: &Progress) -> Table {
    let row = |method: &MethodProgress| {
        let end = method.marks.last();
        let solved = method.outcome.is_solved();
        vec![
            Cell::text(&method.solver),
            outcome_cell(&method.outcome),
            end.map_or(Cell::text("–"), |end| Cell::count(end.iteration)),
            end.filter(|end| solved && end.work.is_finite())
                .map_or(Cell::text("–"), |end| Cell::number(end.work, 2)),
            end.map_or(Cell::text("–"), |end| Cell::number(end.residual, 2)),
        ]
    };
    Table::new(
        format!("{}: cost of a residual of {}", progress.problem, tolerance(progress.tolerance)),
        "*judge*: the verdict on the answer, or the reason why there is none. *multiplications*: only for \
             methods that solved the problem.",
        "solver | judge | #iterations | #multiplications | #scaled residual",
        progress.methods.iter().map(row).collect(),
    )
}
