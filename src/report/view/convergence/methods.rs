//! The residual of several methods by iteration and by multiplication.

use crate::number::{capitalized, count, readable};
use crate::plot::{Axis, Bar, Bars, Figure, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Table};
use crate::report::study::convergence::methods::{Mark, MethodProgress, Progress};
use crate::report::study::trial;
use crate::report::view::attempt::{
    anchor, iterations_in_words, outcome as outcome_cell, rough, tolerance,
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
        "Iterations of different methods have different costs: a Newton step solves a linear system, a sweep \
         is one product with A. The residual is therefore plotted against the number of multiplications (the \
         leading term of the operation count). Sweeps first remove the part of the error that changes sign from \
         contact to contact. Then each sweep multiplies the residual by the spectral radius of the iteration \
         matrix on the active set, the rows between their bounds. Silcowitz et al. (2010) and Mazhar et al. (2015) \
         plot the residual; where the problem has a weight, the figure also shows how much of it is still unsupported.",
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
    let says =
        format!("{solved} of {} solvers succeed, {rejected} false claims", methods().count());
    Outcome { good: rejected == 0, says }
}

/// The cheapest solver, the cost of each, and the cheapest ones of other problems.
pub(super) fn headline(progress: &Progress, choices: &[&Progress]) -> Headline {
    let solved = by_cost(progress);
    let [first, second, ..] = solved[..] else { return Headline::default() };
    let figure: Box<dyn Figure> = Box::new(costs(progress, &solved));
    let table = (!choices.is_empty()).then(|| ("choices".to_string(), choice(choices)));
    let mut answer = answer(progress, solved.len(), first, second);
    answer += &taller(choices).unwrap_or_default();
    let answer = Some(answer);
    Headline { answer, figure: Some(figure), table, ..Headline::default() }
}

/// The methods that solve the problem, the cheapest first.
fn by_cost(progress: &Progress) -> Vec<&MethodProgress> {
    let solved = |method: &&MethodProgress| method.outcome.is_solved() && work(method).is_finite();
    let mut methods: Vec<&MethodProgress> = progress.methods.iter().filter(solved).collect();
    methods.sort_by(|a, b| work(a).total_cmp(&work(b)));
    methods
}

fn answer(
    progress: &Progress,
    solved: usize,
    first: &MethodProgress,
    second: &MethodProgress,
) -> String {
    let tried = progress.methods.iter().filter(|method| method.outcome.is_attempt()).count();
    let iterations = first.marks.last().map_or(0, |end| end.iteration);
    let compared = budget(progress).map_or(String::new(), |ten| {
        let left = left(progress);
        format!(
            ", {} the work of ten projected Gauss-Seidel sweeps (*pgs*){}",
            part(work(first) / ten),
            left.map_or(String::new(), |share| format!(
                ", which leave {share} of the weight unsupported"
            ))
        )
    });
    let more = match work(second) / work(first) {
        ratio if ratio < 2.0 => format!("{} % more", readable((100.0 * (ratio - 1.0)).round(), 2)),
        ratio => format!("{} times as much", rough(ratio)),
    };
    let all = match solved == tried {
        true => format!("All {solved}"),
        false => format!("{solved} of {tried}"),
    };
    format!(
        "**For a stack of {}, {} is cheapest:** {}{compared}. {} costs {more}. {all} solvers reach a scaled \
         residual of {} and pass an independent check.",
        in_words(&progress.problem),
        named(&first.solver),
        iterations_in_words(&first.solver, iterations),
        capitalized(&named(&second.solver)),
        tolerance(progress.tolerance),
    )
}

/// A part as a percentage, or a multiple.
fn part(ratio: f64) -> String {
    match ratio {
        more if more > 1.0 => format!("{} times", readable(more, 2)),
        less => format!("{}\u{a0}% of", readable((100.0 * less).round(), 3)),
    }
}

/// A stack in words: `4 boxes, the top one 100 times as heavy`.
fn in_words(problem: &str) -> String {
    match problem.split_once(", mass ratio ") {
        Some((boxes, ratio)) => format!("{boxes}, the top one {ratio} times as heavy"),
        None => problem.into(),
    }
}

/// A solver at its first mention.
fn named(solver: &str) -> String {
    match solver {
        "lemke" => "Lemke's pivoting method (lemke)".into(),
        "dantzig" => "Dantzig's pivoting method (dantzig)".into(),
        other => other.into(),
    }
}

/// The cost of the cheapest solver of the largest stack.
fn taller(choices: &[&Progress]) -> Option<String> {
    let largest = choices.iter().max_by_key(|progress| progress.rows)?;
    let first = *by_cost(largest).first()?;
    Some(format!(
        " For {}, {} costs as much as {} sweeps of pgs; larger stacks are not measured here.",
        largest.problem,
        first.solver,
        readable(10.0 * work(first) / budget(largest)?, 2)
    ))
}

/// The share of the weight that ten sweeps of PGS leave unsupported.
fn left(progress: &Progress) -> Option<String> {
    let share = pgs(progress)?.ten()?.unsupported?;
    Some(format!("{}\u{a0}%", readable(100.0 * share, 2)))
}

fn pgs(progress: &Progress) -> Option<&MethodProgress> {
    progress.methods.iter().find(|method| method.solver == Pgs::NAME)
}

/// The cheapest method of each problem, its cost, and the weight that ten sweeps of PGS leave
/// unsupported.
fn choice(choices: &[&Progress]) -> Table {
    // The two cheapest of any stack.
    let mut cheap: Vec<&str> = Vec::new();
    for method in choices.iter().flat_map(|progress| by_cost(progress).into_iter().take(2)) {
        cheap.extend((!cheap.contains(&method.solver.as_str())).then_some(method.solver.as_str()));
    }
    let row = |progress: &&Progress| {
        let solved = by_cost(progress);
        let cost = |solver: &&str| {
            let method = solved.iter().find(|method| method.solver == *solver);
            let sweep = budget(progress).map(|ten| ten / 10.0);
            let cost = method.zip(sweep).map(|(method, sweep)| work(method) / sweep);
            cost.map_or(Cell::text("–"), |cost| Cell::number(cost, 2))
        };
        let failed: Vec<&str> = progress
            .methods
            .iter()
            .filter(|method| method.outcome.is_attempt() && !method.outcome.is_solved())
            .map(|method| method.solver.as_str())
            .collect();
        let sweeps =
            pgs(progress).filter(|pgs| pgs.outcome.is_solved()).and_then(|pgs| pgs.marks.last());
        let mut cells = vec![Cell::text(progress.problem.replace(" = ", "\u{a0}=\u{a0}"))];
        cells.extend(cheap.iter().map(cost));
        cells.extend([
            sweeps.map_or(Cell::text("–"), |end| Cell::count(end.iteration)),
            left(progress).map_or(Cell::text("–"), Cell::text),
            Cell::count(progress.rows),
            Cell::text(if failed.is_empty() { "none".into() } else { failed.join(", ") }),
        ]);
        cells
    };
    let mut columns = vec![Column::words("stack")];
    columns.extend(cheap.iter().map(|solver| Column::numbers(*solver, "sweeps")));
    columns.extend([
        Column::numbers(Pgs::NAME, "sweeps"),
        Column::numbers("unsupported", "after 10 sweeps"),
        Column::numbers("size", "rows"),
        Column::words("solvers that fail"),
    ]);
    Table {
        title: "Which solver for which stack".into(),
        how_to_read: "*mass ratio*: that of the top box to each of the others. The columns of solvers: the cost until \
                      the residual is within the tolerance, in sweeps of *pgs*, of which engines typically take ten. \
                      *unsupported*: the part of the total weight. *solvers that fail*: not within the tolerance \
                      after the maximum number of iterations. A stack is a hard case for sweeps and has redundant \
                      contacts."
            .into(),
        columns,
        rows: choices.iter().map(row).collect(),
        ..Table::default()
    }
}

/// The multiplications of the methods that solve the problem, the cheapest first.
fn costs(progress: &Progress, solved: &[&MethodProgress]) -> Bars {
    let bar = |(k, method): (usize, &&MethodProgress)| Bar {
        name: method.solver.clone(),
        accent: k == 0 || method.solver == Pgs::NAME,
        value: work(method),
        others: Vec::new(),
    };
    Bars {
        id: id(&progress.problem, "costs"),
        title: title(progress),
        caption: format!(
            "Multiplications needed to reach a scaled residual of {} (leading term of the operation count), for {} \
             rows, starting from x = 0. Ten sweeps of *pgs* per step are a typical budget in engines.{}",
            tolerance(progress.tolerance),
            count(progress.rows),
            full_names(solved.iter().map(|method| method.solver.as_str()))
        ),
        x: Axis::log("multiplications", ""),
        bars: solved.iter().enumerate().map(bar).collect(),
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
fn curves(progress: &Progress, value: fn(&Mark) -> Option<f64>, named: bool) -> Vec<Series> {
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
    let at = |mark: &Mark| {
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
    let ends = vec![(1e-3, progress.tolerance), (10.0 * last, progress.tolerance)];
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
    let percent = |mark: &Mark| Some(100.0 * mark.unsupported?).filter(|share| *share > SUPPORTED);
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
             curve meets the tolerance; a pivoting method has one marker, at its end. Pale bands: the spectral \
             radius, over the second half of the sweeps{}.{}",
            count(progress.rows),
            readable(progress.omega, 3),
            count(progress.stored),
            progress.methods.iter().filter_map(radius).collect::<String>(),
            faster_than_radius(progress)
        ),
        x: Axis::log("multiplications", ""),
        panels,
    }
}

/// The sweep methods that end faster than the spectral radius says: Jacobi's sweeps keep the
/// symmetry of a symmetric stack, so that their error has no part along an eigenvector without it.
fn faster_than_radius(progress: &Progress) -> String {
    let is_faster = |method: &&MethodProgress| is_faster(method) == Some(true);
    let faster = progress.methods.iter().filter(is_faster);
    let names: Vec<&str> = faster.map(|method| method.solver.as_str()).collect();
    match names.is_empty() {
        true => String::new(),
        false => format!(
            " Faster than its spectral radius: {}, whose error has no part along the eigenvector.",
            names.join(", ")
        ),
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

/// The predicted factor per sweep of a method.
fn radius(method: &MethodProgress) -> Option<String> {
    Some(format!("; {}: {:.5} per sweep", method.solver, method.rate?))
}

/// The cost of the cheapest solver, and what ten sweeps of PGS leave.
fn finding(progress: &Progress) -> String {
    let undone = match (left(progress), pgs(progress).and_then(MethodProgress::ten)) {
        (Some(share), _) => format!("{share} of the weight unsupported"),
        (None, Some(ten)) => format!("a residual of {}", readable(ten.residual, 2)),
        _ => return format!("{}: residual by multiplication", progress.problem),
    };
    match (by_cost(progress).first(), budget(progress)) {
        (Some(first), Some(ten)) => format!(
            "{} needs {} the work of ten sweeps, which leave {undone}",
            first.solver,
            part(work(first) / ten)
        ),
        _ => format!("{}: ten sweeps leave {undone}", progress.problem),
    }
}

/// The finding: the cheapest solver, and the cost of the most expensive one.
fn title(progress: &Progress) -> String {
    match by_cost(progress)[..] {
        [first, .., last] => format!(
            "{}: {} is cheapest, {} costs {} times as much",
            progress.problem,
            first.solver,
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
