//! Literature after and before the chapter, each with a comment and where the library uses it.

use std::sync::LazyLock;

use serde::Deserialize;

use super::data::{self, one_line};
use crate::document::{Document, Section};

/// References on one subject by year, as stored in `references.toml`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Subject {
    /// The subject.
    pub title: String,
    /// The references.
    #[serde(rename = "reference")]
    pub references: Vec<Reference>,
}

/// A paper or book.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// Authors and year, as the library's documentation cites it.
    pub cited: String,
    /// Its title.
    #[serde(deserialize_with = "one_line")]
    pub title: String,
    /// Why to read it.
    #[serde(deserialize_with = "one_line")]
    pub about: String,
    /// Where the library uses it.
    pub code: Vec<String>,
}

/// The literature, by subject.
pub fn subjects() -> &'static [Subject] {
    static SUBJECTS: LazyLock<Vec<Subject>> =
        LazyLock::new(|| data::list("references.toml", include_str!("references.toml")));
    &SUBJECTS
}

/// The list.
pub fn document() -> Document {
    let mut document = Document {
        title: "Literature".into(),
        lead: "What this library follows; each method's own page cites more.".into(),
        is_accepted: true,
        ..Document::default()
    };
    for Subject { title, references } in subjects() {
        let mut section = Section::new(title);
        for Reference { cited, title, about, code } in references {
            section.say(format!("{cited}: {title}. {about} [{}]", code.join(", ")));
        }
        document.add("", section);
    }
    document
}
