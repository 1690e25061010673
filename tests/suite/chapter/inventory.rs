//! The inventory is complete, and what it names is there.

use std::fs;
use std::path::{Path, PathBuf};

use lcplab::chapter::exhibit::{self, Severity};
use lcplab::chapter::inventory::{Entry, Verdict, all, named};
use lcplab::chapter::{glossary, references};

/// The chapter's numbering: prefix, first and last number, suffix; and what has a name only.
const RANGES: [(&str, u32, u32, &str); 8] = [
    ("(", 1, 45, ")"),
    ("U", 1, 6, ""),
    ("Code ", 1, 11, ""),
    ("Fig ", 1, 13, ""),
    ("N", 1, 9, ""),
    ("T", 1, 65, ""),
    ("D", 1, 11, ""),
    ("W", 1, 12, ""),
];
const NAMES: [&str; 5] = ["class", "method", "operators", "Table 1", "K1"];

#[test]
fn every_number_of_the_chapter_has_one_entry() {
    let range = |(prefix, first, last, suffix): (&str, u32, u32, &str)| {
        let number = |k| format!("{prefix}{k}{suffix}");
        (first..=last).map(number).collect::<Vec<_>>()
    };
    let mut expected: Vec<String> = RANGES.into_iter().flat_map(range).collect();
    expected.extend(NAMES.map(str::to_string));
    let mut found: Vec<String> = all().map(|entry| entry.id.to_string()).collect();
    expected.sort();
    found.sort();
    assert_eq!(found, expected);
}

#[test]
fn an_entry_is_found_by_its_number_however_it_is_written() {
    for (asked, id) in [("(16)", "(16)"), ("16", "(16)"), ("code 6", "Code 6"), ("t20", "T20")] {
        assert_eq!(named(asked).unwrap().1.id, id);
    }
    let error = named("46").unwrap_err().to_string();
    assert!(error.contains("(1) … (45)") && error.contains("T1 … T34"), "{error}");
}

#[test]
fn every_entry_has_code_or_a_reason_and_a_lesson_that_exists() {
    let notebooks = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("notebooks")).unwrap();
    let names = notebooks.map(|file| file.unwrap().file_name().into_string().unwrap());
    let numbers =
        names.filter_map(|name| name.strip_suffix(".md")?.split('_').next()?.parse().ok());
    let lessons: Vec<u8> = numbers.collect();
    for Entry { id, says, code, lesson, remark, .. } in all() {
        assert!(!code.is_empty() || !remark.is_empty(), "{id} has neither code nor a reason");
        assert!(says.ends_with('.'), "{id}: {says}");
        assert!(lesson.iter().all(|k| lessons.contains(k)), "{id}");
        assert!(!lesson.is_empty(), "{id} is taught nowhere");
    }
}

#[test]
fn texts_are_plain() {
    let texts = all().flat_map(|entry| [(&entry.id, &entry.says), (&entry.id, &entry.remark)]);
    let terms = glossary::terms().iter().map(|term| (&term.name, &term.means));
    for (id, text) in texts.chain(terms) {
        assert!(!text.contains(['$', '\\', '`']) && !text.contains("  "), "{id}: {text}");
    }
}

#[test]
fn the_glossary_is_sorted_and_each_definition_is_one_sentence() {
    let terms = glossary::terms();
    assert!(terms.is_sorted_by_key(|term| term.name.to_lowercase()));
    for term in terms {
        let dots = term.means.matches(". ").count();
        assert!(term.means.ends_with('.') && dots == 0, "{}: {}", term.name, term.means);
    }
}

#[test]
fn what_is_named_exists() {
    let entries = all().flat_map(|entry| entry.code.iter().map(|place| (&entry.id, place)));
    let terms = glossary::terms().iter().flat_map(|t| t.code.iter().map(|place| (&t.name, place)));
    let literature = references::subjects().iter().flat_map(|subject| &subject.references);
    let literature = literature.flat_map(|r| r.code.iter().map(|place| (&r.cited, place)));
    let absent: Vec<String> = entries
        .chain(terms)
        .chain(literature)
        .filter(|(_, place)| !exists(place))
        .map(|(id, place)| format!("{id}: {place}"))
        .collect();
    assert!(absent.is_empty(), "{absent:#?}");
}

#[test]
fn a_reference_to_nothing_is_reported() {
    for place in ["lcp::nothing", "nothing", "scene nothing", "lcplab nothing", "lcp::Lcp::nothing"]
    {
        assert!(!exists(place), "{place}");
    }
}

/// Whether there is a module, item, scene, command, test, bench or example of this name.
fn exists(place: &str) -> bool {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    match place.split_once(' ') {
        None => home(root, place).is_some_and(|(folder, rest)| is_declared(&folder, rest)),
        Some(("test", path)) => is_test(root, path),
        Some(("scene", name)) => lcplab::scene::catalogue::text(name).is_some(),
        Some(("bench", name)) => root.join(format!("benches/{name}.rs")).exists(),
        Some(("example", name)) => root.join(format!("examples/{name}.rs")).exists(),
        Some(("lcplab", name)) => {
            let commands = fs::read_to_string(root.join("src/cli/mod.rs")).unwrap();
            commands.contains(&format!("    {}(", pascal(name)))
        }
        Some(_) => false,
    }
}

/// Where the modules of `lcplab` are that have a crate of their own or are part of one; the others
/// are in `src`.
const HOMES: [(&str, &str); 18] = [
    ("files", "files/src"),
    ("lcp", "lcp/src"),
    ("error", "lcp/src"),
    ("solver", "solver/src"),
    ("trace", "solver/src/trace"),
    ("judge", "judge/src"),
    ("reference", "judge/src/reference"),
    ("body", "bodies/src/body"),
    ("constraint", "bodies/src/constraint"),
    ("scene", "mechanics/src/scene"),
    ("assembly", "mechanics/src/assembly"),
    ("formulation", "mechanics/src/formulation"),
    ("simulation", "mechanics/src/simulation"),
    ("document", "page/src/document"),
    ("plot", "page/src/plot"),
    ("hunt", "analysis/src/hunt"),
    ("explain", "analysis/src/explain"),
    ("diagnosis", "analysis/src/diagnosis"),
];

/// In which folder a path is, and what is left of it there.
fn home<'a>(root: &Path, path: &'a str) -> Option<(PathBuf, &'a str)> {
    let within = |module: &str| match path.strip_prefix(module)? {
        "" => Some(""),
        rest => rest.strip_prefix("::"),
    };
    let moved = HOMES.iter().find_map(|(module, folder)| {
        within(module).map(|rest| (root.join("crates").join(folder), rest))
    });
    moved.or_else(|| {
        let (module, rest) = path.split_once("::").unwrap_or((path, ""));
        let folder = root.join("src").join(module);
        folder.is_dir().then_some((folder, rest))
    })
}

/// Whether one of the suites has this test or module; that of a crate may be named before it.
fn is_test(root: &Path, path: &str) -> bool {
    let crates = ["lcp", "solver", "judge", "files", "bodies", "mechanics", "page", "analysis"];
    let within = |name: &str| {
        let suite = root.join("crates").join(name).join("tests/suite");
        let rest = path.strip_prefix(name).and_then(|rest| rest.strip_prefix("::"));
        suite.is_dir() && is_declared(&suite, rest.unwrap_or(path))
    };
    is_declared(&root.join("tests/suite"), path) || crates.into_iter().any(within)
}

/// `mass-ratio` as the name of a variant.
fn pascal(name: &str) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    name.split('-').map(capital).collect()
}

/// Follows a path through folders and files; what is left of it must be declared there.
fn is_declared(root: &Path, path: &str) -> bool {
    let mut place: PathBuf = root.to_path_buf();
    let mut parts = path.split("::").filter(|part| !part.is_empty()).peekable();
    while let Some(part) = parts.peek() {
        let (folder, file) = (place.join(part), place.join(format!("{part}.rs")));
        if folder.is_dir() {
            place = folder;
        } else if file.is_file() {
            place = file;
        } else {
            break;
        }
        parts.next();
    }
    let text = if place.is_dir() { text_of(&place) } else { fs::read_to_string(&place).unwrap() };
    parts.all(|name| declares(&text, name))
}

/// The files of a folder, not of those in it.
fn text_of(folder: &Path) -> String {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let sources = files.filter(|path| path.extension().is_some_and(|e| e == "rs"));
    sources.map(|path| fs::read_to_string(path).unwrap()).collect()
}

fn declares(text: &str, name: &str) -> bool {
    ["fn", "struct", "enum", "trait", "const", "mod", "type"].iter().any(|kind| {
        let start = format!("{kind} {name}");
        text.match_indices(&start).any(|(at, _)| {
            let after = text[at + start.len()..].chars().next();
            after.is_none_or(|c| !c.is_alphanumeric() && c != '_')
        })
    })
}

/// E01 to E67, written out as in the errata.
fn numbers() -> Vec<String> {
    (1..=67).map(|k| format!("E{k:02}")).collect()
}

#[test]
fn every_erratum_is_named_by_an_entry() {
    let mut named: Vec<&str> =
        all().flat_map(|entry| entry.errata.iter().map(String::as_str)).collect();
    named.sort();
    named.dedup();
    assert_eq!(named, numbers());
    for entry in all() {
        assert!(entry.errata.is_sorted(), "{}", entry.id);
        let is_faulty = severity(entry.verdict).is_some();
        assert!(!is_faulty || !entry.errata.is_empty(), "{} is said to err; where?", entry.id);
    }
}

/// The severity that a verdict speaks of.
fn severity(verdict: Verdict) -> Option<u8> {
    match verdict {
        Verdict::Misprint => Some(0),
        Verdict::Misleading => Some(1),
        Verdict::Wrong => Some(2),
        _ => None,
    }
}

/// The exhibits are the errata, and no entry is called worse than the worst of its exhibits.
#[test]
fn every_erratum_has_its_exhibit() {
    let exhibits: Vec<&str> = exhibit::all().iter().map(|exhibit| exhibit.id.as_str()).collect();
    assert_eq!(exhibits, numbers());
    let rank = |id: &String| match exhibit::named(id).unwrap().severity {
        Severity::Misprint => 0,
        Severity::Misleading => 1,
        Severity::Wrong => 2,
    };
    for entry in all() {
        let worst = entry.errata.iter().map(rank).max();
        assert!(severity(entry.verdict) <= worst, "{}: {}", entry.id, entry.verdict.word());
    }
}
