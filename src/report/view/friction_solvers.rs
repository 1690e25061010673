//! What friction costs each method, under each model.

use super::{Document, Outcome, View};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::families::Row;
use crate::report::study::friction_solvers::{Plan, Times};

impl View for Plan {
    const TITLE: &'static str = "What friction costs";

    fn show(&self, findings: &[Vec<Row>], document: &mut Document) {
        document.text(
            "The same problems under each model of friction, by every method that is made for it. A \
             sweep of a cone method is as long as one over the rows; a pivot of Lemke's method on a \
             polygon of $k$ corners works on $k + 2$ unknowns a contact in place of 3. A method that \
             gives up is a row.",
        );
        document.table("friction_solvers", table(findings.iter().flatten()));
    }

    fn show_times(&self, times: &[Vec<Times>], document: &mut Document) {
        let cells = |time: &Times| {
            let words = [&time.family, &time.model, &time.solver].map(Cell::text);
            words.into_iter().chain([Cell::number(1e3 * time.seconds, 2)]).collect()
        };
        let table = Table {
            title: "What a problem with friction takes".into(),
            how_to_read: "Solvers share the processor, so these are upper bounds.".into(),
            columns: vec![
                Column::words("family"),
                Column::words("model"),
                Column::words("solver"),
                Column::numbers("time", "ms"),
            ],
            rows: times.iter().flatten().map(cells).collect(),
            ..Table::default()
        };
        document.table("friction_solvers_times", table);
    }

    fn outcome(&self, findings: &[Vec<Row>]) -> Outcome {
        let rows = || findings.iter().flatten();
        let sum = |of: fn(&Row) -> usize| rows().map(of).sum::<usize>();
        let (claimed, refuted) = (sum(|row| row.claimed), sum(|row| row.refuted_claims));
        let says =
            format!("{claimed} problems with friction claimed solved, {refuted} claims refuted");
        Outcome { good: !rows().any(Row::is_wrong), says }
    }
}

fn table<'a>(rows: impl Iterator<Item = &'a Row>) -> Table {
    Table {
        title: "Friction problems, models and methods".into(),
        how_to_read: "*claims* are the solver's own, *accepted* and *proved* the judge's, under the model \
                      that was solved. *iterations*: sweeps, pivots or steps, mean over the problems. *worst \
                      residual*: of the answers claimed; – where none was."
            .into(),
        columns: vec![
            Column::words("family"),
            Column::words("model"),
            Column::words("solver"),
            Column::numbers("problems", ""),
            Column::numbers("claims", ""),
            Column::numbers("accepted", ""),
            Column::numbers("proved", ""),
            Column::numbers("refuted", ""),
            Column::numbers("iterations", "a problem"),
            Column::numbers("worst residual", ""),
            Column::words("why not"),
        ],
        rows: rows.map(cells).collect(),
        ..Table::default()
    }
}

fn cells(row: &Row) -> Vec<Cell> {
    let all = |count: usize| {
        Cell::count(count).marked(if count == row.problems { Mark::Plain } else { Mark::Note })
    };
    let refuted = if row.refuted_claims == 0 { Mark::Plain } else { Mark::Bad };
    vec![
        Cell::text(&row.family),
        Cell::text(row.model.as_deref().unwrap_or("–")),
        Cell::text(&row.solver),
        Cell::count(row.problems),
        all(row.claimed),
        all(row.accepted),
        Cell::count(row.proved),
        Cell::count(row.refuted_claims).marked(refuted),
        Cell::number(row.iterations as f64 / row.problems.max(1) as f64, 3),
        row.worst_residual.map_or(Cell::text("–"), |worst| Cell::number(worst, 2)),
        Cell::text(row.trouble.as_deref().unwrap_or_default()),
    ]
}
