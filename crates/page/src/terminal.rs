//! Tables and prose of pages, for a terminal.

use crate::document;
use crate::document::text::{Ink, aligned, paragraph};
use crate::page::{Align, Cell, Column, Mark, Table};

/// The table with its title above, bad cells marked; below it what is the same in every row, and
/// how to read it.
pub fn table(table: &Table) -> String {
    let (condensed, same) = table.primary().condensed();
    let heading = |column: &Column| match column.unit.as_str() {
        "" => column.title.clone(),
        unit => format!("{} ({unit})", column.title),
    };
    let text = |cell: &Cell| match cell.mark {
        Mark::Bad => format!("✗ {}", cell.text),
        Mark::Good | Mark::Plain | Mark::Note => cell.text.clone(),
    };
    let cells = |row: &Vec<Cell>| row.iter().map(text).collect();
    let align: Vec<Align> = condensed.columns.iter().map(|column| column.align).collect();
    let laid_out = document::Table {
        columns: condensed.columns.iter().map(heading).collect(),
        rows: condensed.rows.iter().map(cells).collect(),
        ..document::Table::default()
    };
    let mut out = format!("{}\n{}", table.title, aligned(&laid_out, &align, Ink::Plain));
    if !same.is_empty() {
        out += &paragraph(&format!("The same in every row: {same}."));
    }
    if !condensed.how_to_read.is_empty() {
        out += &paragraph(&condensed.how_to_read.replace('*', ""));
    }
    out
}

/// Text wrapped for a terminal, each of its lines by itself.
pub fn prose(text: &str) -> String {
    text.lines().map(paragraph).collect()
}
