//! Results as pages, tables and JSON: [`experiment`] describes a report with [`study`]s of some
//! [`kind`], [`run`] carries it out, [`results`] stores the findings, [`view`] shows them and
//! [`write`](mod@write) writes them to disk; [`difference`] compares two runs.

pub mod difference;
pub mod experiment;
pub mod grid;
mod hash;
pub mod kind;
mod layout;
pub mod recording;
pub mod results;
pub mod run;
pub mod study;
pub mod view;
pub mod write;

pub use lcplab_analysis::{
    answer, aside, clarabel, friction, loads, methods, minimum, motion_error, tasks,
};
pub use lcplab_page::{page, terminal, text};
