//! The list of errata, each with its example run.

use serde_json::{Value, json};

use super::exhibit::{self, Exhibit};
use crate::document::{Block, Document, Section, Table, unicode};
use crate::error::Result;

/// An erratum and the result of its example.
#[derive(Debug, Clone, Copy)]
pub struct ErratumResult {
    /// The erratum.
    pub exhibit: &'static Exhibit,
    /// Whether the example distinguished the printed form from the corrected one; `None` without an
    /// example.
    pub is_shown: Option<bool>,
}

/// Runs all examples.
///
/// # Errors
/// If an example cannot be set up.
pub fn tried() -> Result<Vec<ErratumResult>> {
    exhibit::all().iter().map(ErratumResult::of).collect()
}

/// The list of errata with their results.
pub fn document(tried: &[ErratumResult]) -> Document {
    let line = |tried: &ErratumResult| {
        let Exhibit { id, severity, place, title, .. } = tried.exhibit;
        [id, severity.word(), tried.word(), place, title].map(str::to_string).to_vec()
    };
    let mut section = Section::new("errata");
    let columns = ["no.", "severity", "its example", "place", "about"];
    let (title, rows) = ("Errata and what their examples show", tried.iter().map(line).collect());
    section.blocks.push(Block::Table(Table::whole(title, &columns, rows)));
    let mut document = Document {
        title: "Errata of the chapter".into(),
        lead: format!("{} entries, all examples run just now.", tried.len()),
        is_accepted: tried.iter().all(|tried| tried.is_shown != Some(false)),
        ..Document::default()
    };
    document.add("", section);
    document
}

impl ErratumResult {
    /// Runs the example of an erratum.
    ///
    /// # Errors
    /// If it cannot be set up.
    pub(crate) fn of(exhibit: &'static Exhibit) -> Result<Self> {
        let is_shown = exhibit.found()?.map(|finding| finding.is_shown());
        Ok(ErratumResult { exhibit, is_shown })
    }

    /// The result, in words.
    pub(crate) fn word(&self) -> &'static str {
        match self.is_shown {
            Some(true) => "shown",
            Some(false) => "not shown",
            None => "in words",
        }
    }

    /// The result as JSON.
    pub fn to_json(&self) -> Value {
        let Exhibit { id, title, place, severity, printed, holds, why, .. } = self.exhibit;
        json!({
            "id": id, "title": title, "place": place, "severity": severity.word(),
            "example": self.word(), "printed": unicode(printed), "holds": unicode(holds), "why": why,
        })
    }
}
