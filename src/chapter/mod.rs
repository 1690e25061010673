//! The chapter as it is printed, beside what holds: a museum.
//!
//! [`inventory`] has a row for each of the chapter's equations, listings, figures, notes and claims, with
//! what became of it here. [`code`] has the listings as printed, running, each beside its corrected
//! form. [`exhibit`] has the errata: what is printed, what holds, and a smallest example that tells
//! them apart, run when it is looked at; [`errata`] lists them. [`glossary`] has the key terms,
//! [`references`] the literature. Their texts are the TOML files of this folder. Nothing else in the library uses what is printed here.

pub mod code;
mod data;
pub mod errata;
pub mod exhibit;
pub mod glossary;
pub mod inventory;
pub mod references;
