//! Escapes text for HTML and XML, and keeps units with their numbers.

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

/// Units that stay with their number, and signs that stay with both sides.
const UNITS: &str = "% ° m mm µm km s ms µs kg g N kN J kJ W Hz rad px kB MB GB";
pub(crate) const SIGNS: [&str; 11] =
    ["=", "≥", "≤", "≈", ">", "<", "&gt;", "&lt;", "&#62;", "&#60;", "±"];

/// Whether each word is a unit after a number or in brackets, as all of `2 N s` and `(N s)`.
pub(crate) fn units(words: &[&str]) -> Vec<bool> {
    let is_number = |c: char| c.is_ascii_digit() || "⁰¹²³⁴⁵⁶⁷⁸⁹∞".contains(c);
    let is_unit = |word: &str| {
        let word = word.trim_end_matches("&nbsp;").trim_end_matches([',', ';', '.', ':', ')', ']']);
        let mut parts = word.split('/').map(|part| part.trim_end_matches(['²', '³', '⁻', '¹']));
        parts.all(|part| UNITS.split(' ').any(|own| own == part))
    };
    let mut units = vec![false; words.len()];
    for k in 1..words.len() {
        let before = words[k - 1];
        let is_after = units[k - 1]
            || before.trim_end_matches(')').ends_with(is_number)
            || before.strip_prefix('(').is_some_and(is_unit);
        units[k] = is_after && is_unit(words[k]);
    }
    units
}

/// The text with no-break spaces between numbers and units, and around relations.
///
/// ```
/// assert_eq!(lcplab_page::escape::unbroken("x = 2 N s or 5 %"), "x\u{a0}=\u{a0}2\u{a0}N\u{a0}s or 5\u{a0}%");
/// ```
pub fn unbroken(text: &str) -> String {
    let is_space = |c: char| c == ' ' || c == '\n';
    let words: Vec<&str> = text.split(is_space).collect();
    let (units, is_sign) = (units(&words), |k: usize| SIGNS.contains(&words[k]));
    let mut out = String::with_capacity(text.len());
    for (k, space) in (1..).zip(text.matches(is_space)) {
        out += words[k - 1];
        out += if units[k] || is_sign(k - 1) || is_sign(k) { "\u{a0}" } else { space };
    }
    out + words.last().copied().unwrap_or_default()
}

/// Elements whose text stays as it is.
const VERBATIM: [&str; 6] = ["script", "style", "pre", "code", "svg", "textarea"];

/// The page with [`unbroken`] text.
///
/// ```
/// use lcplab_page::escape::with_bound_units;
///
/// let html = with_bound_units("<p>w ≥ 2 m/s</p><pre>w ≥ 2 m/s</pre>");
/// assert_eq!(html, "<p>w\u{a0}≥\u{a0}2\u{a0}m/s</p><pre>w ≥ 2 m/s</pre>");
/// ```
pub fn with_bound_units(html: &str) -> String {
    let mut out = String::with_capacity(html.len());
    let mut rest = html;
    while let Some(at) = rest.find('<') {
        out += &unbroken(&rest[..at]);
        rest = &rest[at..];
        let name = VERBATIM.iter().find(|name| {
            let after = rest[1..].strip_prefix(*name);
            after.is_some_and(|after| after.starts_with([' ', '>']))
        });
        let end = name.map_or(">".into(), |name| format!("</{name}>"));
        let length = rest.find(&end).map_or(rest.len(), |at| at + end.len());
        out += &rest[..length];
        rest = &rest[length..];
    }
    out + &unbroken(rest)
}
