//! The standard report as it is committed: a change of behavior shows as a difference here.
//!
//! After an intended change, `cargo run --release -- report --out reports/reference` renews it.

use std::path::Path;

use lcplab::report::experiment::Experiment;
use lcplab::report::{difference, write};

use super::standard::run_all;

/// Numbers may differ by so much, relative to their size, or by so much at all: processors add in
/// different orders, and a residual near rounding has no digits to keep.
const RELATIVE: f64 = 1e-6;
const ABSOLUTE: f64 = 1e-9;

#[test]
fn the_standard_report_is_the_committed_one() {
    let folder = tempfile::tempdir().unwrap();
    let results = run_all(&Experiment::load("standard").unwrap());
    write::report(&results, folder.path()).unwrap();
    let read = |folder: &Path| difference::read(&folder.join(write::RESULTS)).unwrap();
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("reports/reference");
    let tolerance = difference::Tolerance { relative: RELATIVE, absolute: ABSOLUTE };
    let changes = difference::between(&read(&committed), &read(folder.path()), tolerance);
    assert!(changes.is_empty(), "{} changes, the first: {:?}", changes.len(), changes.first());
}
