//! Tables and prose of pages, for a terminal.
//!
//! ```
//! use lcplab_page::page::{Cell, Table};
//! use lcplab_page::terminal::{prose, table, table_within};
//!
//! let rows = vec![vec![Cell::text("stack"), Cell::number(0.25, 2)]];
//! let drift = Table::new("Drift", "", "scene | #drift (m)", rows);
//! assert!(table(&drift).contains("stack") && table_within(&drift, 40).contains("0.25"));
//! assert_eq!(prose("A short line.").trim_end(), "A short line.");
//! ```

use crate::document;
use crate::document::text::{Ink, TABLE, aligned, is_readable, paragraph, wrapped};
use crate::page::{Align, Cell, Column, Mark, Table};

/// The margins of a row that is a paragraph: of its words, and of its other cells.
const MARGINS: [usize; 2] = [4, 8];

/// The table with its title above, bad cells marked; below it what is the same in every row, and
/// how to read it.
pub fn table(table: &Table) -> String {
    let (condensed, same) = table.primary().condensed();
    let rows = in_columns(&condensed, TABLE);
    titled(&condensed, &rows, &same)
}

/// The same in lines of at most this many characters: if the columns need more, each row is a
/// paragraph, its first words on a line, its other cells below with their headings.
pub fn table_within(table: &Table, width: usize) -> String {
    let (condensed, same) = table.primary().condensed();
    let rows = match is_readable(&laid_out(&condensed), width) {
        true => in_columns(&condensed, width),
        false => condensed.rows.iter().map(row(&condensed, width)).collect(),
    };
    titled(&condensed, &rows, &same)
}

/// Lines of at most this many characters; a longer one continues below, indented.
///
/// ```
/// use lcplab_page::terminal::hanging;
///
/// assert_eq!(hanging("drift    one two three", 9, 16), "drift    one two\n         three\n");
/// ```
pub fn hanging(text: &str, indent: usize, width: usize) -> String {
    let mut out = String::new();
    for line in text.lines() {
        let (label, rest) = line.split_at_checked(indent).unwrap_or((line, ""));
        out += label;
        out += &wrapped(rest, width - indent).join(&format!("\n{:indent$}", ""));
        out.push('\n');
    }
    out
}

/// The rows between the title and the words that explain them.
fn titled(table: &Table, rows: &str, same: &[(String, String)]) -> String {
    let mut out = format!("{}\n{rows}", table.title);
    if !same.is_empty() {
        let said: Vec<String> =
            same.iter().map(|(title, value)| format!("{title} = {value}")).collect();
        out += &paragraph(&format!("The same in every row: {}.", said.join(", ")));
    }
    if !table.how_to_read.is_empty() {
        out += &paragraph(&table.how_to_read.replace('*', ""));
    }
    out
}

/// The headings and rows in columns.
fn in_columns(table: &Table, width: usize) -> String {
    let align: Vec<Align> = table.columns.iter().map(|column| column.align).collect();
    aligned(&laid_out(table), &align, width, Ink::Plain)
}

/// The headings and rows as text.
fn laid_out(table: &Table) -> document::Table {
    let cells = |row: &Vec<Cell>| row.iter().map(text).collect();
    document::Table {
        columns: table.columns.iter().map(heading).collect(),
        rows: table.rows.iter().map(cells).collect(),
        ..document::Table::default()
    }
}

/// A row as a paragraph: its words up to the first number, then each other cell with its heading.
fn row(table: &Table, width: usize) -> impl Fn(&Vec<Cell>) -> String {
    let is_word = |column: &&Column| column.align == Align::Left;
    let leading = table.columns.iter().take_while(is_word).count();
    move |row| {
        let named = row[..leading].iter().filter(|cell| !cell.text.is_empty());
        let words: Vec<String> = named.map(text).collect();
        let others = table.columns.iter().zip(row).skip(leading);
        let stated = others.filter(|(_, cell)| !matches!(cell.text.as_str(), "" | "–"));
        let numbers: Vec<String> =
            stated.map(|(column, cell)| format!("{}: {}", heading(column), text(cell))).collect();
        let parts = [words.join(", "), numbers.join("; ")];
        let indented = |(part, margin): (&String, usize)| -> String {
            let lines = wrapped(part, width - margin);
            lines.iter().map(|line| format!("{:margin$}{line}\n", "")).collect()
        };
        parts.iter().zip(MARGINS).map(indented).collect()
    }
}

/// The heading of a column, with its unit.
fn heading(column: &Column) -> String {
    match column.unit.as_str() {
        "" => column.title.clone(),
        unit => format!("{} ({unit})", column.title),
    }
}

/// The text of a cell; a bad one is marked.
fn text(cell: &Cell) -> String {
    match cell.mark {
        Mark::Bad => format!("✗ {}", cell.text),
        Mark::Good | Mark::Plain | Mark::Note => cell.text.clone(),
    }
}

/// Text wrapped for a terminal, each of its lines by itself.
pub fn prose(text: &str) -> String {
    text.lines().map(paragraph).collect()
}
