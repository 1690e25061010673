//! Text for a terminal: tables and safe output.

use std::borrow::Cow;

use super::page::{Align, Table};

/// Replaces every character that would control a terminal by a mark; line feeds and tabs are kept.
/// Names and labels may come from untrusted files.
///
/// ```
/// assert_eq!(lcplab_page::text::printable("a\x1b[2Jb\n"), "a\u{fffd}[2Jb\n");
/// ```
pub fn printable(text: &str) -> Cow<'_, str> {
    let turns = |c: char| matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let steers = |c: char| (c.is_control() && c != '\n' && c != '\t') || turns(c);
    match text.contains(steers) {
        true => text.replace(steers, "\u{fffd}").into(),
        false => text.into(),
    }
}

/// The text padded with spaces to a width, which may exceed the limit of a format string, 65535.
pub fn padded(text: &str, width: usize, align: Align) -> String {
    let space = " ".repeat(width.saturating_sub(text.chars().count()));
    match align {
        Align::Left => format!("{text}{space}"),
        Align::Right => format!("{space}{text}"),
    }
}

/// The table with its title above and its "how to read" below.
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
        let fields = (0..widths.len()).map(|k| padded(&text(k), widths[k], table.columns[k].align));
        fields.collect::<Vec<_>>().join("  ").trim_end().to_string() + "\n"
    };
    let mut out = format!("{}\n", table.title);
    out += &line(&heading);
    for row in &table.rows {
        out += &line(&|k| cell(row, k));
    }
    out + &table.how_to_read.replace('*', "") + "\n"
}
