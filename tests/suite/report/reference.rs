//! The standard report as it is committed: a change in behaviour is a difference here.
//!
//! After a change that is meant, `cargo run --release -- report --out reports/reference` writes it anew.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use lcplab::report::experiment::Experiment;
use lcplab::report::{difference, view, write};

use super::standard::run_all;

/// Numbers may differ by so much, relative to their size, or by so much at all: processors add in
/// different orders, and a residual near rounding has no digits to keep.
const RELATIVE: f64 = 1e-6;
const ABSOLUTE: f64 = 1e-9;
/// The same for places in a picture (px).
const PIXEL: f64 = 0.25;

fn reference() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("reports/reference")
}

#[test]
fn the_standard_report_is_the_committed_one() {
    let folder = tempfile::tempdir().unwrap();
    let results = run_all(&Experiment::load("standard").unwrap());
    write::report(&results, folder.path()).unwrap();
    let read = |folder: &Path| difference::read(&folder.join(write::RESULTS)).unwrap();
    let tolerance = difference::Tolerance { relative: RELATIVE, absolute: ABSOLUTE };
    let changes = difference::between(&read(&reference()), &read(folder.path()), tolerance);
    assert!(changes.is_empty(), "{} changes, the first: {:?}", changes.len(), changes.first());

    let [old, new] = [&reference(), folder.path()].map(|folder| files(&folder.join(view::FILES)));
    assert_eq!(old, new, "the files of figures and tables");
    for name in old.iter().filter(|name| !name.starts_with("timings")) {
        let [old, new] = [&reference(), folder.path()]
            .map(|folder| std::fs::read_to_string(folder.join(view::FILES).join(name)).unwrap());
        let absolute = if name.ends_with("svg") { PIXEL } else { ABSOLUTE };
        let difference = first_difference(&old, &new, absolute);
        assert!(difference.is_none(), "{name}: {}", difference.unwrap_or_default());
    }
}

#[test]
fn a_difference_beyond_the_tolerance_is_found() {
    let differs = |old, new| first_difference(old, new, ABSOLUTE).is_some();
    assert!(!differs("a,1.0,-2e-17\n", "a,1.0000000001,3e-17\n"));
    assert!(!differs("nan,1", "nan,1") && differs("nan", "1") && differs("1", "nan"));
    assert!(differs("a,1.0", "a,1.00001") && differs("a,1", "b,1") && differs("1,2", "1,2,3"));
}

fn files(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).expect("a folder of figures and tables").flatten();
    entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

/// The first line in which numbers differ by more than a tolerance, or anything else at all.
fn first_difference(old: &str, new: &str, absolute: f64) -> Option<String> {
    let (mut before, mut after) = (old.lines(), new.lines());
    loop {
        match (before.next(), after.next()) {
            (None, None) => return None,
            (Some(old), Some(new)) if alike(old, new, absolute) => (),
            (old, new) => return Some(format!("{:?} is now {:?}", old, new)),
        }
    }
}

/// Whether two lines are the same but for the last digits of their numbers.
fn alike(old: &str, new: &str, absolute: f64) -> bool {
    let is_sign = |c: char| !(c.is_ascii_alphanumeric() || ".+-".contains(c));
    let same = |(old, new): (&str, &str)| match (old.parse::<f64>(), new.parse::<f64>()) {
        (Ok(old), Ok(new)) if old.is_nan() => new.is_nan(),
        (Ok(old), Ok(new)) => {
            let apart = (old - new).abs();
            old == new || apart <= absolute + RELATIVE * old.abs().max(new.abs())
        }
        _ => old == new,
    };
    let words = |line: &str| line.split(is_sign).count();
    let signs = |line: &str| line.chars().filter(|c| is_sign(*c)).collect::<String>();
    words(old) == words(new)
        && signs(old) == signs(new)
        && old.split(is_sign).zip(new.split(is_sign)).all(same)
}
