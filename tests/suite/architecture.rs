//! Who may import whom. Between crates Cargo sees to it, by their manifests; within a crate a
//! module may use those of the rows above its own, never a neighbor's.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use toml::Table;

/// The libraries, and those of ours that each may use. The judge must not see a solver, a page
/// neither solvers nor scenes.
const CRATES: [(&str, &[&str]); 10] = [
    ("lcp", &[]),
    ("solver", &["lcp"]),
    ("judge", &["lcp"]),
    ("proof", &["lcp", "judge"]),
    ("files", &["lcp"]),
    ("plugin", &["lcp", "solver"]),
    ("page", &["lcp"]),
    ("bodies", &[]),
    ("mechanics", &["bodies", "lcp", "solver", "judge"]),
    ("analysis", &["lcp", "solver", "judge", "mechanics", "page"]),
];

/// The modules of the crates that have rows of them; `src` is the program's.
const ROWS: [(&str, &[&[&str]]); 5] = [
    (
        "src",
        &[
            &["storage", "animation", "live"],
            &["report"],
            &["frames"],
            &["chapter", "problem_set"],
            &["lesson"],
        ],
    ),
    (
        "crates/page/src",
        &[
            &["escape", "number"],
            &["csv", "figure"],
            &["plot"],
            &["page"],
            &["text"],
            &["document"],
            &["terminal"],
        ],
    ),
    ("crates/mechanics/src", &[&["scene"], &["assembly"], &["formulation"], &["simulation"]]),
    ("crates/bodies/src", &[&["body"], &["constraint"]]),
    (
        "crates/analysis/src",
        &[
            &["number"],
            &[
                "answer",
                "aside",
                "card",
                "ci",
                "clarabel",
                "gradient",
                "minimum",
                "motion_error",
                "tally",
                "trial",
            ],
            &["loads", "methods", "precision"],
            &["friction"],
            &["families", "profiles", "tasks"],
            &["comparison", "receipt", "regression"],
            &["explain", "diagnosis"],
            &["hunt"],
        ],
    ),
];

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
fn every_crate_depends_on_those_it_may_use_and_no_others() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (name, allowed) in CRATES {
        let manifest =
            fs::read_to_string(root.join("crates").join(name).join("Cargo.toml")).unwrap();
        let manifest: toml::Table = manifest.parse().unwrap();
        let ours = |table: &str| {
            let names =
                manifest.get(table).and_then(|table| table.as_table()).into_iter().flatten();
            names.filter_map(|(name, _)| name.strip_prefix("lcplab-")).collect::<Vec<_>>()
        };
        let mut named = ours("dependencies");
        named.sort_unstable();
        let mut allowed = allowed.to_vec();
        allowed.sort_unstable();
        assert_eq!(named, allowed, "{name}");
    }
}

#[test]
fn every_module_imports_only_what_lies_above_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut wrong = Vec::new();
    for (folder, rows) in ROWS {
        let src = root.join(folder);
        for file in sources(&src) {
            let inside = file.strip_prefix(&src).unwrap();
            let first = inside.iter().next().unwrap().to_str().unwrap();
            let module = first.trim_end_matches(".rs");
            if ["lib", "main", "cli"].contains(&module) {
                continue;
            }
            let own = rows.iter().position(|row| row.contains(&module));
            let own = own.unwrap_or_else(|| panic!("{module} has no row in this test"));
            let is_below = |name: &str| rows[own..].iter().any(|row| row.contains(&name));
            for name in imports(&fs::read_to_string(&file).unwrap()) {
                if name != module && is_below(&name) {
                    wrong.push(format!("{} imports {name}", file.display()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_readme_is_short_and_leads_to_every_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = fs::read_to_string(root.join("README.md")).unwrap();
    assert!(readme.lines().count() <= 120);
    for page in fs::read_dir(root.join("docs")).unwrap() {
        let name = page.unwrap().file_name().into_string().unwrap();
        assert!(readme.contains(&format!("](docs/{name})")), "{name}");
    }
    let links = readme.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    for link in links.filter(|link| !link.contains("://")) {
        assert!(root.join(link).exists(), "{link}");
    }
}

#[test]
fn files_are_written_in_one_place_and_never_through_a_link_of_a_stranger() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let folders = crates.map(|path| path.join("src")).chain([root.join("src")]);
    let direct = [
        "fs::write(",
        "fs::copy(",
        "fs::rename(",
        "fs::create_dir",
        "fs::hard_link(",
        "File::create",
        "OpenOptions::new",
    ];
    for file in folders.flat_map(|folder| sources(&folder)) {
        if file.ends_with("crates/files/src/disk.rs") {
            continue;
        }
        let text = fs::read_to_string(&file).unwrap();
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        for line in code {
            assert!(!direct.iter().any(|word| line.contains(word)), "{}: {line}", file.display());
            // What follows is a path that the user named, not one that is put together here.
            let named = line.split_once("file::write(").map_or("", |(_, rest)| rest);
            let is_made = [".join(", "with_file_name(", "with_extension("];
            assert!(!is_made.iter().any(|word| named.contains(word)), "{}: {line}", file.display());
        }
    }
}

#[test]
fn the_solvers_tolerances_are_in_one_table_with_a_reason_each() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/solver/src");
    let (mut table, mut elsewhere) = (Vec::new(), Vec::new());
    for file in sources(&src) {
        let text = fs::read_to_string(&file).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        for (k, line) in lines.iter().enumerate() {
            let Some((declared, value)) = line.split_once(": f64 = ") else { continue };
            let Some((_, name)) = declared.split_once("const ") else { continue };
            if !value.starts_with(|c: char| c.is_ascii_digit()) {
                continue;
            }
            if file.ends_with("tolerances.rs") {
                let reason = lines[..k].iter().rev().take_while(|line| line.starts_with("///"));
                let words: usize = reason.map(|line| line.split_whitespace().count() - 1).sum();
                assert!(words >= 8, "{name} has no reason");
                table.push(name.to_string());
            } else {
                elsewhere.push(format!("{}: {line}", file.display()));
            }
        }
    }
    assert!(elsewhere.is_empty(), "{elsewhere:#?}");
    assert!(table.len() > 30, "{table:?}");
    let names: BTreeSet<&String> = table.iter().collect();
    assert_eq!(names.len(), table.len());
}

/// The versions of each package in a lock file.
fn locked(file: &str) -> BTreeMap<String, BTreeSet<String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let lock: Table = fs::read_to_string(path).unwrap().parse().unwrap();
    let mut versions = BTreeMap::<_, BTreeSet<_>>::new();
    for package in lock["package"].as_array().unwrap() {
        let [name, version] = ["name", "version"].map(|key| package[key].as_str().unwrap());
        versions.entry(name.to_string()).or_default().insert(version.to_string());
    }
    versions
}

/// Otherwise CI compiles all of lcplab once more for Python, with other versions than are tested.
#[test]
fn the_python_package_has_the_librarys_versions() {
    let [library, python] = ["Cargo.lock", "python/Cargo.lock"].map(locked);
    for (name, versions) in python {
        let Some(tested) = library.get(&name) else { continue };
        assert!(versions.is_subset(tested), "{name}: {versions:?} in python, {tested:?} here");
    }
}
