//! Problem families × solvers as a table.

use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::families::Row;
use crate::trace::NO_ITERATES;

/// One row a family, model of friction and solver.
pub fn table(rows: &[Row]) -> Table {
    Table {
        title: "Problem families and solvers".into(),
        how_to_read:
            "*friction*: the model that x is solved and judged under. *outside*: the solver says \
                      the problem is not in its class. *claims* are its own, *proved* and \
                      *accepted* the judge's; *refuted* and *false* claims must be 0. *worst \
                      residual*: of the answers that it claims; – where it claims none. *iterates*: a \
                      fingerprint of their path; – where none were told. *fallback*: what else than \
                      the method itself had a part, and how often. *must fail*: a \
                      failure that mathematics explains, and that must stay one."
                .into(),
        columns: vec![
            Column::words("family"),
            Column::words("friction"),
            Column::words("solver"),
            Column::numbers("problems", ""),
            Column::numbers("outside", ""),
            Column::numbers("claims", ""),
            Column::numbers("proved", ""),
            Column::numbers("accepted", ""),
            Column::numbers("refuted", ""),
            Column::numbers("false", ""),
            Column::numbers("iterations", "a problem"),
            Column::numbers("worst residual", ""),
            Column::numbers("time", "ms"),
            Column::words("iterates"),
            Column::words("fallback"),
            Column::words("why not"),
        ],
        rows: rows.iter().map(cells).collect(),
        ..Table::default()
    }
}

fn cells(row: &Row) -> Vec<Cell> {
    let attempts = row.problems - row.outside;
    let zero =
        |count: usize| Cell::count(count).marked(if count == 0 { Mark::Plain } else { Mark::Bad });
    let short = row.claimed < attempts && row.known_failure.is_none();
    let why = match (&row.known_failure, &row.trouble) {
        (Some(why), _) => format!("must fail: {why}"),
        (None, Some(trouble)) => trouble.clone(),
        (None, None) => String::new(),
    };
    let fallback = match &row.fallback {
        Some(what) => format!("{what}, {} of {}", row.fallbacks, row.problems),
        None => "none".into(),
    };
    let has_iterates = row.fingerprint != format!("{NO_ITERATES:016x}");
    vec![
        Cell::text(&row.family),
        Cell::text(row.model.as_deref().unwrap_or_default()),
        Cell::text(&row.solver),
        Cell::count(row.problems),
        Cell::count(row.outside),
        Cell::count(row.claimed).marked(if short { Mark::Note } else { Mark::Plain }),
        Cell::count(row.proved),
        Cell::count(row.accepted),
        zero(row.refuted_claims),
        zero(row.false_claims),
        Cell::number(row.iterations as f64 / attempts.max(1) as f64, 3),
        row.worst_residual.map_or(Cell::text("–"), |worst| Cell::number(worst, 2)),
        Cell::number(1e3 * row.seconds, 2),
        Cell::text(if has_iterates { &row.fingerprint[..8] } else { "–" }),
        Cell::text(fallback),
        Cell::text(why),
    ]
}
