//! The residual of several methods by iteration and by multiplication.

use crate::number::{count, readable};
use crate::plot::{Axis, Bar, Bars, Figure, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
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
/// Unsupported weight below this is enough for an engine.
const ENOUGH: f64 = 0.01;

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

/// The cheapest solver, the cost of each, and the cheapest ones of other problems.
pub(super) fn headline(progress: &Progress, choices: &[&Progress]) -> Headline {
    let solved = by_cost(progress);
    let [first, _, ..] = solved[..] else { return Headline::default() };
    let figure: Box<dyn Figure> = Box::new(costs(progress, &solved, default(choices)));
    let table = (!choices.is_empty()).then(|| ("choices".to_string(), choice(choices)));
    let answer = Some(answer(progress, first, choices));
    Headline { answer, figure: Some(figure), table, ..Headline::default() }
}

/// The methods that solve the problem, the cheapest first.
fn by_cost(progress: &Progress) -> Vec<&MethodProgress> {
    let solved = |method: &&MethodProgress| method.outcome.is_solved() && work(method).is_finite();
    let mut methods: Vec<&MethodProgress> = progress.methods.iter().filter(solved).collect();
    methods.sort_by(|a, b| work(a).total_cmp(&work(b)));
    methods
}

fn answer(progress: &Progress, first: &MethodProgress, choices: &[&Progress]) -> String {
    let Some([use_it, why_not]) = decision(choices) else {
        let stack = in_words(&progress.problem);
        let iterations = first.marks.last().map_or(0, |end| end.iteration);
        let part = budget(progress).map_or(String::new(), |ten| {
            let part = readable((100.0 * work(first) / ten).round(), 3);
            format!(", {part}\u{a0}% of the work of ten sweeps of *pgs*")
        });
        let iterations = iterations_in_words(&first.solver, iterations);
        let named = named(&first.solver);
        return format!(
            "The problem is a stack of {stack}; {named} is cheapest: {iterations}{part}."
        );
    };
    let left = left(progress).map_or(String::new(), |share| {
        format!(
            " On {} (Figure 1), ten sweeps of *pgs* (projected Gauss-Seidel), a typical budget in engines, leave {share} \
             of the weight unsupported in the first step: a sweep passes load only from contact to contact{}.",
            in_words(&progress.problem),
            supported(progress, first).unwrap_or_default()
        )
    });
    format!("{use_it}{left}{why_not}")
}

/// What PGS needs to support nearly the whole weight.
fn supported(progress: &Progress, first: &MethodProgress) -> Option<String> {
    let mut marks = pgs(progress)?.marks.iter();
    let mark = marks.find(|mark| mark.unsupported.is_some_and(|share| share < ENOUGH))?;
    Some(format!(
        "; less than {}\u{a0}% takes about {} sweeps, {} times the work of *{}*",
        readable(100.0 * ENOUGH, 1),
        rough(mark.iteration as f64),
        rough(mark.work / work(first)),
        first.solver
    ))
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

/// A solver at its first mention.
fn named(solver: &str) -> String {
    match solver {
        "lemke" => "Lemke's pivoting method".into(),
        "dantzig" => "Dantzig's pivoting method".into(),
        other => other.into(),
    }
}

/// The solver that solves every problem at the least multiple of the cheapest one's cost, and this
/// multiple.
fn default<'a>(choices: &[&'a Progress]) -> Option<(&'a str, f64)> {
    let solved: Vec<_> = choices.iter().map(|progress| by_cost(progress)).collect();
    let multiple = |solver: &str| {
        let ratios = solved.iter().map(|methods| {
            let own = methods.iter().find(|own| own.solver == solver)?;
            Some(work(own) / work(methods[0]))
        });
        ratios.collect::<Option<Vec<f64>>>().map(|all| all.into_iter().fold(1.0, f64::max))
    };
    let all = solved.first()?.iter().map(|own| own.solver.as_str());
    all.filter_map(|solver| Some((solver, multiple(solver)?))).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The default, and why it is not the cheapest solver of some of the problems.
fn decision(choices: &[&Progress]) -> Option<[String; 2]> {
    let (solver, most) = default(choices)?;
    let kind = |progress: &Progress| match progress.problem.contains(", mass ratio ") {
        true => "stacks".to_string(),
        false => plain(&progress.problem).into(),
    };
    let cost = |progress: &Progress, solver: &str| -> Option<f64> {
        let own = progress.methods.iter().find(|own| own.solver == solver)?;
        own.outcome.is_solved().then_some(10.0 * work(own) / budget(progress)?)
    };
    let cheapest = |progress: &&Progress| Some(by_cost(progress).first()?.solver.clone());
    let rival = choices.iter().filter_map(cheapest).find(|own| own != solver);
    let why_not = rival.and_then(|rival| {
        let is_best = |progress: &&&Progress| cheapest(progress).as_ref() == Some(&rival);
        let mut kinds: Vec<String> = choices.iter().filter(is_best).map(|own| kind(own)).collect();
        kinds.dedup();
        let costs = choices.iter().filter_map(|own| {
            Some((cost(own, &rival)?, cost(own, solver)?, kind(own)))
        });
        let (high, low, worst) = costs.max_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)))?;
        Some(format!(
            " *{rival}* is cheaper for the {}, but for the {worst} it costs as much as {} sweeps of *pgs*, *{solver}* {} \
             (pivoting is counted with dense matrices).",
            listed(&kinds),
            rough(high),
            rough(low)
        ))
    });
    let use_it = format!(
        "**Use *{solver}*: it solves all {} problems of Table 1, at no more than about {} times the cost of the \
         cheapest solver.**",
        choices.len(),
        rough(most)
    );
    Some([use_it, why_not.unwrap_or_default()])
}

/// The share of the weight that ten sweeps of PGS leave unsupported.
fn left(progress: &Progress) -> Option<String> {
    let share = pgs(progress)?.ten()?.unsupported?;
    Some(format!("{}\u{a0}%", readable(100.0 * share, 2)))
}

fn pgs(progress: &Progress) -> Option<&MethodProgress> {
    progress.methods.iter().find(|method| method.solver == Pgs::NAME)
}

/// The cost of PGS, of the cheapest method of each problem, and the weight that ten sweeps of PGS
/// leave unsupported.
fn choice(choices: &[&Progress]) -> Table {
    let mut shown: Vec<&str> = Vec::new();
    let cheapest =
        choices.iter().filter_map(|progress| Some(by_cost(progress).first()?.solver.as_str()));
    for solver in cheapest.chain([Pgs::NAME]) {
        shown.extend((!shown.contains(&solver)).then_some(solver));
    }
    let row = |progress: &&Progress| {
        let solved = by_cost(progress);
        let cost = |solver: &&str| {
            let method = solved.iter().find(|method| method.solver == *solver);
            let cost = method.zip(budget(progress)).map(|(method, ten)| 10.0 * work(method) / ten);
            let mark = if solved[0].solver == *solver { Mark::Good } else { Mark::Plain };
            cost.map_or(Cell::text("–"), |cost| Cell {
                value: Some(cost),
                ..Cell::text(rough(cost))
            })
            .marked(mark)
        };
        let mut cells = vec![
            Cell::text(plain(&progress.problem).replace(", mass ratio ", ", 1:")),
            Cell::count(progress.rows),
        ];
        cells.extend(shown.iter().map(cost));
        cells.push(left(progress).map_or(Cell::text("–"), Cell::text));
        cells
    };
    let mut columns = vec![Column::words("problem"), Column::numbers("rows", "").wide()];
    let advised = default(choices).map(|(solver, _)| solver);
    columns.extend(shown.iter().map(|solver| Column {
        wide: *solver != Pgs::NAME && Some(*solver) != advised,
        ..Column::numbers(*solver, "")
    }));
    columns.push(Column::numbers("unsupported", ""));
    Table {
        title: "Which solver for which problem".into(),
        how_to_read: "The cost of each solver in sweeps of *pgs*, of which engines typically take ten; pivoting methods are \
                      counted with dense matrices. ✓: the cheapest of all; –: not within the tolerance after the maximum \
                      number of iterations, or without a weight to support. *1:r*: the top box has r times the mass of each of the others. *unsupported*: the \
                      weight after ten sweeps."
            .into(),
        columns,
        rows: choices.iter().map(row).collect(),
        ..Table::default()
    }
}

/// The multiplications of the methods that solve the problem, the cheapest first.
fn costs(progress: &Progress, solved: &[&MethodProgress], default: Option<(&str, f64)>) -> Bars {
    let bar = |method: &&MethodProgress| Bar {
        name: method.solver.clone(),
        accent: default.is_none_or(|(own, _)| own == method.solver),
        value: work(method),
        amount: format!("{}×", rough(work(method) / work(solved[0]))),
        others: Vec::new(),
    };
    Bars {
        id: id(&progress.problem, "costs"),
        title: title(progress, solved, default.map_or("", |(solver, _)| solver)),
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

/// The finding: the cost of the default, the cheapest solver or both, and the most expensive one.
fn title(progress: &Progress, solved: &[&MethodProgress], default: &str) -> String {
    let Some(first) = solved.first() else { return format!("{}: costs", progress.problem) };
    let times = |own: &MethodProgress| format!("{} times", rough(work(own) / work(first)));
    let last = solved.last().filter(|own| own.solver != default && own.solver != first.solver);
    let last = last.map_or(String::new(), |own| format!(", {} {}", own.solver, times(own)));
    match solved[1..].iter().find(|own| own.solver == default) {
        Some(own) => {
            format!("{default} needs {} {}'s multiplications{last}", times(own), first.solver)
        }
        None => {
            let least = readable(work(first), 3);
            format!("{} needs {least} multiplications{last} as many", first.solver)
        }
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
