//! The attempts without an accepted claim, with their reasons.

use crate::report::page::{Cell, Table};
use crate::report::study::profiles::FamilyAttempts;
use crate::report::study::trial::Attempt;
use crate::report::view::attempt::tolerance;

/// A failure: solver, tolerance, reason; with the families where it happened.
type Failures = Vec<((String, usize, String), Vec<String>)>;

/// Each attempt without an accepted claim.
pub(super) fn table(tried: &[FamilyAttempts], tolerances: &[f64]) -> Table {
    let row = |((solver, k, reason), families): ((String, usize, String), Vec<String>)| {
        let value = tolerances[k];
        vec![
            Cell::text(solver),
            Cell { value: Some(value), ..Cell::text(tolerance(value)) },
            Cell::text(reason),
            Cell::count(families.len()),
            Cell::text(families.join(", ")),
        ]
    };
    Table::new(
        "Failures, with their reasons",
        "Each attempt without an accepted claim, by solver and reason. Families in brackets \
         have no solution, so failing is correct there.",
        "solver | #precision | reason | #families | which",
        gathered(tried).into_iter().map(row).collect(),
    )
}

/// The attempts without an accepted claim, grouped by solver, tolerance and reason.
fn gathered(tried: &[FamilyAttempts]) -> Failures {
    let mut failures: Failures = Vec::new();
    for family in tried {
        for problem in &family.problems {
            for (k, attempts) in problem.attempts.iter().enumerate() {
                let failed = |attempt: &&Attempt| {
                    attempt.outcome.is_attempt() && !attempt.outcome.is_solved()
                };
                for attempt in attempts.iter().filter(failed) {
                    let reason = attempt.outcome.words().to_string();
                    let key = (attempt.solver.clone(), k, reason);
                    let name = match problem.impossible {
                        true => format!("({})", family.family),
                        false => family.family.clone(),
                    };
                    match failures.iter_mut().find(|(found, _)| *found == key) {
                        Some((_, families)) if families.contains(&name) => {}
                        Some((_, families)) => families.push(name),
                        None => failures.push((key, vec![name])),
                    }
                }
            }
        }
    }
    failures.sort_by(|(a, _), (b, _)| a.cmp(b));
    failures
}
