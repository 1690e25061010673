//! Writes comma-separated values (RFC 4180, with line feeds only).
//!
//! ```
//! use lcplab_page::csv::{number, record};
//!
//! let mut file = String::new();
//! record(&mut file, ["t (s)", "a, b", "=1+1"]);
//! assert_eq!(file, "t (s),\"a, b\",'=1+1\n"); // quoted, and not a formula for a spreadsheet
//! assert_eq!((number(2.0), number(f64::INFINITY)), ("2".to_string(), "inf".to_string()));
//! ```

/// Appends one record. A field with a comma, quote or line break is quoted; a field that a
/// spreadsheet would evaluate as a formula gets a leading apostrophe.
pub fn record<I>(out: &mut String, fields: I)
where
    I: IntoIterator,
    I::Item: AsRef<str>,
{
    for (i, field) in fields.into_iter().enumerate() {
        let field = field.as_ref();
        let field = if is_formula(field) { &format!("'{field}") } else { field };
        if i > 0 {
            out.push(',');
        }
        if field.contains([',', '"', '\n', '\r']) {
            out.push_str(&format!("\"{}\"", field.replace('"', "\"\"")));
        } else {
            out.push_str(field);
        }
    }
    out.push('\n');
}

/// Whether a spreadsheet may evaluate the field: it starts like a formula and is not a number.
fn is_formula(field: &str) -> bool {
    field.starts_with(['=', '+', '-', '@', '\t', '\r']) && field.parse::<f64>().is_err()
}

/// The shortest decimal that is read back as the same number; `nan`, `inf` or `-inf` otherwise.
pub fn number(value: f64) -> String {
    let text = format!("{value:?}").to_lowercase();
    text.strip_suffix(".0").map_or(text.clone(), str::to_string)
}
