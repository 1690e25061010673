//! The record of replayed defects and its section.

use lcplab::report::study::Study;
use lcplab::report::study::defects::{Plan, Record};
use lcplab::report::study::receipt::Stage;
use lcplab::report::view::{ReportPage, View};
use lcplab::solver::Registry;

fn shipped() -> Record {
    Plan::default().run(0, Registry::standard()).unwrap().0
}

fn is_good(record: Record) -> bool {
    Plan::default().outcome(&[record]).good
}

#[test]
fn at_least_twelve_of_fourteen_defects_are_rejected_and_no_corrected_release_is() {
    let record = shipped();
    let rejected = record.defects.iter().filter(|defect| defect.outcome == "detected").count();
    assert!(record.defects.len() == 14 && rejected >= 12, "{rejected}");
    assert!(record.defects.iter().all(|own| own.mended.frames > 0 && own.mended.refused == 0));
    assert!(is_good(record));
}

/// Cells are not markup: an escaped character would be shown with its backslash.
#[test]
fn the_table_shows_the_words_of_the_record() {
    let record = shipped();
    let tables = &ReportPage::of(&Plan::default(), std::slice::from_ref(&record)).tables;
    let [(_, defects)] = tables.as_slice() else { panic!("{}", tables.len()) };
    assert_eq!(defects.rows.len(), record.defects.len());
    for row in &defects.rows {
        let defect = record.defects.iter().find(|defect| defect.what == row[0].text).unwrap();
        assert_eq!(row[1].text, defect.stage.name());
        assert!(defect.source.ends_with(row[2].link.rsplit('/').next().unwrap()), "{row:?}");
        assert!(row.iter().all(|cell| !cell.text.contains('\\')), "{row:?}");
    }
    let first = defects.rows.iter().find(|row| row[0].text == record.defects[0].what).unwrap();
    let cells: Vec<&str> = first[..5].iter().map(|cell| cell.text.as_str()).collect();
    assert_eq!(cells[2..], ["MuJoCo 4.0.0 → 4.0.1", "4 of 1,800", "0"]);
    let says = &first[5].text;
    assert!(says.ends_with("engine posed; relative error up to 5.5"), "{says}");
}

#[test]
fn an_outcome_that_contradicts_its_runs_fails_the_section() {
    let changed = |change: fn(&mut Record)| {
        let mut record = shipped();
        change(&mut record);
        is_good(record)
    };
    assert!(changed(|_| ()));
    assert!(!changed(|record| record.defects[0].mended.refused = 1));
    assert!(!changed(|record| record.defects[0].bad.refused = 0));
    assert!(!changed(|record| record.defects[0].bad.stage = Some(Stage::Collision)));
    assert!(!changed(|record| record.defects[0].outcome = "false alarm".into()));
    assert!(!changed(|record| {
        let by_comparison = |own: &&mut lcplab::report::study::defects::Defect| {
            own.outcome == "detected by comparison"
        };
        record.defects.iter_mut().find(by_comparison).unwrap().bad.worse.clear();
    }));
}
