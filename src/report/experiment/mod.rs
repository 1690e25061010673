//! The description of a report as a file: sections of text and studies with their settings.
//!
//! ```toml
//! title = "My report"
//! lead = "What it is about."
//!
//! [[section]]                       # a study, with an optional heading and text
//! study = "convergence"
//! title = "How fast"
//! text = "Look at the slopes: $\\rho^k$."
//! scenes = [{ scene = "chain", step = 50, omegas = [1.0, 1.5] }]
//!
//! [[section]]                       # words alone
//! title = "Limitations of this report"
//! text = "Everything else."
//! ```

mod parse;
mod schema;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

pub use schema::schema;

use super::kind::{self, AnyStudy};
use super::results::Results;
use crate::error::{Error, Result};
use crate::file;
use crate::plugin::Declaration;

macro_rules! shipped {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/reports/", $name, ".toml")))),*]
    };
}

/// The reports that lcplab ships, by name.
pub const SHIPPED: &[(&str, &str)] = shipped!["standard" "solvers" "schemes" "friction" "verification" "scenes" "engines" "receipts"];

/// A report's description.
pub struct Experiment {
    /// The file's name without its extension; also the folder the report is written to.
    pub name: String,
    /// The heading.
    pub title: String,
    /// What the report is about, in a few sentences of page markup.
    pub lead: String,
    /// The sections, in the order of the page.
    pub sections: Vec<Section>,
    /// External programs that its studies may name as solvers; the caller has to start them.
    pub plugins: BTreeMap<String, Declaration>,
    /// The command that runs it, if there is one.
    pub command: Option<String>,
}

/// A section of a report.
pub struct Section {
    /// The anchor on the page, unique in the report.
    pub id: String,
    /// The heading.
    pub title: String,
    /// Text before the results of the study, in page markup.
    pub text: String,
    /// Other content of the section, and how it is shown.
    pub shown: Shown,
    /// The study; `None` in a section of text only.
    pub study: Option<Arc<dyn AnyStudy>>,
}

/// Other content of a section, and what is collapsed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Shown {
    /// Whether the machine-dependent results are shown here.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub times: bool,
    /// Whether the outcomes of all studies are shown here.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub summary: bool,
    /// The reference material that is collapsed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fold: Option<Fold>,
}

/// What is collapsed in a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Fold {
    /// Its tables.
    Tables,
    /// Its tables; its figures after the first one are left out, unless a result is bad.
    Figures,
    /// The study shows its answer and its main figure only; everything, if a result is bad.
    Figure,
    /// The study shows its answer only; everything, if a result is bad.
    Answer,
}

impl Experiment {
    /// Reads a report file, or a shipped report by its name.
    ///
    /// # Errors
    /// If the name is neither a file nor a shipped report, or the file has defects, which are
    /// listed with their lines.
    pub fn load(path_or_name: &str) -> Result<Self> {
        let path = Path::new(path_or_name);
        if file::is_there(path) {
            let text = file::read(path, file::WRITTEN_BY_HAND)?;
            let name = path.file_stem().map_or("report".into(), |name| name.to_string_lossy());
            return Self::parse(&text, path_or_name, &name);
        }
        Self::parse(
            shipped(path_or_name, "report file or shipped report")?,
            path_or_name,
            path_or_name,
        )
    }

    /// The report that these results belong to.
    ///
    /// # Errors
    /// If they name a study that this version does not have.
    pub(crate) fn of(results: &Results) -> Result<Self> {
        let section = |part: &super::results::Part| {
            let study = match &part.study {
                Some(name) => Some(read(name, &part.settings)?),
                None => None,
            };
            let (id, title, text) = (part.id.clone(), part.title.clone(), part.text.clone());
            Ok(Section { id, title, text, shown: part.shown, study })
        };
        Ok(Experiment {
            name: results.name.clone(),
            title: results.title.clone(),
            lead: results.lead.clone(),
            sections: results.sections.iter().map(section).collect::<Result<_>>()?,
            plugins: results.plugins.clone(),
            command: results.machine.command.clone(),
        })
    }

    /// The same report with only this section.
    ///
    /// # Errors
    /// If there is no section with this id.
    pub fn only(mut self, id: &str) -> Result<Self> {
        let known = self.sections.iter().map(|section| section.id.clone()).collect();
        self.sections.retain(|section| section.id == id);
        if self.sections.is_empty() {
            return Err(Error::Unknown { kind: "section", name: id.into(), known });
        }
        Ok(self)
    }
}

fn read(name: &str, settings: &Value) -> Result<Arc<dyn AnyStudy>> {
    (kind::by_name(name)?.read)(settings)
        .map(Arc::from)
        .map_err(|cause| Error::invalid("results.json", name, cause.to_string()))
}

/// The file of a shipped report.
///
/// # Errors
/// If there is none with this name; the message says that there is no such `kind`.
pub(crate) fn shipped(name: &str, kind: &'static str) -> Result<&'static str> {
    let found = SHIPPED.iter().find(|(other, _)| *other == name);
    found.map(|(_, text)| *text).ok_or_else(|| Error::Unknown {
        kind,
        name: name.into(),
        known: SHIPPED.iter().map(|(name, _)| (*name).into()).collect(),
    })
}
