//! Parses report files; every defect is reported with its line, and those of a study with its name.

use std::collections::BTreeMap;
use std::path::Path;

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::super::kind;
use super::super::view::attempt::anchor;
use super::{Experiment, Section, Shown};
use crate::error::{Defect, Defects, Error, Result};
use crate::files;
use crate::plugin::Declaration;
use crate::scene::catalogue;
use crate::scene::source::{self, Source};

/// The content of a report file other than its sections.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Title {
    /// The heading.
    title: String,
    /// What the report is about, in a few sentences of page markup.
    lead: String,
    /// External programs that its studies may name as solvers.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, serde_json::Value>")]
    plugins: BTreeMap<String, Declaration>,
}

impl Experiment {
    /// Parses a report; `input` is used in messages.
    ///
    /// # Errors
    /// All defects, with their lines.
    pub fn parse(text: &str, input: &str, name: &str) -> Result<Self> {
        let mut table = source::parse(input, text)?;
        let sections = table.get_mut().remove("section");
        let whole = source::parse(input, text)?;
        let source = Source { text, root: whole.get_ref() };
        let mut defects = Defects::default();
        let title: Option<Title> = source.read(value(table), &mut defects);
        let mut all: Vec<Section> = Vec::new();
        for (number, section) in items(sections).into_iter().enumerate() {
            let mut reader = Reader { source: &source, number, defects: &mut defects };
            all.extend(reader.section(section).map(|section| numbered(section, &all)));
        }
        defects.into_result(input)?;
        let Some(Title { title, lead, plugins }) = title else {
            return Err(Error::invalid(input, "title", "is missing"));
        };
        Ok(Experiment { name: name.into(), title, lead, sections: all, plugins, command: None })
    }
}

/// A table as a value.
fn value(table: Spanned<DeTable<'_>>) -> Spanned<DeValue<'_>> {
    Spanned::new(table.span(), DeValue::Table(table.into_inner()))
}

/// The items of a list; a value that is not a list is a single item.
fn items(list: Option<Spanned<DeValue<'_>>>) -> Vec<Spanned<DeValue<'_>>> {
    let Some(list) = list else { return Vec::new() };
    let span = list.span();
    match list.into_inner() {
        DeValue::Array(items) => items.into_iter().collect(),
        other => vec![Spanned::new(span, other)],
    }
}

/// The content of a section other than the settings of its study.
#[derive(Deserialize, JsonSchema)]
pub(super) struct Head {
    /// The kind of study; none in a section of text only.
    study: Option<String>,
    /// The heading; by default that of the study.
    title: Option<String>,
    /// Text before the results of the study, in page markup.
    #[serde(default)]
    text: String,
    #[serde(flatten)]
    shown: Shown,
}

const HEAD: [&str; 6] = ["study", "title", "text", "times", "summary", "fold"];

/// A section being read.
struct Reader<'a> {
    source: &'a Source<'a>,
    /// Its index in the file, from 0.
    number: usize,
    defects: &'a mut Defects,
}

impl Reader<'_> {
    fn section(&mut self, mut section: Spanned<DeValue<'_>>) -> Option<Section> {
        let start = section.span().start;
        let DeValue::Table(table) = section.get_mut() else {
            return self.fault(start, "must be a table");
        };
        let named = table.get("study").map_or(start, |name| name.span().start);
        let head = HEAD.iter().filter_map(|key| table.remove_entry(*key)).collect();
        let head = Spanned::new(section.span(), DeValue::Table(head));
        let head: Head = self.source.read(head, self.defects)?;
        let Some(name) = &head.study else {
            return self.words(head, &section);
        };
        let found = kind::by_name(name).and_then(|kind| spread(&mut section).map(|()| kind));
        let kind = match found {
            Ok(kind) => kind,
            Err(error) => return self.fault(named, &error.to_string()),
        };
        let mut own = Defects::default();
        let study = (kind.parse)(self.source, section, &mut own);
        if let Err(Error::Invalid { defects, .. }) = own.into_result("") {
            defects.into_iter().for_each(|Defect { place, reason }| {
                self.defects.add(place, format!("the study {name:?}: {reason}"));
            });
        }
        let study = study?;
        let (id, usual) = study.named().unwrap_or_else(|| (kind.name.into(), kind.title.into()));
        let Head { title, text, shown, .. } = head;
        let title = title.unwrap_or(usual);
        Some(Section { id, title, text, shown, study: Some(study.into()) })
    }

    /// A section without a study, which may have no other keys than its head.
    fn words(&mut self, head: Head, rest: &Spanned<DeValue<'_>>) -> Option<Section> {
        let key = rest.get_ref().as_table().and_then(|table| table.keys().next());
        if let Some(key) = key {
            let reason = format!("has {:?}, but no study with that setting", key.get_ref());
            return self.fault(key.span().start, &reason);
        }
        let Some(title) = head.title else {
            return self.fault(rest.span().start, "needs a title, or a study");
        };
        let Head { text, shown, .. } = head;
        Some(Section { id: anchor(&title), title, text, shown, study: None })
    }

    /// Adds a defect at the line of this byte; there is then no section.
    fn fault(&mut self, at: usize, reason: &str) -> Option<Section> {
        let line = source::line_at(self.source.text, at);
        self.defects.add(format!("line {line}: section[{}]", self.number), reason);
        None
    }
}

/// In a list of tables, expands one whose `scene` or `problem` is a folder or a pattern to one for
/// each of its files.
fn spread(section: &mut Spanned<DeValue<'_>>) -> Result<()> {
    let is_wanted = |file: &Path| {
        file.extension().is_some_and(|ending| ending == "toml") || files::is_problem(file)
    };
    let is_shipped = |name: &str| catalogue::SHIPPED.iter().any(|shipped| shipped.name == name);
    let DeValue::Table(settings) = section.get_mut() else { return Ok(()) };
    for (_, setting) in settings.iter_mut() {
        if setting.get_ref().is_table() {
            spread(setting)?;
        }
        let DeValue::Array(list) = setting.get_mut() else { continue };
        let mut all = Vec::new();
        for item in std::mem::replace(list, DeArray::new()) {
            let named = |key| Some((key, item.get_ref().get(key)?.get_ref().as_str()?));
            let several = match ["scene", "problem"].into_iter().find_map(named) {
                Some((_, name)) if is_shipped(name) => None,
                Some((key, name)) => files::several(name, is_wanted)?.map(|files| (key, files)),
                None => None,
            };
            let Some((key, files)) = several else {
                all.push(item);
                continue;
            };
            for file in files {
                let mut item = item.clone();
                if let DeValue::Table(table) = item.get_mut()
                    && let Some(name) = table.get_mut(key)
                {
                    *name.get_mut() = DeValue::String(file.into());
                }
                all.push(item);
            }
        }
        *list = all.into_iter().collect();
    }
    Ok(())
}

/// The section with a number appended to its id, if an earlier one has the same.
fn numbered(mut section: Section, before: &[Section]) -> Section {
    let id = section.id.clone();
    let mut number = 1;
    while before.iter().any(|other| other.id == section.id) {
        number += 1;
        section.id = format!("{id}-{number}");
    }
    section
}
