//! A table of a report as text.

use lcplab::report::page::{Cell, Table};

/// Prints its title and its cells, in Markdown.
pub fn print(table: &Table) {
    println!("\n{}\n", table.title);
    let heading = |title: &str, unit: &str| match unit {
        "" => title.to_string(),
        unit => format!("{title} ({unit})"),
    };
    row(table.columns.iter().map(|column| heading(&column.title, &column.unit)));
    row(table.columns.iter().map(|_| "---".to_string()));
    let text = |cell: &Cell| cell.text.clone();
    table.rows.iter().for_each(|cells| row(cells.iter().map(text)));
}

fn row(cells: impl Iterator<Item = String>) {
    println!("| {} |", cells.collect::<Vec<_>>().join(" | "));
}
