//! Listings on a page: keywords, strings, numbers and comments are colored, and leading imports are
//! collapsed.

use crate::escape::html;

/// Keywords of Rust.
const RUST: [&str; 31] = [
    "as", "break", "const", "continue", "crate", "dyn", "else", "enum", "false", "fn", "for", "if",
    "impl", "in", "let", "loop", "match", "mod", "move", "mut", "pub", "ref", "return", "self",
    "static", "struct", "trait", "true", "use", "where", "while",
];

/// Keywords of Python.
const PYTHON: [&str; 29] = [
    "False", "None", "True", "and", "as", "assert", "break", "class", "continue", "def", "del",
    "elif", "else", "except", "for", "from", "if", "import", "in", "is", "lambda", "not", "or",
    "pass", "raise", "return", "while", "with", "yield",
];

/// Fewer lines of imports are not collapsed.
const FEW: usize = 2;

/// A listing; one in an unknown language is not colored.
pub(super) fn code(language: &str, text: &str) -> String {
    let text = text.trim_end();
    let imports = imports(language, text);
    let rest = text[imports..].trim_start_matches('\n');
    if text[..imports].lines().count() < FEW || rest.is_empty() {
        return listing(language, text);
    }
    let imports = listing(language, text[..imports].trim_end());
    format!(
        "<details class=\"imports\"><summary>imports</summary>{imports}</details>{}",
        listing(language, rest)
    )
}

fn listing(language: &str, text: &str) -> String {
    let name = html(language);
    format!(
        "<pre tabindex=\"0\"><code class=\"language-{name}\">{}</code></pre>\n",
        colored(language, text)
    )
}

/// The length in bytes of the imports at the beginning.
fn imports(language: &str, text: &str) -> usize {
    let starts: &[&str] = match language {
        "rust" => &["use "],
        "python" => &["import ", "from "],
        _ => return 0,
    };
    let (mut end, mut is_open) = (0, false);
    for line in text.split_inclusive('\n') {
        if !is_open && !starts.iter().any(|start| line.starts_with(start)) {
            break;
        }
        end += line.len();
        is_open = match language {
            "rust" => !line.trim_end().ends_with(';'),
            _ => line.trim_end().ends_with('(') || (is_open && !line.trim_end().ends_with(')')),
        };
    }
    end
}

/// Code with a span around each colored piece.
fn colored(language: &str, text: &str) -> String {
    let (words, comment): (&[&str], &str) = match language {
        "rust" => (&RUST, "//"),
        "python" => (&PYTHON, "#"),
        _ => return html(text),
    };
    let (mut out, mut rest) = (String::new(), text);
    while let Some(first) = rest.chars().next() {
        let length_while = |is_in: fn(char) -> bool| rest.find(|c| !is_in(c)).unwrap_or(rest.len());
        let (class, length) = if rest.starts_with(comment) {
            ("comment", rest.find('\n').unwrap_or(rest.len()))
        } else if first == '"' || (first == '\'' && language == "python") {
            ("text", quoted(rest, first))
        } else if first.is_ascii_digit() {
            ("number", length_while(|c| c.is_ascii_alphanumeric() || c == '_' || c == '.'))
        } else if first.is_alphabetic() || first == '_' {
            let length = length_while(|c| c.is_alphanumeric() || c == '_');
            (if words.contains(&&rest[..length]) { "word" } else { "" }, length)
        } else {
            ("", first.len_utf8())
        };
        let piece = html(&rest[..length]);
        match class {
            "" => out += &piece,
            class => out += &format!("<span class=\"{class}\">{piece}</span>"),
        }
        rest = &rest[length..];
    }
    out
}

/// The length of a string literal; if it is not closed, that of the quotation mark.
fn quoted(text: &str, mark: char) -> usize {
    let mut is_escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            c if c == mark => return at + c.len_utf8(),
            _ => {}
        }
    }
    mark.len_utf8()
}
