//! Reads JSON from untrusted files: a duplicate key is an error, while most readers silently take
//! the last value.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Number, Value};

use crate::error;

/// The JSON value of a text.
///
/// ```
/// let twice = lcplab_lcp::json::parse(r#"{"b": [1], "b": [2]}"#).unwrap_err();
/// assert_eq!(twice.to_string(), "the key \"b\" is given twice at line 1 column 14");
/// ```
///
/// # Errors
/// If it is not JSON, or an object in it has a duplicate key.
pub fn parse(text: &str) -> serde_json::Result<Value> {
    serde_json::from_str(text).map(|Unique(value)| value)
}

/// The JSON value of a file's text.
///
/// ```
/// let cut = lcplab_lcp::json::read(r#"{"b": [1,"#, "p.json").unwrap_err().to_string();
/// assert_eq!(cut, "p.json: line 1, column 9: not valid JSON: EOF while parsing a value");
/// ```
///
/// # Errors
/// As [`parse`], with the file and the place.
pub fn read(text: &str, input: &str) -> error::Result<Value> {
    if text.starts_with('\u{feff}') {
        let reason = "begins with a byte order mark; save it as UTF-8 without one";
        return Err(error::Error::invalid(input, "file", reason));
    }
    if text.trim().is_empty() {
        return Err(error::Error::invalid(input, "file", "is empty"));
    }
    parse(text).map_err(|cause| fault(text, input, &cause))
}

/// Why a file's text cannot be read, with the place.
///
/// ```
/// let text = r#"{"b": NaN}"#;
/// let cause = lcplab_lcp::json::parse(text).unwrap_err();
/// let error = lcplab_lcp::json::fault(text, "p.json", &cause).to_string();
/// assert!(error.ends_with("write \"inf\", \"-inf\" or \"nan\" with quotation marks"));
/// ```
pub fn fault(text: &str, input: &str, cause: &serde_json::Error) -> error::Error {
    let place = format!("line {}, column {}", cause.line(), cause.column());
    let not_json = if cause.is_data() { "" } else { "not valid JSON: " };
    let reason = cause.to_string();
    // serde_json repeats the place at the end.
    let reason = reason.split(" at line ").next().unwrap_or(&reason);
    let hint = match at_number_word(text, cause) {
        true => "; write \"inf\", \"-inf\" or \"nan\" with quotation marks",
        false => "",
    };
    error::Error::invalid(input, place, format!("{not_json}{reason}{hint}"))
}

/// Whether the parser stopped at a number that other programs write but JSON does not have.
fn at_number_word(text: &str, cause: &serde_json::Error) -> bool {
    let line = text.lines().nth(cause.line().saturating_sub(1)).unwrap_or_default();
    let at: String = line.chars().skip(cause.column().saturating_sub(2)).take(12).collect();
    ["Infinity", "NaN", "inf", "nan"].iter().any(|word| at.contains(word))
}

/// A value whose objects have no duplicate keys.
pub(crate) struct Unique(pub(crate) Value);

impl<'de> Deserialize<'de> for Unique {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Reader).map(Unique)
    }
}

struct Reader;

impl<'de> Visitor<'de> for Reader {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(Number::from_f64(value).map_or(Value::Null, Value::Number))
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_string<E>(self, value: String) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Value, A::Error> {
        let mut values = Vec::new();
        while let Some(Unique(value)) = list.next_element()? {
            values.push(value);
        }
        Ok(Value::Array(values))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<Value, A::Error> {
        let mut values = Map::new();
        while let Some(key) = object.next_key::<String>()? {
            if values.contains_key(&key) {
                return Err(A::Error::custom(format!("the key {key:?} is given twice")));
            }
            let Unique(value) = object.next_value()?;
            values.insert(key, value);
        }
        Ok(Value::Object(values))
    }
}
