//! The chapter's key terms, each with the function that computes it.

use std::sync::LazyLock;

use serde::Deserialize;

use super::data::{self, one_line};
use crate::document::{Document, Section};

/// A term, as `glossary.toml` has it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Term {
    /// The term.
    pub name: String,
    /// What it means, in our own words.
    #[serde(deserialize_with = "one_line")]
    pub means: String,
    /// Where the library computes it.
    pub code: Vec<String>,
}

/// The terms in the chapter's order, and the one of its title.
pub fn terms() -> &'static [Term] {
    static TERMS: LazyLock<Vec<Term>> =
        LazyLock::new(|| data::list("glossary.toml", include_str!("glossary.toml")));
    &TERMS
}

/// The glossary.
pub fn document() -> Document {
    let mut document = Document {
        title: "Key terms".into(),
        lead: "What the chapter defines at its end, and where the library computes it.".into(),
        is_accepted: true,
        ..Document::default()
    };
    for Term { name, means, code } in terms() {
        let mut section = Section::new(name);
        section.say(means);
        section.say(format!("In the library: {}.", code.join(", ")));
        document.add("", section);
    }
    document
}
