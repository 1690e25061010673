//! Results as pages, tables and JSON: [`experiment`] says what is to be found out by [`study`]s of
//! which [`kind`], [`run`] finds it out, [`results`] holds it, [`view`] shows it and
//! [`write`](mod@write) puts it on disk, [`proofs`] beside it; [`difference`] says what changed
//! between two runs.

pub mod difference;
pub mod experiment;
pub mod grid;
pub mod kind;
mod layout;
pub mod proofs;
pub mod recording;
pub mod results;
pub mod run;
pub mod study;
pub mod view;
pub mod write;

pub use lcplab_page::{page, text};
pub use lcplab_study::{answer, aside, clarabel, friction, methods, motion_error, tasks};
