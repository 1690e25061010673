//! Reading a scene file: each defect with its line and field.
//!
//! Two kinds of defects: what is no scene at all (syntax, an unknown key, a text for a number),
//! found section by section and body by body; and what is no possible scene (a negative mass, an
//! unknown body), found by [`Scene::new`]. The latter knows only the field; its line is looked up.

use std::ops::Range;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer, ValueDeserializer};

use super::{Description, Scene};
use lcplab_problem::error::{Defects, Error, Result};

/// The JSON schema of the scene format.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(Description).to_value()
}

pub(super) fn parse(path: &str, text: &str) -> Result<Scene> {
    let table = table(path, text)?;
    let source = Source { text, root: table.get_ref() };
    let description = described(path, &table, &source)?;
    Scene::new(path, &description).map_err(|error| source.with_lines(error))
}

/// The description as it is written; whether it makes a scene is not looked at.
pub(super) fn description(path: &str, text: &str) -> Result<Description> {
    let table = table(path, text)?;
    described(path, &table, &Source { text, root: table.get_ref() })
}

fn table<'a>(path: &str, text: &'a str) -> Result<Spanned<DeTable<'a>>> {
    DeTable::parse(text).map_err(|error| {
        let line = error.span().map_or(1, |span| line_at(text, span.start));
        Error::invalid(path, format!("line {line}"), error.message())
    })
}

fn described(path: &str, table: &Spanned<DeTable<'_>>, source: &Source<'_>) -> Result<Description> {
    let mut defects = Defects::default();
    let description = read(table.clone(), source, &mut defects);
    defects.into_result(path)?;
    Ok(description)
}

/// The description, as far as it can be read: one defect a body, a constraint or a section.
fn read(table: Spanned<DeTable<'_>>, source: &Source<'_>, defects: &mut Defects) -> Description {
    let mut whole = table;
    let mut section = |key: &str| whole.get_mut().remove(key);
    let generate = section("generate").map(|part| list(part, source, defects));
    let bodies = section("bodies").map(|part| list(part, source, defects));
    let constraints = section("constraints").map(|part| list(part, source, defects));
    let step = section("step").map(|part| one(part, source, defects));
    let contact = section("contact").map(|part| one(part, source, defects));
    let solver = section("solver").map(|part| one(part, source, defects));
    let rest = source.checked(Description::deserialize_from(whole), defects);
    Description {
        generate: generate.unwrap_or_default(),
        bodies: bodies.unwrap_or_default(),
        constraints: constraints.unwrap_or_default(),
        step: step.flatten().unwrap_or_default(),
        contact: contact.flatten().unwrap_or_default(),
        solver: solver.flatten().unwrap_or_default(),
        ..rest.unwrap_or_default()
    }
}

impl Description {
    fn deserialize_from(table: Spanned<DeTable<'_>>) -> std::result::Result<Self, toml::de::Error> {
        serde::Deserialize::deserialize(Deserializer::from(table))
    }
}

fn one<T: DeserializeOwned>(
    value: Spanned<DeValue<'_>>,
    source: &Source<'_>,
    defects: &mut Defects,
) -> Option<T> {
    let start = value.span().start;
    source.checked_at(start, T::deserialize(ValueDeserializer::from(value)), defects)
}

/// The items of an array, or the one that stands in its place.
fn list<T: DeserializeOwned>(
    value: Spanned<DeValue<'_>>,
    source: &Source<'_>,
    defects: &mut Defects,
) -> Vec<T> {
    match value.get_ref() {
        DeValue::Array(items) => {
            items.iter().filter_map(|item| one(item.clone(), source, defects)).collect()
        }
        _ => one(value, source, defects).into_iter().collect(),
    }
}

/// A parsed text, in which fields have lines and lines have fields.
struct Source<'a> {
    text: &'a str,
    root: &'a DeTable<'a>,
}

impl Source<'_> {
    /// The value, or nothing and a defect where the error says it is.
    fn checked<T>(
        &self,
        outcome: std::result::Result<T, toml::de::Error>,
        defects: &mut Defects,
    ) -> Option<T> {
        self.checked_at(0, outcome, defects)
    }

    /// The value, or nothing and a defect where the error says it is, or at this byte.
    fn checked_at<T>(
        &self,
        start: usize,
        outcome: std::result::Result<T, toml::de::Error>,
        defects: &mut Defects,
    ) -> Option<T> {
        let error = match outcome {
            Ok(value) => return Some(value),
            Err(error) => error,
        };
        let at = error.span().map_or(start, |span| span.start);
        let line = line_at(self.text, at);
        let place = match field_at(self.root, at) {
            Some(field) => format!("line {line}: {field}"),
            None => format!("line {line}"),
        };
        defects.add(place, reason(error.message()));
        None
    }

    /// The same error with a line before each field.
    fn with_lines(&self, error: Error) -> Error {
        let Error::Invalid { input, mut defects } = error else { return error };
        for defect in &mut defects {
            if let Some(span) = span_of(self.root, &defect.place) {
                let line = line_at(self.text, span.start);
                defect.place = format!("line {line}: {}", defect.place);
            }
        }
        Error::Invalid { input, defects }
    }
}

/// What a reader's message says; a key that has got another name is answered with that.
fn reason(message: &str) -> String {
    if message.starts_with("unknown field `formulation`") {
        return "is called \"scheme\" now".into();
    }
    message.replace('`', "\"")
}

/// The line, from 1, of a byte of the text.
fn line_at(text: &str, byte: usize) -> usize {
    text.bytes().take(byte).filter(|&byte| byte == b'\n').count() + 1
}

/// The innermost field, such as `bodies[2].mass`, whose key or value has this byte. A table's span
/// is only its header, so all children are searched before it.
fn field_at(table: &DeTable<'_>, at: usize) -> Option<String> {
    table.iter().find_map(|(key, value)| {
        let name = key.get_ref().as_ref();
        if key.span().contains(&at) {
            return Some(name.to_string());
        }
        in_value(value, at).map(|inner| format!("{name}{inner}"))
    })
}

/// The path from a value to its innermost part that has this byte: `[2].mass`, or nothing at all
/// for the value itself.
fn in_value(value: &Spanned<DeValue<'_>>, at: usize) -> Option<String> {
    let inner = match value.get_ref() {
        DeValue::Table(table) => field_at(table, at).map(|field| format!(".{field}")),
        DeValue::Array(items) => items
            .iter()
            .enumerate()
            .find_map(|(k, item)| in_value(item, at).map(|inner| format!("[{k}]{inner}"))),
        _ => None,
    };
    inner.or_else(|| value.span().contains(&at).then(String::new))
}

/// The place of a field in the text, or of the innermost part around it that is written there.
fn span_of(root: &DeTable<'_>, field: &str) -> Option<Range<usize>> {
    let mut parts = field.split(['.', '[']).map(|part| part.trim_end_matches(']'));
    let (_, mut value) = root.get_key_value(parts.next()?)?;
    for part in parts {
        let inner = match value.get_ref() {
            DeValue::Table(table) => table.get(part),
            DeValue::Array(items) => part.parse().ok().and_then(|k: usize| items.get(k)),
            _ => None,
        };
        match inner {
            Some(inner) => value = inner,
            None => break,
        }
    }
    Some(value.span())
}
