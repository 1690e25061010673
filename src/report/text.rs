//! A table as text for a terminal.

use super::page::{Align, Table};

/// The table with its title above and how to read it below.
pub fn table(table: &Table) -> String {
    let heading = |k: usize| {
        let column = &table.columns[k];
        if column.unit.is_empty() {
            column.title.clone()
        } else {
            format!("{} ({})", column.title, column.unit)
        }
    };
    let cell =
        |row: &[super::page::Cell], k: usize| row.get(k).map_or("", |cell| &cell.text).to_string();
    let width = |k: usize| {
        let cells = table.rows.iter().map(|row| cell(row, k).chars().count());
        cells.chain([heading(k).chars().count()]).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..table.columns.len()).map(width).collect();
    let line = |text: &dyn Fn(usize) -> String| {
        let fields = (0..widths.len()).map(|k| match table.columns[k].align {
            Align::Left => format!("{:<width$}", text(k), width = widths[k]),
            Align::Right => format!("{:>width$}", text(k), width = widths[k]),
        });
        fields.collect::<Vec<_>>().join("  ").trim_end().to_string() + "\n"
    };
    let mut out = format!("{}\n", table.title);
    out += &line(&heading);
    for row in &table.rows {
        out += &line(&|k| cell(row, k));
    }
    out + &table.how_to_read.replace('*', "") + "\n"
}
