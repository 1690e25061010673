//! TOML texts with line numbers of fields, for error messages.

use std::ops::Range;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue, ValueDeserializer};

use lcplab_lcp::error::{Defects, Error, Result};
use lcplab_lcp::{rolling_friction, xml};

/// The keys of a text with their positions.
///
/// # Errors
/// If it is not TOML, with the line; `path` is used in the message.
pub fn parse<'a>(path: &str, text: &'a str) -> Result<Spanned<DeTable<'a>>> {
    DeTable::parse(text).map_err(|error| {
        if let Some(reason) = xml::reason(text) {
            return Error::invalid(path, "file", reason);
        }
        let line = error.span().map_or(1, |span| line_at(text, span.start));
        Error::invalid(path, format!("line {line}"), error.message())
    })
}

/// A parsed text that maps fields to lines and lines to fields.
pub struct Source<'a> {
    /// The text.
    pub text: &'a str,
    /// Its keys.
    pub root: &'a DeTable<'a>,
}

impl Source<'_> {
    /// The value as a `T`, or `None` with every defect: a wrong item is removed, and the rest is
    /// read again. Defects that are only consequences, such as a missing field, are not reported.
    pub fn read<T: DeserializeOwned>(
        &self,
        value: Spanned<DeValue<'_>>,
        defects: &mut Defects,
    ) -> Option<T> {
        let (start, before) = (value.span().start, defects.len());
        let mut rest = value;
        let mut removed: Vec<(String, usize)> = Vec::new();
        loop {
            let error = match T::deserialize(ValueDeserializer::from(rest.clone())) {
                Ok(value) => return (defects.len() == before).then_some(value),
                Err(error) => error,
            };
            let at = error.span().map_or(start, |span| span.start);
            let missing = error.message().strip_prefix("missing field `");
            let is_whole = missing.is_some() && at == start;
            let field = if is_whole { None } else { in_value(&rest, at) }.unwrap_or_default();
            let follows_from = |(inner, _): &&(String, usize)| match missing {
                Some(key) => *inner == format!("{field}.{}", key.trim_end_matches('`')),
                None => inner.len() > field.len() && inner.starts_with(&field),
            };
            let cause = removed.iter().find(follows_from).map(|(_, at)| *at);
            if cause.is_none() {
                self.add(at, error.message(), defects);
            }
            let at = cause.unwrap_or(at);
            let taken = in_value(&rest, at).unwrap_or_default();
            if is_whole || !remove(&mut rest, at) {
                return None;
            }
            removed.retain(|(inner, _)| !inner.starts_with(&taken));
            if cause.is_none() {
                removed.push((taken, at));
            }
        }
    }

    /// Adds the parser's message at this byte.
    fn add(&self, at: usize, message: &str, defects: &mut Defects) {
        let line = line_at(self.text, at);
        let is_whole = at == 0 && message.starts_with("missing field");
        let place = match field_at(self.root, at).filter(|_| !is_whole) {
            Some(field) => format!("line {line}: {field}"),
            None => format!("line {line}"),
        };
        defects.add(place, reason(message));
    }

    /// The same error with a line number before each field.
    pub(crate) fn with_lines(&self, error: Error) -> Error {
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

/// The text of a parser message; for a renamed key it gives the new name.
fn reason(message: &str) -> String {
    if message.starts_with("unknown field `formulation`") {
        return "is now called \"scheme\"".into();
    }
    let unknown = message.strip_prefix("unknown field `").and_then(|rest| rest.split('`').next());
    if let Some(reason) = unknown.and_then(rolling_friction) {
        return reason;
    }
    let mut words = message.replace('`', "\"");
    for (type_name, word) in
        [("usize", "an integer from 0"), ("f64", "a number"), ("a sequence", "a list")]
    {
        words = words.replace(&format!("expected {type_name}"), &format!("expected {word}"));
    }
    words
}

/// The line, from 1, of a byte in the text.
pub fn line_at(text: &str, byte: usize) -> usize {
    text.bytes().take(byte).filter(|&byte| byte == b'\n').count() + 1
}

/// The innermost field, such as `bodies[2].mass`, whose key or value contains this byte. A table's
/// span is only its header, so all children are searched first.
fn field_at(table: &DeTable<'_>, at: usize) -> Option<String> {
    table.iter().find_map(|(key, value)| {
        let name = key.get_ref().as_ref();
        if key.span().contains(&at) {
            return Some(name.to_string());
        }
        in_value(value, at).map(|inner| format!("{name}{inner}"))
    })
}

/// Removes the innermost key or item that contains this byte from a value; false if only the value
/// itself contains it.
fn remove<'a>(value: &mut Spanned<DeValue<'a>>, at: usize) -> bool {
    match value.get_mut() {
        DeValue::Table(table) => {
            if table.iter_mut().any(|(_, inner)| remove(inner, at)) {
                return true;
            }
            let has = |(key, value): &(&Spanned<_>, &Spanned<_>)| {
                key.span().contains(&at) || value.span().contains(&at)
            };
            let key = table.iter().find(has).map(|(key, _)| key.get_ref().clone());
            key.is_some_and(|key| table.remove(key.as_ref()).is_some())
        }
        DeValue::Array(items) => {
            if items.iter_mut().any(|item| remove(item, at)) {
                return true;
            }
            let kept = |item: &Spanned<DeValue<'a>>| !item.span().contains(&at);
            let count = items.len();
            let all = std::mem::replace(items, DeArray::new());
            *items = all.into_iter().filter(kept).collect();
            items.len() < count
        }
        _ => false,
    }
}

/// The path from a value to its innermost part that contains this byte: `[2].mass`, or empty for
/// the value itself.
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

/// The position of a field in the text, or of the innermost part around it that exists.
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
