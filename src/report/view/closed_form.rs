//! Known numbers beside measured ones.

use super::Document;
use crate::plot::number::significant;
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::closed_form::ClosedForm;

pub(super) fn section(document: &mut Document, rows: &[ClosedForm]) {
    if rows.is_empty() {
        return;
    }
    let failed = rows.iter().filter(|row| !row.passes()).count();
    document.open("closed-forms", "Numbers that are known without a computer");
    document.text(format!(
        "Before any solver is compared: does the simulation get right what can be worked out by \
         hand? {} of {} numbers are within their tolerance. Each tolerance has its reason; where \
         the time step is the reason, a shorter step must bring the number closer.",
        rows.len() - failed,
        rows.len()
    ));
    document.table("closed_forms", table(rows));
}

fn table(rows: &[ClosedForm]) -> Table {
    Table {
        title: "Closed forms and measured values".into(),
        how_to_read: "*error* is relative to the expected value, or absolute where that is 0; a \
                      row passes if its error is at most *allowed*."
            .into(),
        columns: vec![
            Column::words("scene"),
            Column::words("level"),
            Column::words("quantity"),
            Column::numbers("expected", ""),
            Column::numbers("measured", ""),
            Column::words("unit"),
            Column::numbers("error", ""),
            Column::numbers("allowed", ""),
            Column::words("verdict"),
        ],
        rows: rows.iter().map(cells).collect(),
        files: Vec::new(),
    }
}

fn cells(row: &ClosedForm) -> Vec<Cell> {
    let verdict = match row.passes() {
        true => Cell::text("pass").marked(Mark::Good),
        false => Cell::text("fail").marked(Mark::Bad),
    };
    let seven =
        |value: f64| Cell { text: significant(value, 7), value: Some(value), ..Cell::default() };
    vec![
        Cell::text(&row.scene),
        Cell::text(&row.formulation),
        Cell::text(&row.quantity),
        seven(row.expected),
        seven(row.measured),
        Cell::text(&row.unit),
        Cell::number(row.error(), 2),
        Cell::number(row.tolerance, 1),
        verdict,
    ]
}
