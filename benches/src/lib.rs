//! How fast lcplab is: studies beside clarabel, beside a read of memory, beside other engines.
//!
//! They stand apart from the program, whose users do not ask whether its makers reached their targets.
//! [`KINDS`] lets a report file ask for them, and [`page`] writes the report of all.

pub mod study;
mod view;

use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use lcplab::error::Result;
use lcplab::report::experiment::Experiment;
use lcplab::report::kind::{self, Kind};
use lcplab::report::results::Results;
use lcplab::report::{run, view as pages, write};
use lcplab::solver::Stop;

/// The kinds of studies here.
pub const KINDS: &[Kind] = &[
    Kind::of::<study::singular::Plan>(),
    Kind::of::<study::direct_speed::Plan>(),
    Kind::of::<study::warm_factor::Plan>(),
    Kind::of::<study::sparse_speed::Plan>(),
    Kind::of::<study::sweep_speed::Plan>(),
    Kind::of::<study::step_speed::Plan>(),
    Kind::of::<study::peers::Plan>(),
];

/// The report of all of them.
///
/// # Errors
/// If the file beside this crate has defects.
pub fn report() -> Result<Experiment> {
    kind::add(KINDS);
    Experiment::parse(include_str!("../report.toml"), "benches/report.toml", "performance")
}

/// Runs the report and writes its page into a folder; returns the summary and the page's path.
///
/// # Errors
/// If a study cannot run, or the folder cannot be written.
pub fn page(folder: &Path, progress: &ProgressBar) -> Result<(String, PathBuf)> {
    let save = |results: &Results| write::results(results, folder);
    let results = run::run(&report()?, None, progress, &Stop::default(), &save)?;
    let page = write::document(&pages::document(&results)?, folder)?;
    Ok((results.summary()?, page))
}
