//! Problem families × solvers as a table.

use crate::report::page::{Cell, Mark, Table};
use crate::report::study::families::Row;
use crate::trace::NO_ITERATES;

/// What a table on paper or a terminal has no room for.
const SECONDARY: [&str; 4] = ["outside", "multiplications per problem", "iterates", "fallback"];

/// One row per family, friction model and solver.
pub fn table(rows: &[Row]) -> Table {
    let must_fail = rows.iter().any(|row| row.known_failure.is_some());
    let must_fail = if must_fail { " *must fail*: a failure that theory predicts." } else { "" };
    let mut table = Table::new(
        "Problems and solvers",
        "*friction*: the friction model for solving and judging. *outside*: the solver reports that the \
             problem is outside its class. *claims*: the solver's own; *proved* and *accepted*: the judge's \
             verdicts; *rejected* and *false* claims must be 0. *worst residual*: over the claimed answers; – \
             if there are none. *multiplications per problem*: by the formula of the method; – if unknown. \
             *iterates*: a hash of their sequence; – if none were reported. *fallback*: other methods that \
             contributed, and how often."
            .to_string()
            + must_fail,
        "family or file | friction | solver | #problems | #outside | #claims | #proved | #accepted | \
         #rejected | #false | #iterations per problem | #multiplications per problem | \
         #worst residual | #time (ms) | iterates | fallback | reason",
        rows.iter().map(cells).collect(),
    );
    for column in &mut table.columns {
        column.secondary = SECONDARY.contains(&column.title.as_str());
    }
    table
}

/// One row per solver, over all its problems.
pub(crate) fn by_solver(rows: &[Row]) -> Table {
    let mut names: Vec<&str> = Vec::new();
    for row in rows {
        if !names.contains(&row.solver.as_str()) {
            names.push(&row.solver);
        }
    }
    let cells = |name: &&str| {
        let own: Vec<&Row> = rows.iter().filter(|row| row.solver == *name).collect();
        let sum = |of: fn(&Row) -> usize| own.iter().map(|row| of(row)).sum::<usize>();
        let rejected = sum(|row| row.claimed - row.accepted.min(row.claimed));
        vec![
            Cell::text(*name),
            Cell::count(sum(|row| row.problems)),
            Cell::count(sum(|row| row.outside)),
            Cell::count(sum(|row| row.claimed)),
            Cell::count(sum(|row| row.accepted)),
            Cell::count(rejected).marked(if rejected == 0 { Mark::Plain } else { Mark::Bad }),
            Cell::number(1e3 * own.iter().map(|row| row.seconds).sum::<f64>(), 2),
        ]
    };
    Table::new(
        "By solver",
        "All problems of the table above, under all models.",
        "solver | #problems | #outside | #claims | #accepted | #rejected | #time (ms)",
        names.iter().map(cells).collect(),
    )
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
    let work = row.multiplications.map(|work| work / attempts.max(1) as f64);
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
        zero(row.rejected_claims),
        zero(row.false_claims),
        Cell::number(row.iterations as f64 / attempts.max(1) as f64, 3),
        work.map_or(Cell::text("–"), |work| Cell::number(work, 3)),
        row.worst_residual.map_or(Cell::text("–"), |worst| Cell::number(worst, 2)),
        Cell::number(1e3 * row.seconds, 2),
        Cell::text(if has_iterates { &row.fingerprint[..8] } else { "–" }),
        Cell::text(fallback),
        Cell::text(why),
    ]
}
