//! Readable numbers: `1.3×10⁻⁸`, `−0.25`; and numbers as files contain them.
//!
//! ```
//! use lcplab_lcp::number::{count, significant, superscript};
//!
//! assert_eq!(superscript(-8), "⁻⁸");
//! assert_eq!(significant(3e-8, 2), "3.0×10⁻⁸");
//! assert_eq!(count(1_234_567), "1,234,567");
//! ```

use std::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The exponent in superscript digits: −8 gives `⁻⁸`.
pub fn superscript(exponent: i32) -> String {
    let raise = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    exponent.to_string().chars().map(raise).collect()
}

/// The digit or sign that a superscript character stands for.
fn lowered(c: char) -> Option<char> {
    match c {
        '⁻' => Some('-'),
        '⁰' => Some('0'),
        '¹' => Some('1'),
        '²' => Some('2'),
        '³' => Some('3'),
        '⁴'..='⁹' => char::from_digit(c as u32 - '⁰' as u32, 10),
        _ => None,
    }
}

/// A text with its powers of ten written as programs read them: `1.3×10⁻⁸` becomes `1.3e-8`. A
/// number that stands in a column, after two spaces, keeps its width.
///
/// ```
/// use lcplab_lcp::number::plain;
///
/// assert_eq!(plain("10⁻⁸ m and −1.5×10⁻⁹ m"), "1e-8 m and −1.5e-9 m");
/// assert_eq!(plain("gap   2.2×10⁻⁸  m"), "gap     2.2e-8  m");
/// assert_eq!(plain("10 steps, 2·210⁴"), "10 steps, 2·210⁴");
/// ```
pub fn plain(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("10") {
        out.push_str(before);
        let exponent: String = after.chars().map_while(lowered).collect();
        let is_inside = out.ends_with(|c: char| c.is_alphanumeric() || c == '.' || c == ',');
        if exponent.is_empty() || is_inside {
            out.push_str("10");
            rest = after;
            continue;
        }
        rest = after.trim_start_matches(|c: char| lowered(c).is_some());
        if out.ends_with('×') {
            out.pop();
            let start = out.rfind([' ', '\n']).map_or(0, |at| at + 1);
            if out[..start].ends_with("  ") {
                out.insert_str(start, "  ");
            }
            out.push('e');
        } else {
            out.push_str("1e");
        }
        out.push_str(&exponent);
    }
    out + rest
}

/// The value with at most `digits` significant digits, without trailing zeros: as a plain number if
/// that is short, otherwise as mantissa times power of ten.
///
/// ```
/// use lcplab_lcp::number::readable;
///
/// assert_eq!(readable(0.25, 3), "0.25");
/// assert_eq!(readable(-1.5e-9, 2), "−1.5×10⁻⁹");
/// assert_eq!(readable(1e6, 3), "10⁶");
/// assert_eq!(readable(12345.0, 3), "12,300");
/// assert_eq!(readable(725.0, 2), "720"); // ties to even, as everywhere
/// assert_eq!(readable(f64::INFINITY, 3), "∞");
/// ```
pub fn readable(value: f64, digits: usize) -> String {
    written(value, digits, |_, text| trimmed(text))
}

/// [`readable`] with all significant digits, so that numbers can be compared: `3.0×10⁻⁸`.
pub fn significant(value: f64, digits: usize) -> String {
    written(value, digits, |_, text| text)
}

/// [`readable`] for the cells of a table: trailing zeros are omitted only if the number itself has
/// no more digits.
///
/// ```
/// use lcplab_lcp::number::tabular;
///
/// assert_eq!(tabular(0.2999999, 3), "0.300");
/// assert_eq!(tabular(0.3, 3), "0.3");
/// assert_eq!(tabular(1.0, 3), "1");
/// ```
pub fn tabular(value: f64, digits: usize) -> String {
    written(value, digits, |value, text| {
        let short = trimmed(text);
        let is_all = short.parse().is_ok_and(|all: f64| (all - value).abs() <= SAME * value.abs());
        if is_all { short } else { text }
    })
}

/// Numbers with at most this relative difference count as equal, because rounding explains it.
const SAME: f64 = 1e-11;

/// The value as text; `shorter` selects the part of its decimal form to print.
fn written(value: f64, digits: usize, shorter: fn(f64, &str) -> &str) -> String {
    if value.is_nan() {
        return "not a number".into();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞" } else { "−∞" }.into();
    }
    let rounded = format!("{:.*e}", digits.max(1) - 1, value);
    let (mantissa, exponent) = rounded.split_once('e').unwrap_or((&rounded, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let text = if value == 0.0 {
        "0".into()
    } else if (-3..5).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        let unit = 10f64.powi(exponent + 1 - digits.max(1) as i32);
        let value = if decimals == 0 { (value / unit).round_ties_even() * unit } else { value };
        grouped(shorter(value, &format!("{value:.decimals$}")))
    } else {
        match shorter(value / 10f64.powi(exponent), mantissa) {
            "1" => format!("10{}", superscript(exponent)),
            "-1" => format!("-10{}", superscript(exponent)),
            mantissa => format!("{mantissa}×10{}", superscript(exponent)),
        }
    };
    text.replace('-', "−")
}

/// A count with commas between groups of three digits.
pub fn count(value: usize) -> String {
    grouped(&value.to_string())
}

/// A number of things: `1 sweep`, `1,200 sweeps`.
///
/// ```
/// use lcplab_lcp::number::counted;
///
/// assert_eq!(counted(1, "sweep"), "1 sweep");
/// assert_eq!(counted(1200, "entry"), "1,200 entries");
/// ```
pub fn counted(number: usize, noun: &str) -> String {
    match noun.strip_suffix('y') {
        _ if number == 1 => format!("{number} {noun}"),
        Some(stem) => format!("{} {stem}ies", count(number)),
        None => format!("{} {noun}s", count(number)),
    }
}

/// The text with a capital first letter, unless it begins with a symbol, such as x.
///
/// ```
/// use lcplab_lcp::number::capitalized;
///
/// assert_eq!(capitalized("a sweep"), "A sweep");
/// assert_eq!(capitalized("x is not finite"), "x is not finite");
/// ```
pub fn capitalized(text: &str) -> String {
    let is_symbol = text.chars().nth(1).is_none_or(|second| !second.is_alphabetic());
    if is_symbol && !text.starts_with("a ") {
        return text.into();
    }
    let mut letters = text.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
}

/// A decimal number with a comma between groups of three digits before the point.
fn grouped(decimal: &str) -> String {
    let whole = decimal.find('.').unwrap_or(decimal.len());
    let mut text = String::new();
    for (i, digit) in decimal.char_indices() {
        let is_between = i > 0 && i < whole && decimal.as_bytes()[i - 1].is_ascii_digit();
        if is_between && (whole - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

fn trimmed(decimal: &str) -> &str {
    if decimal.contains('.') {
        decimal.trim_end_matches('0').trim_end_matches('.')
    } else {
        decimal
    }
}

/// A number as files contain it: JSON has no infinities and no NaN, so they are the words "inf",
/// "-inf" and "nan".
///
/// ```
/// use lcplab_lcp::number::Filed;
///
/// let text = serde_json::to_string(&[0.5, f64::INFINITY].map(Filed)).unwrap();
/// assert_eq!(text, r#"[0.5,"inf"]"#);
/// let back: Vec<Filed> = serde_json::from_str(&text).unwrap();
/// assert_eq!(back, [Filed(0.5), Filed(f64::INFINITY)]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filed(pub f64);

impl Filed {
    /// The word for a number that JSON does not have.
    pub(crate) fn word(self) -> Option<&'static str> {
        match self.0 {
            value if value.is_finite() => None,
            value if value.is_nan() => Some("nan"),
            value => Some(if value > 0.0 { "inf" } else { "-inf" }),
        }
    }

    /// The number that a word means.
    pub(crate) fn of_word(word: &str) -> Option<Self> {
        match word {
            "inf" | "+inf" => Some(Filed(f64::INFINITY)),
            "-inf" => Some(Filed(f64::NEG_INFINITY)),
            "nan" => Some(Filed(f64::NAN)),
            _ => None,
        }
    }
}

impl Serialize for Filed {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.word() {
            Some(word) => serializer.serialize_str(word),
            None => serializer.serialize_f64(self.0),
        }
    }
}

impl<'de> Deserialize<'de> for Filed {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FiledVisitor)
    }
}

struct FiledVisitor;

impl serde::de::Visitor<'_> for FiledVisitor {
    type Value = Filed;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, \"inf\", \"-inf\" or \"nan\"")
    }

    fn visit_f64<E>(self, value: f64) -> Result<Filed, E> {
        Ok(Filed(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Filed, E> {
        Ok(Filed(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Filed, E> {
        Ok(Filed(value as f64))
    }

    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<Filed, E> {
        Filed::of_word(word)
            .ok_or_else(|| E::invalid_value(serde::de::Unexpected::Str(word), &self))
    }
}
