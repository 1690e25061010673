//! A study of the library as a benchmark: it runs, and its tables are printed.

use lcplab::report::page::{Cell, Table};
use lcplab::report::view::{Document, View};

/// Whether each benchmark is only to run once.
pub fn is_test() -> bool {
    std::env::args().any(|argument| argument == "--test")
}

/// Runs the study's tasks one after the other, then prints what was found out and the times.
pub fn print<S: View>(study: &S) {
    let run = |task| study.run(task).unwrap_or_else(|error| panic!("{error}"));
    let (findings, times): (Vec<_>, Vec<_>) = (0..study.tasks().len()).map(run).unzip();
    let mut document = Document::of(study, &findings);
    study.show_times(&times, &mut document);
    document.tables.iter().for_each(|(_, table)| markdown(table));
    assert!(study.outcome(&findings).good, "{}", study.outcome(&findings).says);
}

fn markdown(table: &Table) {
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
