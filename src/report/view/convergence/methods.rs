//! The residual of several methods by iteration and by multiplication.

use crate::number::{count, readable};
use crate::plot::{Axis, Bar, Bars, Figure, Lines, Panel, Series};
use crate::report::page::{Cell, Table};
use crate::report::study::convergence::methods::{self as measured, MethodProgress, Progress};
use crate::report::study::trial;
use crate::report::view::attempt::{
    anchor, iterations_in_words, listed, outcome as outcome_cell, rough, tolerance,
};
use crate::report::view::{Headline, Outcome, ReportPage};
use crate::solver::{Group, Pgs, Registry};

/// The value at which a residual of exactly 0 is drawn on a logarithmic axis.
const LEAST: f64 = 1e-17;
/// A logarithm of the measured factor per sweep that is this many times that of the spectral radius
/// is no deviation by chance.
const FASTER: f64 = 1.5;
/// Unsupported weight up to this is not drawn (%).
const SUPPORTED: f64 = 1e-5;

pub(super) fn show(problems: &[&Progress], document: &mut ReportPage) {
    document.text(
        "Iterations of different methods have different costs, so the residual is plotted against the number of \
         multiplications (the leading term of the operation count). Sweeps first remove the part of the error that changes sign from \
         contact to contact. Then each sweep multiplies the residual by the spectral radius of the iteration \
         matrix on the active set, the rows between their bounds.",
    );
    for progress in problems {
        document.figure(by_work(progress));
        document.table(&id(&progress.problem, "methods"), table(progress));
    }
}

pub(super) fn outcome(problems: &[&Progress]) -> Outcome {
    let methods = || problems.iter().flat_map(|progress| &progress.methods);
    let rejected = methods().filter(|method| method.outcome == trial::Outcome::Rejected).count();
    let solved = methods().filter(|method| method.outcome.is_solved()).count();
    let on: Vec<&str> = problems.iter().map(|progress| progress.problem.as_str()).collect();
    let on = listed(&on);
    let says = format!(
        "{solved} of {} solvers succeed on {on}, {rejected} false claims",
        methods().count()
    );
    Outcome { good: rejected == 0, says }
}

/// The cheapest solver, and the cost of each.
pub(super) fn headline(progress: &Progress) -> Headline {
    let solved = by_cost(progress);
    let [first, _, ..] = solved[..] else { return Headline::default() };
    let figure: Box<dyn Figure> = Box::new(costs(progress, &solved));
    Headline { figure: Some(figure), ..Headline::of(Some(answer(progress, first))) }
}

/// The methods that solve the problem, the cheapest first.
fn by_cost(progress: &Progress) -> Vec<&MethodProgress> {
    let solved = |method: &&MethodProgress| method.outcome.is_solved() && work(method).is_finite();
    let mut methods: Vec<&MethodProgress> = progress.methods.iter().filter(solved).collect();
    methods.sort_by(|a, b| work(a).total_cmp(&work(b)));
    methods
}

fn answer(progress: &Progress, first: &MethodProgress) -> String {
    let iterations = first.marks.last().map_or(0, |end| end.iteration);
    format!(
        "The problem is a stack of {}; {} needs the fewest multiplications: {}.",
        in_words(&progress.problem),
        first.solver,
        iterations_in_words(&first.solver, iterations)
    )
}

/// A stack in words: `4 boxes, the top one 100 times as heavy`.
fn in_words(problem: &str) -> String {
    match problem.split_once(", mass ratio ") {
        Some((boxes, ratio)) => format!("{boxes}, the top one {ratio} times as heavy"),
        None => plain(problem).into(),
    }
}

/// A problem without the number of its step.
fn plain(problem: &str) -> &str {
    problem.split_once(", step ").map_or(problem, |(scene, _)| scene)
}

/// The share of the weight that ten sweeps of PGS leave unsupported.
fn left(progress: &Progress) -> Option<String> {
    let share = pgs(progress)?.ten()?.unsupported?;
    Some(format!("{}\u{a0}%", readable(100.0 * share, 2)))
}

fn pgs(progress: &Progress) -> Option<&MethodProgress> {
    progress.methods.iter().find(|method| method.solver == Pgs::NAME)
}

/// The multiplications of the methods that solve the problem, the cheapest first.
fn costs(progress: &Progress, solved: &[&MethodProgress]) -> Bars {
    let bar = |method: &&MethodProgress| Bar {
        name: method.solver.clone(),
        accent: method.solver == solved[0].solver,
        value: work(method),
        amount: format!("{}×", rough(work(method) / work(solved[0]))),
        others: Vec::new(),
    };
    Bars {
        id: id(&progress.problem, "costs"),
        title: title(progress, solved),
        caption: format!(
            "{} ({} rows): multiplications needed to reach a scaled residual of {}; SOR uses ω = {}. Right: relative to the \
             cheapest.{}",
            progress.problem,
            count(progress.rows),
            tolerance(progress.tolerance),
            readable(progress.omega, 3),
            full_names(solved.iter().map(|method| method.solver.as_str()))
        ),
        x: Axis::log("multiplications", ""),
        bars: solved.iter().map(bar).collect(),
        limit: budget(progress).map(|value| {
            let left = left(progress).map(|share| format!(": {share} unsupported"));
            (value, format!("ten sweeps of pgs{}", left.unwrap_or_default()))
        }),
    }
}

/// The multiplications of a method up to its end.
fn work(method: &MethodProgress) -> f64 {
    method.marks.last().map_or(f64::NAN, |end| end.work)
}

fn id(problem: &str, what: &str) -> String {
    format!("convergence_{}_{what}", anchor(problem))
}

fn curve(solver: &str, points: Vec<(f64, f64)>) -> Series {
    let points = points.into_iter().filter(|(work, _)| work.is_finite()).collect();
    match Registry::standard().entry(solver).ok().map(|entry| entry.group) {
        Some(Group::Pivoting) => Series::points(solver, points),
        _ => Series::measured(solver, points),
    }
}

/// The curve of each method, with its name at the end; those with only a final mark are points.
fn curves(
    progress: &Progress,
    value: fn(&measured::Mark) -> Option<f64>,
    named: bool,
) -> Vec<Series> {
    let series = |method: &MethodProgress| {
        let points = method.marks.iter().filter_map(|mark| Some((mark.work, value(mark)?)));
        let label = if named { method.solver.as_str() } else { "" };
        curve(&method.solver, points.collect()).labeled(label)
    };
    let methods = progress.methods.iter().filter(|method| method.outcome.is_attempt());
    methods.map(series).filter(|series| !series.points.is_empty()).collect()
}

/// The predicted slope of a sweep method, through its last mark, over the second half of its
/// sweeps, if the active set does not change there and the method is not faster.
fn slope(method: &MethodProgress) -> Option<Series> {
    let (rate, end) = (method.rate?, method.marks.last()?);
    let half = method.marks.iter().position(|mark| 2 * mark.iteration >= end.iteration)?;
    if method.marks[half..].iter().any(|mark| mark.changed) || is_faster(method)? {
        return None;
    }
    let at = |mark: &measured::Mark| {
        let sweeps = end.iteration as f64 - mark.iteration as f64;
        (mark.work, end.residual * rate.powf(-sweeps))
    };
    let points = method.marks[half..].iter().map(at).collect();
    Some(Series::theory(format!("theory, {}", method.solver), points).labeled(""))
}

/// Where the active set of PGS changes.
fn changes(progress: &Progress) -> Series {
    let marks = pgs(progress).filter(|pgs| pgs.marks.len() > 1).map(|pgs| &pgs.marks);
    let marks = marks.into_iter().flatten().filter(|mark| mark.changed);
    let points = marks.map(|mark| (mark.work, mark.residual.max(LEAST))).collect();
    Series::points("active set of pgs changes", points)
}

/// A line at the tolerance.
fn asked(progress: &Progress) -> Series {
    let marks = progress.methods.iter().flat_map(|method| &method.marks).map(|mark| mark.work);
    let last = marks.fold(1.0, f64::max);
    let name = format!("tolerance {}", tolerance(progress.tolerance));
    // Its label is at its left end.
    let ends = vec![(10.0 * last, progress.tolerance), (1e-3, progress.tolerance)];
    Series::reference(name.clone(), ends).labeled(name)
}

fn by_work(progress: &Progress) -> Lines {
    let mut residuals = curves(progress, |mark| Some(mark.residual.max(LEAST)), true);
    residuals.extend(progress.methods.iter().filter_map(slope));
    let changes = changes(progress);
    residuals.extend((!changes.points.is_empty()).then_some(changes));
    residuals.push(asked(progress));
    residuals.extend(ten_sweeps(progress, "ten sweeps of pgs"));
    let mut panels = vec![Panel { y: Axis::log("scaled residual", ""), series: residuals }];
    let percent =
        |mark: &measured::Mark| Some(100.0 * mark.unsupported?).filter(|share| *share > SUPPORTED);
    let mut unsupported = curves(progress, percent, false);
    if !unsupported.is_empty() {
        unsupported.extend(ten_sweeps(progress, ""));
        panels.push(Panel { y: Axis::log("unsupported weight", "%"), series: unsupported });
    }
    Lines {
        id: id(&progress.problem, "work"),
        title: finding(progress),
        caption: format!(
            "{} rows; SOR uses ω = {}; a product with A takes {} multiplications. The cost of a method is where its \
             curve meets the tolerance; a pivoting method has one marker, at its end. Pale bands: the rate that the \
             spectral radius predicts, where a method does not converge faster.",
            count(progress.rows),
            readable(progress.omega, 3),
            count(progress.stored),
        ),
        x: Axis::log("multiplications", ""),
        panels,
    }
}

/// Whether the second half of a method's sweeps gains clearly more than the spectral radius says.
fn is_faster(method: &MethodProgress) -> Option<bool> {
    let end = method.marks.last()?;
    let middle = method.marks.iter().find(|mark| 2 * mark.iteration >= end.iteration)?;
    let sweeps = end.iteration as f64 - middle.iteration as f64;
    let measured = (end.residual / middle.residual).ln() / sweeps;
    Some(measured < FASTER * method.rate?.ln())
}

/// The finding: the cheapest and the most expensive of the methods with a curve.
fn finding(progress: &Progress) -> String {
    let mut iterative = by_cost(progress);
    iterative.retain(|method| method.marks.len() > 2);
    match iterative[..] {
        [first, .., last] => format!(
            "{} reaches {} within {} multiplications, {} needs {}",
            first.solver,
            tolerance(progress.tolerance),
            readable(work(first), 3),
            last.solver,
            readable(work(last), 3)
        ),
        _ => format!("{}: residual by multiplication", progress.problem),
    }
}

/// The finding: the cheapest and the most expensive solver.
fn title(progress: &Progress, solved: &[&MethodProgress]) -> String {
    match solved {
        [first, .., last] => format!(
            "{} needs {} multiplications, {} {} times as many",
            first.solver,
            readable(work(first), 3),
            last.solver,
            rough(work(last) / work(first))
        ),
        _ => format!("{}: costs", progress.problem),
    }
}

/// The cost of ten sweeps of PGS, a typical budget of an engine.
fn budget(progress: &Progress) -> Option<f64> {
    let end = pgs(progress)?.marks.last().filter(|end| end.iteration > 0)?;
    Some(10.0 * end.work / end.iteration as f64)
}

fn ten_sweeps(progress: &Progress, label: &str) -> Option<Series> {
    let budget = budget(progress)?;
    Some(Series::reference("ten sweeps", vec![(budget, LEAST), (budget, 1e3)]).labeled(label))
}

/// The names of the gradient methods in full, for a caption.
fn full_names<'a>(solvers: impl Iterator<Item = &'a str>) -> String {
    let in_full = |solver: &str| match solver {
        "mprgp" => Some("modified proportioning with reduced gradient projections"),
        "apgd" => Some("accelerated projected gradient descent"),
        "nncg" => Some("nonsmooth nonlinear conjugate gradients"),
        _ => None,
    };
    let names: Vec<String> =
        solvers.filter_map(|solver| Some(format!("*{solver}*: {}", in_full(solver)?))).collect();
    if names.is_empty() { String::new() } else { format!(" {}.", names.join("; ")) }
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
        "*verdict*: the judge's verdict on the answer, or the reason why there is no answer. \
             *multiplications*: only for methods that solved the problem.",
        "solver | verdict | #iterations | #multiplications | #scaled residual",
        progress.methods.iter().map(row).collect(),
    )
}
