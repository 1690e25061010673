//! Each erratum is shown by its example: the printed form fails, the corrected one holds.

use lcplab::chapter::exhibit::all;
use lcplab::chapter::{errata, inventory};
use lcplab::document::Format;

#[test]
fn every_example_separates_the_printed_form_from_the_corrected_one() {
    for exhibit in all() {
        let finding = exhibit.found().unwrap();
        assert_ne!(finding.is_some(), !exhibit.in_words.is_empty(), "{}", exhibit.id);
        if let Some(finding) = finding {
            let text = exhibit.document().unwrap().written(Format::Text).unwrap();
            assert!(finding.is_shown(), "{text}");
        }
    }
}

#[test]
fn exhibits_and_lists_fit_a_terminal() {
    let pages = all().iter().map(|exhibit| exhibit.document().unwrap());
    let lists = [errata::document(&errata::tried().unwrap()), inventory::list(None, None)];
    for page in pages.chain(lists) {
        for line in page.written(Format::Text).unwrap().lines() {
            assert!(line.chars().count() <= 128, "{}: {line}", page.title);
        }
    }
}
