//! The contact problems that engines solve themselves: their own answers judged, and which solvers
//! solve them.

use super::phenomenon::NO_ROWS;
use crate::number::readable;
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::cards::{Frame, Record, SolverAttempt, SolverPart};
use crate::report::view::ReportPage;
use crate::report::view::attempt::iterations_in_words;

/// Adds a section, if there are such problems.
pub fn show(record: &Record, document: &mut ReportPage) {
    if record.frames.is_empty() {
        return;
    }
    document.open("frames", "Do engines solve their own contact problems?");
    document.text(
        "An engine can violate a law because of its contact problem or because of its solution of that \
         problem. This section takes the problem of one step from each engine with default settings. The judge \
         decides on the engine's own forces or impulses (*proved* means in exact arithmetic), and lcplab's \
         solvers solve the same problem. If a law is violated although the answer is proved, the cause is the \
         model: a compliant contact, a pyramid instead of a cone, or friction limited by an earlier force. If \
         an answer is rejected, the law may still be obeyed; the table shows the error of the answer. \
         Pinocchio has no contact model, so its solver is given lcplab's problem. Rapier does not report its \
         problem, and DART reports none for a sleeping scene.",
    );
    document.text(causes(record));
    document.table("cards_frames", table(record));
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
        "In {} runs an engine violates a law. lcplab took up to 25 steps of each run and checked \
         the engine's answer: a *receipt* is the verification report of one step. In {} of these \
         runs all checked answers are within the limit of their solver, so in these \
         steps the solver is not the cause; in {} some are not; {} have no constraint rows, so no solver is involved; {} cannot \
         be checked. The tables of the phenomena have the numbers.",
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
    let mark = if frame.verdict == "not_a_solution" { Mark::Bad } else { Mark::Good };
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
