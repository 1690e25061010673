//! What the last active set and its factor are worth.

use super::goal::{self, Asked, Goal};
use crate::study::warm_factor::{Finding, Plan, Times};
use lcplab::report::page::{Cell, Column, Table};
use lcplab::report::study::attempt::Outcome;
use lcplab::report::view::attempt::tolerance;
use lcplab::report::view::{Document, Outcome as Verdict, View};

impl View for Plan {
    const TITLE: &'static str = "Going on from the last active set";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.text(format!(
            "A step is much like the one before. Here every x and w of an answer has moved by up to {} %, the \
             active set has stayed: block pivoting that begins with the set and the factor that the last solve \
             has left needs no exchange and no factorisation, two triangular solves and a look at w. Asked for: \
             a scaled residual of {}.",
            100.0 * self.change,
            tolerance(self.tolerance)
        ));
        document.table("warm_factor", claims(findings));
    }

    fn show_times(&self, times: &[Times], document: &mut Document) {
        let goal = |times: &Times| Goal {
            what: format!("block pivoting, n = {}", times.rows),
            asked: Asked::AtMost(self.goal),
            unit: "of the cold solve",
            measured: Some(times.warm.best / times.cold.best),
        };
        let goals: Vec<Goal> = times.iter().map(goal).collect();
        let (title, command) =
            ("A warm start: goals", "cargo bench -p lcplab-benches --bench direct");
        document.table("warm_factor_goals", goal::table(title, command, &goals));
        document.table("warm_factor_times", seconds(times));
    }

    fn outcome(&self, findings: &[Finding]) -> Verdict {
        let answers = || findings.iter().flat_map(|finding| [&finding.cold, &finding.warm]);
        let solved = answers().filter(|outcome| outcome.is_solved()).count();
        let says = format!("{solved} of {} cold and warm answers accepted", answers().count());
        Verdict { good: answers().all(|outcome| *outcome != Outcome::Refuted), says }
    }
}

fn claims(findings: &[Finding]) -> Table {
    let row = |finding: &Finding| {
        vec![
            Cell::count(finding.rows),
            Cell::text(finding.cold.words()),
            Cell::count(finding.exchanges[0]),
            Cell::text(finding.warm.words()),
            Cell::count(finding.exchanges[1]),
        ]
    };
    Table {
        title: "Cold and warm: what the judge says".into(),
        columns: vec![
            Column::numbers("rows", ""),
            Column::words("cold"),
            Column::numbers("exchanges", ""),
            Column::words("warm"),
            Column::numbers("exchanges", ""),
        ],
        rows: findings.iter().map(row).collect(),
        ..Table::default()
    }
}

fn seconds(times: &[Times]) -> Table {
    let row = |times: &Times| {
        vec![
            Cell::count(times.rows),
            Cell::number(1e6 * times.cold.best, 3),
            Cell::number(1e6 * times.warm.best, 3),
            Cell::number(times.warm.best / times.cold.best, 2),
        ]
    };
    Table {
        title: "Time of a cold and a warm solve".into(),
        how_to_read: "The best of all rounds, in turns.".into(),
        columns: vec![
            Column::numbers("rows", ""),
            Column::numbers("cold", "µs"),
            Column::numbers("warm", "µs"),
            Column::numbers("warm over cold", ""),
        ],
        rows: times.iter().map(row).collect(),
        ..Table::default()
    }
}
