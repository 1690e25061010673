//! Replayed defects as a table with one row per defect.

use super::{Headline, Outcome, ReportPage, View};
use crate::number::count;
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::defects::{Defect, Plan, Record, Replay};

impl View for Plan {
    const TITLE: &'static str = "Known defects of physics engines, replayed";

    fn show(&self, findings: &[Record], document: &mut ReportPage) {
        for Record { defects, .. } in findings {
            document.table("defects", table(defects));
            document.table("receipts", receipts(defects));
        }
    }

    fn headline(&self, findings: &[Record]) -> Headline {
        Headline::of(
            findings
                .first()
                .map(|record| format!("**Receipts detect known defects**: {}.", says(record))),
        )
    }

    fn outcome(&self, findings: &[Record]) -> Outcome {
        let mut all = findings.iter().flat_map(|record| &record.defects);
        let is_good = |defect: &Defect| defect.mended.refused == 0 && !defect.is_misjudged();
        let good = !findings.is_empty() && all.all(is_good);
        Outcome { good, says: findings.iter().map(says).collect::<Vec<_>>().join("; ") }
    }
}

fn says(record: &Record) -> String {
    let all = &record.defects;
    let of = |has: fn(&Defect) -> bool| all.iter().filter(|defect| has(defect)).count();
    let rejected = of(|defect| defect.outcome == "detected");
    let compared = of(Defect::is_detected) - rejected;
    let good = of(|defect| defect.mended.refused == 0 && defect.mended.unavailable.is_none());
    format!(
        "{rejected} of {n} defective releases rejected at the right stage, {compared} more only in \
         comparison with a run of the corrected release; {good} of {n} corrected releases accepted",
        n = all.len()
    )
}

fn table(defects: &[Defect]) -> Table {
    let rows = defects.iter().map(|defect| {
        let mark = if defect.is_detected() { Mark::Good } else { Mark::Bad };
        let outcome = defect.outcome.strip_prefix("detected ").unwrap_or(&defect.outcome);
        vec![
            Cell::text(&defect.what),
            Cell::text(format!("{} → {}", defect.bad.versions.join(", "), version(defect))),
            Cell::text(&defect.stage),
            rejected(&defect.bad),
            rejected(&defect.mended),
            Cell::text(outcome).marked(mark),
        ]
    });
    let how = "*releases*: the defective and the corrected one. The same scene runs in both, and each \
               step is checked with default arguments; *before* and *after* are their rejected steps. The stage is the part of the step that was wrong: \
               collision (contacts and their geometry), assembly (the rows and matrices of the \
               problem), solver, or write-back (new velocities and reported forces). By \
               comparison: no step is rejected, but the errors are larger than in the run of the \
               corrected release.";
    let headings =
        "what was wrong | releases | stage | #rejected before | #rejected after | outcome";
    Table::new("Known defects", how, headings, rows.collect())
}

/// The corrected releases, without the names that the defective ones have too.
fn version(defect: &Defect) -> String {
    let name = |release: &str| release.rsplit_once(' ').map(|(name, _)| format!("{name} "));
    let bad = defect.bad.versions.first().and_then(|release| name(release)).unwrap_or_default();
    let short = |release: &String| release.strip_prefix(&bad).unwrap_or(release).to_string();
    defect.mended.versions.iter().map(short).collect::<Vec<_>>().join(", ")
}

/// What the first rejected step's receipt says, or the comparison.
fn receipts(defects: &[Defect]) -> Table {
    let row = |defect: &Defect| {
        let first = defect.bad.what.as_ref().or(defect.bad.worse.first())?;
        let release = Cell::text(defect.bad.versions.join(", "));
        Some(vec![release, Cell::text(first), Cell::text(&defect.source)])
    };
    let how = "The first error of the first rejected step, as its receipt states it, or the \
               comparison of the two runs. The expected bias and target (expected_bias, \
               expected_target) are computed by the engine's adapter from the model.";
    let headings = "defective release | the receipt says | corrected in";
    Table::new("What the receipts say", how, headings, defects.iter().filter_map(row).collect())
}

/// The number of rejected steps and of all, or why there are none.
fn rejected(run: &Replay) -> Cell {
    match &run.unavailable {
        Some(why) => Cell::text(format!("{}: {why}", run.packages.join(", "))),
        None => Cell::text(format!("{} of {}", count(run.refused), count(run.frames))),
    }
}
