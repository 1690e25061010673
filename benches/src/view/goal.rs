//! What was asked of a time, what was measured, and whether it is enough.

use lcplab::number::readable;
use lcplab::report::page::{Cell, Column, Mark, Table};

/// A number that is asked for.
pub(crate) struct Goal {
    /// What is measured.
    pub what: String,
    /// What is asked.
    pub asked: Asked,
    /// The unit of both numbers.
    pub unit: &'static str,
    /// What was measured; nothing if there was no answer to be timed.
    pub measured: Option<f64>,
}

/// Which side of a number is good.
#[derive(Clone, Copy)]
pub(crate) enum Asked {
    /// This or less.
    AtMost(f64),
    /// This or more.
    AtLeast(f64),
}

/// The goals as a table; `command` repeats the measurement.
pub(crate) fn table(title: &str, command: &str, goals: &[Goal]) -> Table {
    Table {
        title: title.into(),
        how_to_read: format!(
            "By the best of all rounds, contenders in turns in one process. Once more: `{command}`."
        ),
        columns: vec![
            Column::words("what"),
            Column::words("must"),
            Column::numbers("measured", ""),
            Column::words("unit"),
            Column::words("reached"),
        ],
        rows: goals.iter().map(row).collect(),
        ..Table::default()
    }
}

fn row(goal: &Goal) -> Vec<Cell> {
    let (must, share) = match goal.asked {
        Asked::AtMost(most) => {
            (format!("≤ {}", readable(most, 3)), goal.measured.map(|m| m / most))
        }
        Asked::AtLeast(least) => {
            (format!("≥ {}", readable(least, 3)), goal.measured.map(|m| least / m))
        }
    };
    let reached = match share {
        Some(share) if share <= 1.0 => Cell::text("yes").marked(Mark::Good),
        Some(share) => {
            Cell::text(format!("no, by a factor of {}", readable(share, 3))).marked(Mark::Note)
        }
        None => Cell::text("no: not all was solved").marked(Mark::Note),
    };
    vec![
        Cell::text(&goal.what),
        Cell::text(must),
        goal.measured.map_or(Cell::text("–"), |measured| Cell::number(measured, 3)),
        Cell::text(goal.unit),
        reached,
    ]
}
