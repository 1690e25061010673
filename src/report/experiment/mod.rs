//! What a report is to find out, as a file: sections of text and studies with their settings.
//!
//! ```toml
//! title = "My report"
//! lead = "What it is about."
//!
//! [[section]]                       # a study, with a heading and words of its own if wanted
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
pub const SHIPPED: &[(&str, &str)] =
    shipped!["standard" "solvers" "schemes" "friction" "verification" "scenes" "engines"];

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
    /// Programs of others that its studies may name as solvers; whoever runs it has to start them.
    pub plugins: BTreeMap<String, Declaration>,
    /// The command that runs it, if it is run by one.
    pub command: Option<String>,
}

/// A section of a report.
pub struct Section {
    /// The anchor on the page, unique in the report.
    pub id: String,
    /// The heading.
    pub title: String,
    /// Words before what the study shows, in page markup.
    pub text: String,
    /// What else stands here, and how.
    pub shown: Shown,
    /// The study; none in a section of words alone.
    pub study: Option<Arc<dyn AnyStudy>>,
}

/// What stands in a section besides words and study, and what of it is folded away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Shown {
    /// Whether what differs from machine to machine stands here.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub times: bool,
    /// Whether the outcomes of all studies stand here.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub summary: bool,
    /// What is folded away, for whoever wants to look things up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fold: Option<Fold>,
}

/// What of a section is folded away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Fold {
    /// Its tables.
    Tables,
    /// All that its study shows but the outcome.
    All,
}

impl Experiment {
    /// Reads a report file, or takes a shipped report by its name.
    ///
    /// # Errors
    /// A name that is neither a file nor shipped, or a file with defects, with their lines.
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
    pub fn of(results: &Results) -> Result<Self> {
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

    /// The same report with one of its sections alone.
    ///
    /// # Errors
    /// If there is no section of that id.
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
/// If none has this name; the message says that there is no such `kind`.
pub fn shipped(name: &str, kind: &'static str) -> Result<&'static str> {
    let found = SHIPPED.iter().find(|(other, _)| *other == name);
    found.map(|(_, text)| *text).ok_or_else(|| Error::Unknown {
        kind,
        name: name.into(),
        known: SHIPPED.iter().map(|(name, _)| (*name).into()).collect(),
    })
}
