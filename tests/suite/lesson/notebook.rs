//! The lessons as notebooks and as pages.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use lcplab::lesson::source::{Part, Source};
use serde_json::{Map, Value, json};

use super::{pages, run, written};

fn notebooks(kind: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("notebooks");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> =
        files.filter(|path| path.extension().is_some_and(|end| end == kind)).collect();
    files.retain(|path| path.file_stem().unwrap().to_string_lossy().starts_with(char::is_numeric));
    files.sort();
    files
}

#[test]
fn every_cell_runs_and_its_output_stands_in_the_notebook() {
    for source in notebooks("md") {
        let name = source.file_stem().unwrap().to_string_lossy().into_owned();
        let cells = Source::read(&fs::read_to_string(&source).unwrap()).cells().count();
        let notebook: Value = serde_json::from_str(&written(&name)).unwrap();
        let code = notebook["cells"].as_array().unwrap().iter();
        let code: Vec<&Value> = code.filter(|cell| cell["cell_type"] == "code").collect();
        assert!(cells > 0 && code.len() >= cells, "{name}: {} of {cells} cells", code.len());
        assert!(code.iter().any(|cell| cell["outputs"] != json!([])), "{name}");
    }
}

#[test]
fn the_committed_notebooks_are_those_of_the_lessons() {
    let folder = tempfile::tempdir().unwrap();
    run(&["lesson", "--all", "--ipynb", "--out", folder.path().to_str().unwrap()]);
    let sources = notebooks("md");
    for source in sources {
        let committed = source.with_extension("ipynb");
        let fresh = folder.path().join(committed.file_name().unwrap());
        let same = fs::read_to_string(&committed).unwrap() == fs::read_to_string(fresh).unwrap();
        assert!(same, "{} is not current: lcplab lesson --all --ipynb", committed.display());
    }
}

/// Jupyter renders each cell on its own.
#[test]
fn a_fold_ends_in_the_cell_where_it_begins_and_hides_the_output_of_its_code() {
    let mut hidden = 0;
    for source in notebooks("md") {
        let notebook = fs::read_to_string(source.with_extension("ipynb")).unwrap();
        let notebook: Value = serde_json::from_str(&notebook).unwrap();
        for cell in notebook["cells"].as_array().unwrap() {
            let lines = cell["source"].as_array().unwrap().iter().filter_map(Value::as_str);
            let text: String = lines.collect();
            let place = format!("{}: {text}", source.display());
            assert_eq!(
                text.matches("<details>").count(),
                text.matches("</details>").count(),
                "{place}"
            );
            for name in cell["attachments"].as_object().into_iter().flat_map(Map::keys) {
                assert!(text.contains(&format!("](attachment:{name})")), "{place} lacks {name}");
            }
            hidden += usize::from(cell["metadata"]["jupyter"]["outputs_hidden"] == json!(true));
        }
    }
    // Lessons 6, 9, 12 and 16 have a cell in Python in the answer to a prediction.
    assert_eq!(hidden, 4);
}

#[test]
fn pages_fetch_nothing_and_name_each_picture_once() {
    let files = fs::read_dir(pages()).unwrap().map(|entry| entry.unwrap().path());
    for path in files.filter(|path| path.extension().is_some_and(|end| end == "html")) {
        let html = fs::read_to_string(&path).unwrap();
        let page = path.display();
        let outside = html.replace("http://www.w3.org/", "");
        for fetch in ["src=\"http", "@import", "<link rel=\"stylesheet"] {
            assert!(!outside.contains(fetch), "{page} has {fetch}");
        }
        let titles: Vec<&str> = html
            .split("<svg ")
            .skip(1)
            .filter_map(|svg| svg.split(" id=\"").nth(1))
            .filter_map(|rest| rest.split('"').next())
            .collect();
        assert_eq!(
            titles.iter().collect::<BTreeSet<_>>().len(),
            titles.len(),
            "{page}: {titles:?}"
        );
    }
}

#[test]
fn a_lesson_has_the_fixed_parts_and_readable_cells() {
    for path in notebooks("md") {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let source = Source::read(&fs::read_to_string(&path).unwrap());
        let prose: Vec<&str> = source
            .parts
            .iter()
            .filter_map(|part| match part {
                Part::Prose(text) => Some(text.as_str()),
                Part::Cell { .. } | Part::Python { .. } => None,
            })
            .collect();
        let prose = prose.join("\n");
        for part in [
            "## Question",
            "## Derivation",
            "## Common mistakes",
            "## You can now",
            "## Try it",
            "{{problems}}",
        ] {
            assert!(prose.contains(part), "{name} lacks {part}");
        }
        let cells: Vec<&str> = source.cells().collect();
        assert!((3..=20).contains(&cells.len()), "{name} has {} cells", cells.len());
        for line in cells.iter().flat_map(|cell| cell.lines()) {
            assert!(line.chars().count() <= 90, "{name}: a long line: {line}");
        }
        let parts = prose.matches("**Predict.**").count();
        assert!(parts >= 1, "{name} asks for no prediction");
        let python: Vec<&str> = source
            .parts
            .iter()
            .filter_map(|part| match part {
                Part::Python { code, .. } => Some(code.as_str()),
                Part::Prose(_) | Part::Cell { .. } => None,
            })
            .collect();
        assert!(python.len() >= 3, "{name}: Python carries the lesson");
        for line in python.iter().flat_map(|cell| cell.lines()) {
            assert!(line.chars().count() <= 115, "{name}: a long line: {line}");
        }
        let last = prose.rsplit("\n## ").next().unwrap();
        assert!(last.starts_with("For readers of the chapter"), "{name} ends otherwise");
        assert!(prose.matches("{{E").count() <= last.matches("{{E").count() + 1, "{name}: errata");
    }
}

#[test]
fn numbers_in_prose_come_from_cells() {
    for path in notebooks("md") {
        let source = Source::read(&fs::read_to_string(&path).unwrap());
        for part in &source.parts {
            let Part::Prose(text) = part else { continue };
            // Small whole numbers and one or two digits after the point are inputs or counts.
            let typed = text.split(|c: char| !c.is_ascii_digit() && c != '.').find(|word| {
                let decimals = word.split_once('.').map_or(0, |(_, decimals)| decimals.len());
                decimals > 2 && *word != "..."
            });
            assert_eq!(typed, None, "{}: a number that no cell computed", path.display());
        }
    }
}

#[test]
fn every_value_that_a_cell_puts_is_quoted() {
    for path in notebooks("md") {
        let text = fs::read_to_string(&path).unwrap();
        for name in text.split("put(\"").skip(1).filter_map(|rest| rest.split('"').next()) {
            assert!(text.contains(&format!("{{{{{name}}}}}")), "{}: {name}", path.display());
        }
    }
}

#[test]
fn the_documentation_lists_every_lesson_by_its_title() {
    let page = include_str!("../../../docs/teaching.md");
    for path in notebooks("md") {
        let title = Source::read(&fs::read_to_string(&path).unwrap()).title;
        let file = path.file_name().unwrap().to_string_lossy();
        let link = format!("[{title}](../notebooks/{file})");
        assert!(page.contains(&link), "{link}");
    }
}

#[test]
fn each_lesson_begins_with_the_sections_of_the_chapter_that_it_derives() {
    for path in notebooks("md") {
        let source = Source::read(&fs::read_to_string(&path).unwrap());
        let Some(Part::Prose(lead)) = source.parts.first() else { panic!("{}", path.display()) };
        assert!(lead.starts_with("*K&M: "), "{}", path.display());
    }
}

#[test]
fn every_equation_of_the_chapter_has_a_lesson_that_names_it() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("notebooks");
    let guide = fs::read_to_string(folder.join("guide.md")).unwrap();
    for k in 1..=45 {
        let row = guide.lines().find(|line| line.starts_with(&format!("| ({k}) | ")));
        let row = row.unwrap_or_else(|| panic!("({k}) is not in the table"));
        let file = row.rsplit("](").next().and_then(|rest| rest.split(')').next()).unwrap();
        let lesson = fs::read_to_string(folder.join(file)).unwrap();
        let is_named = |first: usize, last: usize| (first..=last).contains(&k);
        let numbers = lesson.match_indices('(').any(|(at, _)| {
            let Some((first, after)) = lesson[at + 1..].split_once(')') else { return false };
            let Ok(first) = first.parse() else { return false };
            let last = after.strip_prefix(" to (").and_then(|rest| rest.split(')').next());
            is_named(first, last.and_then(|last| last.parse().ok()).unwrap_or(first))
        });
        assert!(numbers, "{file} does not name ({k})");
    }
}
