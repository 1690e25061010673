//! Results as pages, tables and JSON: [`experiment`] says what is to be found out by [`study`]s of
//! which [`kind`], [`run`] finds it out, [`results`] holds it, [`view`] shows it and
//! [`write`](mod@write) puts it on disk; [`difference`] says what changed between two runs.

pub mod answer;
pub mod aside;
pub mod clarabel;
pub mod difference;
pub mod experiment;
pub mod friction;
pub mod kind;
mod layout;
pub mod methods;
pub mod page;
pub mod recording;
pub mod results;
pub mod run;
pub mod study;
pub mod sweep;
mod tasks;
pub mod text;
pub mod view;
pub mod write;
