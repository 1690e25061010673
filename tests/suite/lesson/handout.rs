//! The handout goes through the whole chapter: every equation, figure, listing and erratum is in
//! it.

use std::fs;

use lcplab::lesson::source::{Part, Source};

use super::{handout, run};

const HANDOUT: &str = include_str!("../../../reports/chapter.md");

/// The prose without the cells, a part a paragraph.
fn prose() -> String {
    let source = Source::read(HANDOUT);
    let prose = source.parts.iter().filter_map(|part| match part {
        Part::Prose(prose) => Some(format!("\n{prose}\n")),
        Part::Cell { .. } | Part::Python { .. } => None,
    });
    prose.collect()
}

/// How often a text stands in the prose.
fn count(text: &str) -> usize {
    prose().matches(text).count()
}

/// The same wherever its lines break.
fn count_words(text: &str) -> usize {
    prose().split_whitespace().collect::<Vec<_>>().join(" ").matches(text).count()
}

#[test]
fn every_equation_is_stated_once_and_displayed() {
    let numbered = (1..=45).map(|k| format!("({k})"));
    let unnumbered = (1..=6).map(|k| format!("U{k}"));
    for equation in numbered.chain(unnumbered) {
        let head = format!("\n**K&M {equation}**\n\n$$ ");
        assert_eq!(count(&head), 1, "K&M {equation}");
    }
}

#[test]
fn every_figure_and_the_table_come_from_our_own_simulation() {
    for figure in 1..=13 {
        let words = format!("**K&M Figure {figure}, drawn again");
        assert_eq!(count_words(&words), 1, "Figure {figure}");
    }
    assert_eq!(count("**Table 1**"), 1);
}

#[test]
fn every_listing_is_run_as_printed_and_as_corrected() {
    let source = Source::read(HANDOUT);
    let cells = source.cells().collect::<Vec<_>>().join("\n");
    let listings = [
        ("Codes 1 and 2", ["code01::printed", "code01::corrected"]),
        ("Codes 1 and 2", ["code02::printed", "code02::corrected"]),
        ("Code 3", ["Form::Printed", "code03::update"]),
        ("Code 4", ["code04::printed", "code04::corrected"]),
        ("Code 5", ["code05::printed", "code05::corrected"]),
        ("Code 6", ["code06::printed", "code06::corrected"]),
        ("Code 7", ["WholeStep::PRINTED", "WholeStep::CORRECTED"]),
        ("Code 8", ["code08::printed", "code08::corrected"]),
        ("Codes 9 and 10", ["code10::printed", "code10::corrected"]),
        ("Code 11", ["code11::printed", "code11::corrected"]),
    ];
    for (name, calls) in listings {
        assert!(count(&format!("**{name}**")) == 1, "{name} is not introduced");
        for call in calls {
            assert!(cells.contains(call), "{name}: no cell has {call}");
        }
    }
}

#[test]
fn every_erratum_is_a_note_once() {
    for k in 1..=67 {
        assert_eq!(count(&format!("\n{{{{E{k:02}}}}}")), 1, "E{k:02}");
    }
}

#[test]
fn the_page_is_written_small_and_fetches_nothing_and_is_the_same_each_time() {
    let html = fs::read_to_string(handout().join("index.html")).unwrap();
    assert!(html.len() < 5_000_000, "{} bytes", html.len());
    let outside = html.replace("http://www.w3.org/", "");
    for fetch in ["src=\"http", "@import", "<link rel=\"stylesheet"] {
        assert!(!outside.contains(fetch), "the page has {fetch}");
    }
    assert!(html.matches("<svg ").count() >= 18, "pictures are missing");
    let folder = tempfile::tempdir().unwrap();
    run(&["report", "chapter", "--out", folder.path().to_str().unwrap()]);
    assert_eq!(fs::read_to_string(folder.path().join("index.html")).unwrap(), html);
}
