//! The outcomes of all studies of a report, in one table.

use super::ReportPage;
use crate::error::Result;
use crate::report::page::{Cell, Mark, Table};
use crate::report::results::Results;

/// One row for each study with an outcome or a failed task.
pub(super) fn show(results: &Results, document: &mut ReportPage) -> Result<()> {
    let outcomes = results.outcomes()?;
    let rows = outcomes.iter().filter_map(|(id, outcome)| {
        let part = results.sections.iter().find(|part| part.id == *id)?;
        let failed = part.tasks.iter().filter(|task| task.failure.is_some()).count();
        let says = match failed {
            0 => outcome.says.clone(),
            _ => format!("{} {failed} of {} tasks failed.", outcome.says, part.tasks.len()),
        };
        let verdict = match outcome.good && failed == 0 {
            true => Cell::text("passed").marked(Mark::Good),
            false => Cell::text("FAILED").marked(Mark::Bad),
        };
        let check = part.study.as_deref().and_then(check).unwrap_or(&part.title);
        let row = vec![Cell::text(check), Cell::text(says.trim()), verdict];
        (!says.is_empty()).then_some(row)
    });
    let table =
        Table::new("The checks of this report", "", "check | result | outcome", rows.collect());
    document.table("summary", table);
    Ok(())
}

/// What a study checks, for studies whose section has another subject.
fn check(study: &str) -> Option<&'static str> {
    Some(match study {
        "comparison" => "judge, every step",
        "convergence" => "judge, problems",
        "cross-check" => "clarabel",
        "drift" => "half steps",
        "grid" => "judge, grid",
        "verification" => "closed forms",
        _ => return None,
    })
}
