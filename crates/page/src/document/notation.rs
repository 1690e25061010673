//! The notation of numbers, indices and vectors.
//!
//! ```
//! use lcplab_page::document::notation::{bracketed, exact, indexed, interval, plain};
//! use lcplab_page::document::notation::{set, settled, sum, vector};
//!
//! assert_eq!((plain(-0.25), indexed("x", 12)), ("−0.25".to_string(), "x₁₂".to_string()));
//! assert_eq!((vector(&[4.0, 3.0, 1.0]), set(&[2, 0])), ("(4, 3, 1)".into(), "{0, 2}".into()));
//! assert_eq!(sum(&[(2.0, 4.0), (-1.0, 3.0)], -1.0, 4.0), "2·4 − 1·3 − 1 = 4");
//! assert_eq!([exact(-1.0 / 3.0), exact(0.5), exact(0.35)], ["−1/3", "1/2", "0.35"]);
//! assert_eq!(settled(&[1e-17, 2.0], &[1.0, 2.0]), [0.0, 2.0]); // a rounding error is 0
//! assert_eq!((bracketed(-2.0), interval(0.0, f64::INFINITY)), ("(−2)".into(), "[0, ∞)".into()));
//! ```

use super::SHOWN;
use crate::number::readable;

/// Significant digits.
const DIGITS: usize = 6;
/// The number of terms of a sum that are written out.
const TERMS: usize = 6;
/// A smaller part of a number is rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// The largest divisor of a fraction that is written, and of one whose decimals end soon.
const LARGEST_DIVISOR: u32 = 99;
const HALVES: u32 = 4;

/// A number for display: `−0.25`, `1.5×10⁻⁹`, `∞`.
pub fn plain(value: f64) -> String {
    readable(value, DIGITS)
}

/// A fraction of small integers, up to rounding, as that fraction, unless its decimals end soon and
/// its divisor is above 4: `1/3`, `1/2`, `0.35`.
pub fn exact(value: f64) -> String {
    let decimal = plain(value);
    let ends = decimal.chars().filter(char::is_ascii_digit).count() < DIGITS;
    let is_fraction = |q: &u32| {
        let p = value * f64::from(*q);
        p.round() != 0.0 && (p - p.round()).abs() <= ROUNDING * p.abs()
    };
    match (1..=LARGEST_DIVISOR).find(is_fraction).filter(|&q| q > 1 && (!ends || q <= HALVES)) {
        Some(q) => format!("{}/{q}", plain((value * f64::from(q)).round())),
        None => decimal,
    }
}

/// The values, with 0 for those that are rounding errors of terms of these sizes.
pub fn settled(values: &[f64], sizes: &[f64]) -> Vec<f64> {
    let settle = |(&value, &size): (&f64, &f64)| match value.abs() <= ROUNDING * size {
        true => 0.0,
        false => value,
    };
    values.iter().zip(sizes).map(settle).collect()
}

/// The number in LaTeX.
pub(crate) fn latex(value: f64) -> String {
    let text = plain(value).replace('−', "-").replace('∞', "\\infty").replace(',', "{,}");
    let Some(at) = text.rfind("10").filter(|&at| text[at + 2..].chars().any(is_raised)) else {
        return text;
    };
    let (mantissa, power) = text.split_at(at);
    let exponent: String = power[2..].chars().map(lowered).collect();
    format!("{}10^{{{exponent}}}", mantissa.replace('×', "\\times "))
}

fn is_raised(c: char) -> bool {
    "⁰¹²³⁴⁵⁶⁷⁸⁹⁻".contains(c)
}

fn lowered(c: char) -> char {
    let digits = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|raised| raised == c);
    digits.and_then(|k| char::from_digit(k as u32, 10)).unwrap_or('-')
}

/// A name with an index: `x₁₂`.
pub fn indexed(name: &str, index: usize) -> String {
    let lower = |c: char| char::from_u32('₀' as u32 + c as u32 - '0' as u32).unwrap_or(c);
    name.to_string() + &index.to_string().chars().map(lower).collect::<String>()
}

/// A vector on one line: `(4, 3, 1)`; a long one is shortened.
pub fn vector(values: &[f64]) -> String {
    let shown: Vec<String> = values.iter().take(SHOWN).map(|&value| plain(value)).collect();
    let more = if values.len() > SHOWN { ", …" } else { "" };
    format!("({}{more})", shown.join(", "))
}

/// A set of rows: `{0, 2}`.
pub fn set(rows: &[usize]) -> String {
    let mut rows = rows.to_vec();
    rows.sort_unstable();
    let shown: Vec<String> = rows.iter().take(SHOWN).map(usize::to_string).collect();
    let more = if rows.len() > SHOWN { ", …" } else { "" };
    format!("{{{}{more}}}", shown.join(", "))
}

/// A sum of products and a last term with its value: `2·4 − 1·3 − 1 = 4`. Terms whose first factor
/// is 0 are omitted, and a long sum combines its last products: `2·4 + 5 (3 more) − 1 = 12`.
pub fn sum(products: &[(f64, f64)], last: f64, value: f64) -> String {
    let terms: Vec<(f64, f64)> = products.iter().copied().filter(|(a, _)| *a != 0.0).collect();
    let (written, rest) = terms.split_at(terms.len().min(TERMS));
    let rest_sum: f64 = rest.iter().map(|(a, x)| a * x).sum();
    let more = (!rest.is_empty()).then(|| format!("{} ({} more)", plain(rest_sum), rest.len()));
    let written = written.iter().map(|&(a, x)| format!("{}·{}", plain(a), bracketed(x)));
    let mut text = String::new();
    for term in written.chain(more).chain([plain(last)]) {
        match (text.is_empty(), term.strip_prefix('−')) {
            (true, _) => text += &term,
            (false, Some(size)) => text += &format!(" − {size}"),
            (false, None) => text += &format!(" + {term}"),
        }
    }
    format!("{text} = {}", plain(value))
}

/// A number as a factor or divisor: in brackets if negative.
pub fn bracketed(value: f64) -> String {
    let text = plain(value);
    if text.starts_with('−') { format!("({text})") } else { text }
}

/// An interval: `[0, ∞)`.
pub fn interval(lo: f64, hi: f64) -> String {
    let (open, close) =
        (if lo.is_finite() { "[" } else { "(" }, if hi.is_finite() { "]" } else { ")" });
    format!("{open}{}, {}{close}", plain(lo), plain(hi))
}
