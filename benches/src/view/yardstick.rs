//! Solvers beside clarabel: what the judge says, and the clock on what is right.

use crate::study::contest::Answer;
use crate::study::yardstick::{Finding, Times, YARDSTICK};
use lcplab::report::page::{Cell, Column, Mark, Table};
use lcplab::report::study::attempt::Outcome;
use lcplab::report::view::Outcome as Verdict;
use lcplab::report::view::attempt::tolerance;

/// Whether no claim was refuted, and how many answers were accepted.
pub(crate) fn outcome(to: &str, findings: &[Finding]) -> Verdict {
    let ours = || findings.iter().flat_map(|f| &f.answers).filter(|a| a.solver != YARDSTICK);
    let solved = ours().filter(|answer| answer.outcome.is_solved()).count();
    let refuted = ours().filter(|answer| answer.outcome == Outcome::Refuted).count();
    let says = format!(
        "{solved} of {} answers to {to} accepted, {refuted} claims refuted",
        ours().count()
    );
    Verdict { good: refuted == 0, says }
}

/// What the judge says of each answer.
pub(crate) fn claims(title: &str, findings: &[Finding]) -> Table {
    let names = findings.first().map_or(&[][..], |finding| &finding.answers[..]);
    let columns = [Column::words("problem"), Column::numbers("rows", "")]
        .into_iter()
        .chain(names.iter().map(|answer| Column::words(&answer.solver)))
        .chain([Column::numbers("clarabel was asked for", "")]);
    let row = |finding: &Finding| {
        [Cell::text(&finding.problem), Cell::count(finding.rows)]
            .into_iter()
            .chain(finding.answers.iter().map(verdict))
            .chain([finding.asked.map_or(Cell::text("–"), |asked| Cell::number(asked, 1))])
            .collect()
    };
    Table {
        title: title.into(),
        how_to_read: "The judge's word and the scaled residual. *proved*: an exact solution with this active \
                      set exists (up to 150 rows are tried)."
            .into(),
        columns: columns.collect(),
        rows: findings.iter().map(row).collect(),
        ..Table::default()
    }
}

fn verdict(answer: &Answer) -> Cell {
    let mark = match &answer.outcome {
        outcome if outcome.is_solved() => Mark::Good,
        Outcome::Refuted => Mark::Bad,
        _ => Mark::Note,
    };
    let text = format!("{}, {}", answer.outcome.words(), tolerance(answer.residual));
    Cell::text(text).marked(mark)
}

/// What each answer cost.
pub(crate) fn seconds(title: &str, times: &[Times]) -> Table {
    let row = |times: &Times| {
        let yardstick = times.yardstick();
        let problem = times.problem.clone();
        let timed = times.solvers.iter().map(move |(solver, time)| {
            let by = |ratio: Option<f64>| ratio.map_or(Cell::text("–"), |r| Cell::number(r, 2));
            vec![
                Cell::text(&problem),
                Cell::text(solver),
                Cell::number(1e3 * time.median, 3),
                Cell::number(1e3 * time.best, 3),
                by(yardstick.map(|clarabel| time.median / clarabel.median)),
                by(yardstick.map(|clarabel| time.best / clarabel.best)),
            ]
        });
        timed.collect::<Vec<_>>()
    };
    Table {
        title: title.into(),
        how_to_read: "Setup included, for clarabel the writing of its program too. Only answers that the judge \
                      accepts are here; a run of more than a tenth of a second was timed once."
            .into(),
        columns: vec![
            Column::words("problem"),
            Column::words("solver"),
            Column::numbers("median", "ms"),
            Column::numbers("best", "ms"),
            Column::numbers("of clarabel's, by medians", ""),
            Column::numbers("by bests", ""),
        ],
        rows: times.iter().flat_map(row).collect(),
        ..Table::default()
    }
}
