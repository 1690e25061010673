//! Comma-separated values (RFC 4180, with line feeds alone).

/// Appends one record; a field with a comma, quote or line break is quoted.
pub fn record<I>(out: &mut String, fields: I)
where
    I: IntoIterator,
    I::Item: AsRef<str>,
{
    for (i, field) in fields.into_iter().enumerate() {
        let field = field.as_ref();
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

/// The shortest decimal that reads back as the same number; `nan`, `inf`, `-inf` otherwise.
pub fn number(value: f64) -> String {
    let text = format!("{value:?}").to_lowercase();
    text.strip_suffix(".0").map_or(text.clone(), str::to_string)
}
