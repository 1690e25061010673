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
//! title = "What this report does not show"
//! text = "Everything else."
//! ```

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use toml::Spanned;

use super::kind::{self, AnyStudy};
use super::results::Results;
use crate::error::{Defects, Error, Result};
use crate::file;
use crate::lcp::exchange;
use crate::plugin::Declaration;
use crate::scene::catalogue;

macro_rules! shipped {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/reports/", $name, ".toml")))),*]
    };
}

/// The reports that lcplab ships, by name.
pub const SHIPPED: &[(&str, &str)] =
    shipped!["standard" "solvers" "schemes" "friction" "verification" "scenes" "storage"];

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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Fold {
    /// Its tables.
    Tables,
    /// All that its study shows but the outcome.
    All,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    title: String,
    lead: String,
    #[serde(default)]
    plugins: BTreeMap<String, Declaration>,
    #[serde(default)]
    section: Vec<Spanned<toml::Table>>,
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
        let shipped = SHIPPED.iter().find(|(name, _)| *name == path_or_name);
        let (name, text) = shipped.ok_or_else(|| Error::Unknown {
            kind: "report file or shipped report",
            name: path_or_name.into(),
            known: SHIPPED.iter().map(|(name, _)| (*name).into()).collect(),
        })?;
        Self::parse(text, path_or_name, name)
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

    /// The report of a text; `input` stands in the messages.
    ///
    /// # Errors
    /// All defects, with their lines.
    pub fn parse(text: &str, input: &str, name: &str) -> Result<Self> {
        let line = |at: usize| 1 + text[..at].matches('\n').count();
        let mut file: File = toml::from_str(text).map_err(|cause| {
            let at = cause.span().map_or(0, |span| span.start);
            Error::invalid(input, format!("line {}", line(at)), cause.message())
        })?;
        let mut sections: Vec<Section> = Vec::new();
        let mut defects = Defects::default();
        for (k, table) in std::mem::take(&mut file.section).into_iter().enumerate() {
            let place = format!("section {}, from line {}", k + 1, line(table.span().start));
            match section(table.into_inner()) {
                Ok(section) => sections.push(numbered(section, &sections)),
                Err(reason) => defects.add(place, reason),
            }
        }
        defects.into_result(input)?;
        let File { title, lead, plugins, .. } = file;
        Ok(Experiment { name: name.into(), title, lead, sections, plugins, command: None })
    }
}

/// What a section of a file holds besides the settings of its study.
#[derive(Deserialize)]
struct Head {
    study: Option<String>,
    title: Option<String>,
    #[serde(default)]
    text: String,
    #[serde(flatten)]
    shown: Shown,
}

fn section(mut table: toml::Table) -> std::result::Result<Section, String> {
    let words = |error: toml::de::Error| error.message().to_string();
    let mut head = toml::Table::new();
    for key in ["study", "title", "text", "times", "summary", "fold"] {
        head.extend(table.remove(key).map(|value| (key.to_string(), value)));
    }
    let Head { study, title, text, shown } = head.try_into().map_err(words)?;
    let Some(name) = study else {
        if let Some(key) = table.keys().next() {
            return Err(format!("has {key:?} but no study that it could belong to"));
        }
        let title = title.ok_or("needs a title, or a study")?;
        return Ok(Section { id: anchor(&title), title, text, shown, study: None });
    };
    let kind = kind::by_name(&name).map_err(|error| error.to_string())?;
    table.iter_mut().try_for_each(|(_, value)| spread(value)).map_err(|error| error.to_string())?;
    let settings = serde_json::to_value(&table).map_err(|error| error.to_string())?;
    let study = (kind.read)(&settings).map_err(|error| format!("{name}: {error}"))?;
    let title = title.unwrap_or_else(|| kind.title.into());
    Ok(Section { id: name, title, text, shown, study: Some(study.into()) })
}

/// In a list of tables, one whose `scene` or `problem` is a folder or a pattern becomes one for each of its files.
fn spread(value: &mut toml::Value) -> Result<()> {
    let toml::Value::Array(list) = value else { return Ok(()) };
    let is_wanted = |file: &Path| {
        file.extension().is_some_and(|ending| ending == "toml") || exchange::is_problem(file)
    };
    let is_shipped = |name: &str| catalogue::SHIPPED.iter().any(|shipped| shipped.name == name);
    let mut all = Vec::new();
    for item in list.drain(..) {
        let named =
            ["scene", "problem"].into_iter().find_map(|key| Some((key, item.get(key)?.as_str()?)));
        let several = match named {
            Some((_, name)) if is_shipped(name) => None,
            Some((key, name)) => exchange::several(name, is_wanted)?.map(|files| (key, files)),
            None => None,
        };
        let Some((key, files)) = several else {
            all.push(item);
            continue;
        };
        all.extend(files.into_iter().map(|file| {
            let mut item = item.clone();
            item[key] = file.into();
            item
        }));
    }
    *list = all;
    Ok(())
}

fn read(name: &str, settings: &Value) -> Result<Arc<dyn AnyStudy>> {
    (kind::by_name(name)?.read)(settings)
        .map(Arc::from)
        .map_err(|cause| Error::invalid("results.json", name, cause.to_string()))
}

/// The section with a number after its id, if one before it has the same.
fn numbered(mut section: Section, before: &[Section]) -> Section {
    let id = section.id.clone();
    let mut number = 1;
    while before.iter().any(|other| other.id == section.id) {
        number += 1;
        section.id = format!("{id}-{number}");
    }
    section
}

/// A title as an anchor: its words in small letters, joined by hyphens.
fn anchor(title: &str) -> String {
    let words = title.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("-").to_ascii_lowercase()
}
