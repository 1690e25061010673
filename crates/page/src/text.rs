//! Text that is safe to print on a terminal, and padding.

use std::borrow::Cow;

use crate::page::Align;

/// Replaces every character that would control a terminal by a mark; line feeds and tabs are kept.
/// Names and labels may come from untrusted files.
///
/// ```
/// assert_eq!(lcplab_page::text::printable("a\x1b[2Jb\n"), "a\u{fffd}[2Jb\n");
/// ```
pub fn printable(text: &str) -> Cow<'_, str> {
    let turns = |c: char| matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let steers = |c: char| (c.is_control() && c != '\n' && c != '\t') || turns(c);
    match text.contains(steers) {
        true => text.replace(steers, "\u{fffd}").into(),
        false => text.into(),
    }
}

/// The text padded with spaces to a width, which may exceed the limit of a format string, 65535.
pub(crate) fn padded(text: &str, width: usize, align: Align) -> String {
    let space = " ".repeat(width.saturating_sub(text.chars().count()));
    match align {
        Align::Left => format!("{text}{space}"),
        Align::Right => format!("{space}{text}"),
    }
}
