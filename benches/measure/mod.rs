//! A study of the library as a benchmark: it runs, and its tables are printed.

mod table;

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
    document.tables.iter().for_each(|(_, shown)| table::print(shown));
    assert!(study.outcome(&findings).good, "{}", study.outcome(&findings).says);
}
