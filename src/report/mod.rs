//! Results as pages, tables and JSON: [`experiment`] describes a report with studies, [`run`]
//! carries it out, [`results`] stores the findings, and [`write`](mod@write) writes a page with
//! them to disk.
//!
//! ```
//! use indicatif::ProgressBar;
//! use lcplab::report::experiment::{Experiment, schema};
//! use lcplab::report::{run::run, write};
//! use lcplab::solver::{Registry, Stop};
//!
//! let text = r#"
//!     title = "A ball"
//!     lead = "A report with one section."
//!     [[section]]
//!     study = "scenes"
//!     title = "Free fall"
//!     scenes = ["free_fall"]
//! "#;
//! let report = Experiment::parse(text, "ball.toml", "ball")?;
//! let id = report.sections[0].id.clone();
//! let report = report.only(&id)?; // of several sections
//! let (solvers, stop) = (Registry::standard(), Stop::default());
//! let results = run(&report, None, solvers, &ProgressBar::hidden(), &stop, &|_| Ok(()))?;
//! assert!(results.is_complete() && results.is_good()?);
//! assert_eq!(results.sections[0].findings().count(), 1); // of one scene
//! println!("{}", results.summary()?);
//!
//! let folder = tempfile::tempdir().unwrap();
//! let page = write::report(&results, folder.path())?;
//! assert!(page.ends_with("index.html") && folder.path().join("results.json").exists());
//! write::results(&results, folder.path())?; // only the results
//!
//! assert!(Experiment::load("scenes")?.sections.len() > 1); // a shipped report
//! assert!(schema()["properties"]["title"].is_object()); // the JSON schema of such files
//! # Ok::<(), lcplab::error::Error>(())
//! ```

#[doc(hidden)]
pub mod difference;
pub mod experiment;
#[doc(hidden)]
pub mod grid;
mod hash;
#[doc(hidden)]
pub mod kind;
mod layout;
#[doc(hidden)]
pub mod recording;
pub mod results;
pub mod run;
#[doc(hidden)]
pub mod study;
#[doc(hidden)]
pub mod view;
pub mod write;

pub use lcplab_analysis::{
    answer, aside, clarabel, friction, loads, methods, minimum, motion_error, tasks,
};
pub use lcplab_page::{page, terminal, text};
