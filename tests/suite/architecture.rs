//! Who may import whom: each module may use those of the rows above its own, never a neighbour's,
//! and physics and numbers do not know each other until `formulation`.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Modules by row; physics left, numbers right, both from row 5 on.
const PHYSICS: [&[&str]; 7] = [
    &["error"],
    &["memory"],
    &["file", "json"],
    &["body"],
    &["constraint"],
    &["scene"],
    &["assembly"],
];
const NUMBERS: [&[&str]; 7] = [
    &["error"],
    &["memory"],
    &["file", "json"],
    &["lcp"],
    &["solver", "reference", "storage"],
    &["certificate"],
    &["trial"],
];
const BOTH: [&[&str]; 8] = [
    &["formulation"],
    &["simulation"],
    &["trace"],
    &["plot"],
    &["report"],
    &["document"],
    &["explain", "diagnosis", "chapter"],
    &["lesson"],
];
/// The judge must not see a solver, a solver no reference.
const FORBIDDEN: [(&str, &str); 2] = [("certificate", "solver"), ("solver", "reference")];

fn allowed() -> HashMap<&'static str, Vec<&'static str>> {
    let mut allowed = HashMap::new();
    for column in [&PHYSICS[..], &NUMBERS[..]] {
        let mut above: Vec<&str> = Vec::new();
        for row in column {
            for module in *row {
                allowed.insert(*module, above.clone());
            }
            above.extend(*row);
        }
    }
    let mut above: Vec<&str> = PHYSICS.concat();
    above.extend(NUMBERS.concat());
    for row in BOTH {
        for module in row {
            allowed.insert(*module, above.clone());
        }
        above.extend(row);
    }
    for (module, other) in FORBIDDEN {
        allowed.get_mut(module).unwrap().retain(|name| *name != other);
    }
    allowed
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files
}

/// The modules that the code of a file names as `crate::module`; comments do not count.
fn imports(text: &str) -> Vec<String> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let names = |line: &str| {
        let parts = line.split("crate::").skip(1).map(|rest| {
            rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>()
        });
        parts.collect::<Vec<_>>()
    };
    // Exported macros live at the root under names that begin with two underscores.
    code.flat_map(names).filter(|name| !name.is_empty() && !name.starts_with("__")).collect()
}

#[test]
fn every_module_imports_only_what_lies_above_it() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let allowed = allowed();
    let mut wrong = Vec::new();
    for file in sources(&src) {
        let inside = file.strip_prefix(&src).unwrap();
        let first = inside.iter().next().unwrap().to_str().unwrap();
        let module = first.trim_end_matches(".rs");
        if ["lib", "main", "cli"].contains(&module) {
            continue;
        }
        let above =
            allowed.get(module).unwrap_or_else(|| panic!("{module} has no row in this test"));
        for name in imports(&fs::read_to_string(&file).unwrap()) {
            if name != module && !above.contains(&name.as_str()) {
                wrong.push(format!("{} imports {name}", inside.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
