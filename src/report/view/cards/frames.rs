//! The contact problems that engines solve themselves: their own answers judged, and which solvers
//! solve them.

use super::phenomenon::NO_ROWS;
use crate::number::readable;
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::cards::{Frame, Record, SolverAttempt, SolverPart};
use crate::report::view::ReportPage;
use crate::report::view::attempt::{iterations_in_words, listed};

/// Adds a section, if there are such problems.
pub fn show(record: &Record, document: &mut ReportPage) {
    if record.frames.is_empty() {
        return;
    }
    document.open("frames", "Do engines solve their own contact problems?");
    document.text(format!("**{}** {}", answers(record), causes(record)));
    document.fold_rest();
    document.text(
        "The problem of one step of each engine, with default settings: the judge decides on the engine's own \
         forces or impulses, and lcplab's solvers solve the same problem. If a law is violated although the \
         answer is proved, the cause is the model: a compliant contact, a pyramid instead of a cone, or \
         friction limited by an earlier force. Pinocchio has no contact model, so its solver is given lcplab's \
         problem. Rapier does not report its problem, and DART reports none for a sleeping scene.",
    );
    document.table("cards_frames", table(record));
}

/// The number of engines' answers that the judge accepts, and the engines with a rejected one.
fn answers(record: &Record) -> String {
    let mut rejected: Vec<(&str, usize)> = Vec::new();
    for frame in record.frames.iter().filter(|frame| is_rejected(frame)) {
        let engine = record.title(&frame.engine);
        match rejected.iter_mut().find(|(own, _)| *own == engine) {
            Some((_, count)) => *count += 1,
            None => rejected.push((engine, 1)),
        }
    }
    let all = record.frames.len();
    let accepted = all - rejected.iter().map(|(_, count)| count).sum::<usize>();
    let rejected = rejected.iter().map(|(engine, count)| format!("{count} of {engine}"));
    let rejected = rejected.collect::<Vec<_>>().join(" and ");
    match rejected.is_empty() {
        true => {
            format!("The judge accepts all {all} answers of the engines to their own problems.")
        }
        false => format!(
            "The judge accepts {accepted} of {all} answers of the engines to their own problems and rejects {rejected}.{}",
            own_solvers(record)
        ),
    }
}

/// How many of the problems with a rejected answer lcplab's solvers solve.
fn own_solvers(record: &Record) -> String {
    let hard: Vec<&Frame> = record.frames.iter().filter(|frame| is_rejected(frame)).collect();
    let mut solving: Vec<String> = Vec::new();
    let mut solved = 0;
    for frame in &hard {
        let accepted = frame.solvers.iter().filter(|tried| tried.accepted);
        let names: Vec<String> = accepted.map(|own| format!("*{}*", own.solver)).collect();
        solved += usize::from(!names.is_empty());
        solving.extend(names);
    }
    solving.sort();
    solving.dedup();
    let by = match solved {
        0 => String::new(),
        _ => format!(" (by {})", listed(&solving)),
    };
    format!(" Of these {} problems lcplab's solvers solve {solved}{by}.", hard.len())
}

fn is_rejected(frame: &Frame) -> bool {
    frame.verdict == "not_a_solution"
}

/// Of the laws that engines violate: how many are the solver's, according to receipts of the runs.
fn causes(record: &Record) -> String {
    let external = record.phenomena.iter().flat_map(|own| &own.columns);
    let missed: Vec<&SolverPart> =
        external.filter(|own| !own.holds()).filter_map(|own| own.solver.as_ref()).collect();
    let count = |of: &dyn Fn(&SolverPart) -> bool| missed.iter().filter(|part| of(part)).count();
    let is_free = |part: &SolverPart| match part {
        SolverPart::Unchecked { why } => why.starts_with(NO_ROWS),
        SolverPart::Checked { .. } => false,
    };
    format!(
        "In {} runs an engine violates a law; lcplab checked the answers of up to 25 steps of each (a *receipt* is the \
         verification report of one step). In {} of these runs all answers are within the limit of their solver, so the \
         solver is not the cause; in {} some are not; {} have no constraint rows; {} cannot be checked.",
        missed.len(),
        count(&|part| matches!(part, SolverPart::Checked { above: 0, .. })),
        count(&|part| matches!(part, SolverPart::Checked { above: 1.., .. })),
        count(&is_free),
        count(&|part| matches!(part, SolverPart::Unchecked { .. }) && !is_free(part)),
    )
}

fn table(record: &Record) -> Table {
    Table::new(
        "Engines' own answers",
        "*accepted*: the number of accepted answers and of solvers for such problems; for Coulomb \
         cones there is one solver. *cheapest*: the accepted solver with the fewest multiplications. The limit \
         is 10,000 iterations.",
        "engine | phenomenon | #at (s) | #rows | its own answer | #scaled residual | \
         worst row | lcplab's solvers accepted | cheapest | not within the limit",
        record.frames.iter().map(|frame| row(record, frame)).collect(),
    )
}

/// The row with the largest residual, with its name, and that residual.
fn missed(frame: &Frame) -> Option<String> {
    let label = frame.problem["rows"][frame.row?]["label"].as_str()?;
    Some(format!("{label}: {} mm/s", readable(1e3 * frame.missed?, 2)))
}

fn row(record: &Record, frame: &Frame) -> Vec<Cell> {
    let accepted: Vec<&SolverAttempt> =
        frame.solvers.iter().filter(|tried| tried.accepted).collect();
    let cost = |own: &&&SolverAttempt| own.multiplications.unwrap_or(f64::INFINITY);
    let cheapest = accepted.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
    let failed: Vec<&str> =
        frame.solvers.iter().filter(|own| !own.accepted).map(|own| own.solver.as_str()).collect();
    // The shorter of two lists: those that fail, or those that do not.
    let others = || accepted.iter().map(|own| own.solver.as_str()).collect::<Vec<_>>().join(", ");
    let failed = match (failed.len(), accepted.len()) {
        (0, _) => "–".into(),
        (_, 0) => "all".into(),
        (failing, solving) if failing > solving => format!("all but {}", others()),
        _ => failed.join(", "),
    };
    let mark = if is_rejected(frame) { Mark::Bad } else { Mark::Good };
    vec![
        Cell::text(record.title(&frame.engine)),
        Cell::text(frame.phenomenon.replace('_', " ")),
        Cell::number(frame.time, 2),
        Cell::count(frame.rows),
        Cell::text(frame.verdict.replace('_', " ")).marked(mark),
        Cell::number(frame.residual, 2),
        Cell::text(missed(frame).unwrap_or_else(|| "–".into())),
        Cell::text(format!("{} of {}", accepted.len(), frame.solvers.len())),
        Cell::text(cheapest.map_or_else(
            || "–".into(),
            |own| format!("{}, {}", own.solver, iterations_in_words(&own.solver, own.iterations)),
        )),
        Cell::text(failed),
    ]
}
