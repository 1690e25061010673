//! The chapter as printed, next to the correct statements.
//!
//! [`inventory`] has a row for each of the chapter's equations, listings, figures, notes and
//! claims, with its verdict. [`code`] has the listings as printed, running, each next to its
//! corrected form. [`exhibit`] has the errata: the printed statement, the correct one, and a
//! smallest example that distinguishes them, run when it is opened; [`errata`] lists them.
//! [`glossary`] has the terms of `docs/glossary.md`, [`references`] the literature. The other texts
//! are the TOML files of this folder. No other part of the library uses the printed statements.

pub mod code;
mod data;
pub mod errata;
pub mod exhibit;
pub mod glossary;
pub mod inventory;
pub mod references;
