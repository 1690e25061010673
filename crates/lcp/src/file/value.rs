//! JSON values of problem files: numbers, and words for infinities and NaN.

use serde_json::{Map, Value, json};

use crate::error::Defects;
use crate::number::Filed;

/// A number as JSON: infinities and NaN become the words "inf", "-inf" and "nan".
///
/// ```
/// use lcplab_lcp::file::{as_number, number};
/// use serde_json::json;
///
/// assert_eq!(number(f64::INFINITY), json!("inf")); // JSON has no infinities
/// assert_eq!(as_number(&json!("-inf")), Some(f64::NEG_INFINITY));
/// assert_eq!(as_number(&json!(0.5)), Some(0.5));
/// assert_eq!(as_number(&json!("half")), None);
/// ```
pub fn number(value: f64) -> Value {
    Filed(value).word().map_or_else(|| json!(value), |word| json!(word))
}

/// The value of a JSON number, or of one of the words "inf", "-inf" and "nan".
pub fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => number.as_f64(),
        Value::String(word) => Filed::of_word(word).map(|number| number.0),
        _ => None,
    }
}

/// The list of numbers under a key, if present.
pub(super) fn numbers(
    object: &Map<String, Value>,
    key: &str,
    defects: &mut Defects,
) -> Option<Vec<f64>> {
    let Value::Array(values) = object.get(key)? else {
        defects.add(key, "must be a list of numbers");
        return None;
    };
    let number = |(i, value): (usize, &Value)| {
        as_number(value).unwrap_or_else(|| {
            defects.add(format!("{key}[{i}]"), format!("must be a number, is {}", brief(value)));
            0.0
        })
    };
    Some(values.iter().enumerate().map(number).collect())
}

/// A value for an error message, shortened.
pub(super) fn brief(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() <= 40 {
        return text;
    }
    text.chars().take(37).chain("...".chars()).collect()
}
