//! The chapter as printed, next to the correct statements.
//!
//! [`inventory`] has a row for each of the chapter's equations, listings, figures, notes and
//! claims, with its verdict. [`code`] has the listings as printed, running, each next to its
//! corrected form. [`exhibit`] has the errata: the printed statement, the correct one, and a
//! smallest example that distinguishes them, run when it is opened; [`errata`] lists them.
//! [`glossary`] has the terms of `docs/glossary.md`, [`references`] the literature. The other texts
//! are the TOML files of this folder. No other part of the library uses the printed statements.
//!
//! ```
//! use lcplab::chapter::{errata, exhibit, glossary, inventory, references};
//!
//! // An erratum with its example, and all of them.
//! let first: &exhibit::Exhibit = &exhibit::all()[0];
//! assert_eq!(first.id, "E01");
//! assert!(first.document()?.title.starts_with("E01: "));
//! let tried = errata::tried()?; // runs all examples
//! assert_eq!(tried.len(), exhibit::all().len());
//! assert_eq!(tried[0].to_json()["id"], "E01");
//! assert!(!errata::document(&tried).sections.is_empty());
//!
//! // What the chapter states, and whether it is right.
//! let entry: &inventory::Entry = inventory::all().next().unwrap();
//! assert_eq!(entry.to_json("equation")["id"], entry.id.as_str());
//! assert_eq!(inventory::Verdict::Right.word(), "right");
//! assert!(!inventory::list(None, Some(inventory::Verdict::Right)).sections.is_empty());
//!
//! // Terms and literature.
//! assert!(glossary::terms().iter().any(|term| term.unit == "N"));
//! assert_eq!(glossary::document().title, "Glossary");
//! assert!(references::subjects().iter().all(|subject| !subject.references.is_empty()));
//! assert_eq!(references::document().title, "Literature");
//! # Ok::<(), lcplab::error::Error>(())
//! ```

#[doc(hidden)]
pub mod code;
mod data;
pub mod errata;
pub mod exhibit;
pub mod glossary;
pub mod inventory;
pub mod references;
