//! The phrases of `words.txt` stay out of the documentation and of the texts that lcplab prints.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

const PHRASES: &str = include_str!("words.txt");

fn phrases() -> impl Iterator<Item = &'static str> {
    PHRASES.lines().filter(|line| !line.is_empty() && !line.starts_with('#'))
}

/// The files below a folder with this extension.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() && !path.ends_with("target") {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|own| own == extension) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The string literals of a Rust source, without those in comments; a line break is a space.
fn literals(source: &str) -> Vec<String> {
    let mut texts = Vec::new();
    let mut rest = source;
    while let Some(at) = rest.find(['"', '/', '\'']) {
        let is_raw = rest[..at].ends_with('r') || rest[..at].ends_with("r#");
        let hashes = if rest[..at].ends_with("r#") { "\"#" } else { "\"" };
        rest = &rest[at..];
        if rest.starts_with("//") {
            rest = rest.split_once('\n').map_or("", |(_, after)| after);
        } else if let Some(after) = rest.strip_prefix("'\"'") {
            rest = after;
        } else if rest.starts_with("'\\") {
            let after = rest.get(3..).and_then(|rest| rest.split_once('\''));
            rest = after.map_or("", |(_, after)| after);
        } else if rest.starts_with('"') && is_raw {
            let (text, after) = rest[1..].split_once(hashes).unwrap_or((&rest[1..], ""));
            texts.push(text.to_string());
            rest = after;
        } else if let Some(text) = rest.strip_prefix('"') {
            let end = end_of_literal(text);
            texts.push(text[..end].replace("\\\n", " ").replace("\\n", " "));
            rest = text.get(end + 1..).unwrap_or("");
        } else {
            rest = &rest[1..];
        }
    }
    texts
}

/// The doc comments of a Rust source, each as one line: clap prints those of commands and options
/// as help.
fn doc_comments(source: &str) -> Vec<String> {
    let mut texts = vec![String::new()];
    for line in source.lines() {
        match line.trim_start().strip_prefix("///") {
            Some(text) => *texts.last_mut().unwrap() += text,
            None => texts.push(String::new()),
        }
    }
    texts
}

/// Where a literal ends: at the first quote without a backslash before it.
fn end_of_literal(text: &str) -> usize {
    let mut is_escaped = false;
    for (at, letter) in text.char_indices() {
        match letter {
            '"' if !is_escaped => return at,
            '\\' => is_escaped = !is_escaped,
            _ => is_escaped = false,
        }
    }
    text.len()
}

/// The words of a text in lower case, each between spaces.
fn plain_words(text: &str) -> String {
    let letters = |letter: char| if letter.is_alphanumeric() { letter } else { ' ' };
    let plain: String = text.to_lowercase().chars().map(letters).collect();
    format!(" {} ", plain.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// The phrases in a text, as whole words in any case.
fn found(text: &str) -> Vec<&'static str> {
    static PLAIN: LazyLock<Vec<(&str, String)>> =
        LazyLock::new(|| phrases().map(|phrase| (phrase, plain_words(phrase))).collect());
    let text = plain_words(text);
    let hits = PLAIN.iter().filter(|(_, plain)| text.contains(plain));
    hits.map(|(phrase, _)| *phrase).collect()
}

#[test]
fn a_phrase_is_found_across_lines_in_any_case_but_not_in_a_comment() {
    let source =
        "// nobody\nlet a = \"So \\\n   many rows\"; let b = '\"'; let c = r\"held\nagainst\";";
    let texts = literals(source);
    let hits: Vec<&str> = texts.iter().flat_map(|text| found(text)).collect();
    assert_eq!(hits, ["so many", "held against"]);
    assert!(found("not someones, for everyone").is_empty());
}

#[test]
fn a_phrase_is_found_in_a_doc_comment_of_several_lines() {
    let source = "    /// Not so\n    /// many rows\n    rows: usize,\n    // so many\n";
    let hits: Vec<&str> = doc_comments(source).iter().flat_map(|text| found(text)).collect();
    assert_eq!(hits, ["so many"]);
}

#[test]
fn the_documentation_has_none_of_the_phrases() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages = files(&root.join("docs"), "md");
    pages.extend(
        ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md"].map(|name| root.join(name)),
    );
    for page in pages {
        assert_eq!(found(&fs::read_to_string(&page).unwrap()), [""; 0], "{}", page.display());
    }
}

#[test]
fn the_help_and_the_messages_of_the_command_line_have_none_of_the_phrases() {
    for path in files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src/cli"), "rs") {
        let source = fs::read_to_string(&path).unwrap();
        for text in literals(&source).iter().chain(&doc_comments(&source)) {
            assert_eq!(found(text), [""; 0], "{}: {text}", path.display());
        }
    }
}

#[test]
fn what_the_library_and_its_reports_print_has_none_of_the_phrases() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut sources = files(&root.join("src"), "rs");
    for folder in fs::read_dir(root.join("crates")).unwrap() {
        sources.extend(files(&folder.unwrap().path().join("src"), "rs"));
    }
    for source in sources {
        for text in literals(&fs::read_to_string(&source).unwrap()) {
            assert_eq!(found(&text), [""; 0], "{}: {text}", source.display());
        }
    }
}

/// The comments of a Rust source, also those after code, with consecutive lines as one text.
fn comments(source: &str) -> Vec<String> {
    let mut texts = vec![String::new()];
    for line in source.lines() {
        let text = line.trim_start();
        let whole = ["///", "//!", "//"].iter().find_map(|mark| text.strip_prefix(mark));
        match (whole, text.split_once(" // ")) {
            (Some(comment), _) => *texts.last_mut().unwrap() += comment,
            (None, Some((_, comment))) => texts.extend([comment.to_string(), String::new()]),
            (None, None) => texts.push(String::new()),
        }
    }
    texts
}

#[test]
fn comments_have_none_of_the_phrases() {
    let hits = |source: &str| -> Vec<&str> {
        comments(source).iter().flat_map(|text| found(text)).collect()
    };
    assert_eq!(
        hits("// not so\n// many\nlet a = 1; // nobody\n\"held against\""),
        ["so many", "nobody"]
    );
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = [
        "src",
        "crates/bodies",
        "crates/page",
        "crates/plugin",
        "crates/lcp",
        "crates/solver",
        "live/src",
        "live/tests",
        "python/src",
        "examples",
        "benches",
        "tests/browser",
        "tests/support",
        "tests/suite/chapter",
        "tests/suite/cli",
        "tests/suite/animation",
        "tests/suite/lesson",
        "tests/suite/messages",
        "tests/suite/report",
        "tests/suite/storage",
    ];
    for path in folders.iter().flat_map(|folder| files(&root.join(folder), "rs")) {
        assert_eq!(hits(&fs::read_to_string(&path).unwrap()), [""; 0], "{}", path.display());
    }
}

/// The comment lines of a Rust source that are longer than 100 columns, without tables and blocks
/// of code or formulas.
fn wide_comments(source: &str) -> Vec<&str> {
    let mut is_block = false;
    let mut wide = Vec::new();
    for line in source.lines() {
        let text = line.trim_start();
        let prose = ["///", "//!", "//"].iter().find_map(|mark| text.strip_prefix(mark));
        let Some(prose) = prose.map(str::trim_start) else {
            is_block = false;
            continue;
        };
        if prose.starts_with("```") {
            is_block = !is_block;
        } else if !is_block && !prose.starts_with('|') && line.chars().count() > 100 {
            wide.push(line);
        }
    }
    wide
}

#[test]
fn prose_in_comments_has_at_most_100_columns() {
    let long = format!("/// {}", "word ".repeat(20));
    let source = format!("{long}\n/// ```\n{long}\n/// ```\n{}", long.replace("/// w", "// | w"));
    assert_eq!(wide_comments(&source), [long.as_str()]);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut wide = Vec::new();
    for folder in ["src", "crates", "tests", "benches", "live", "examples", "python/src"] {
        for path in files(&root.join(folder), "rs") {
            let source = fs::read_to_string(&path).unwrap();
            let place = |line| format!("{}: {line}", path.display());
            wide.extend(wide_comments(&source).into_iter().map(place));
        }
    }
    assert!(wide.is_empty(), "{wide:#?}");
}
