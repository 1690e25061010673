//! Escapes text for HTML and XML.

/// Text with all special characters of HTML escaped.
pub(crate) fn html(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

/// A line of text for XML: special characters are escaped, control characters removed.
///
/// ```
/// assert_eq!(lcplab_page::escape::xml_line("w < 0\nin row 1"), "w &lt; 0 in row 1");
/// ```
pub fn xml_line(text: &str) -> String {
    xml_text(&text.replace(['\t', '\n', '\r'], " "))
}

/// A text for XML that keeps its line breaks: special characters are escaped, other control
/// characters removed.
///
/// ```
/// assert_eq!(lcplab_page::escape::xml_text("a < b\n\u{7}c & d"), "a &lt; b\nc &amp; d");
/// ```
pub fn xml_text(text: &str) -> String {
    let is_allowed =
        |c: &char| (*c == '\n' || !c.is_control()) && !matches!(c, '\u{fffe}' | '\u{ffff}');
    html(&text.chars().filter(is_allowed).collect::<String>())
}
