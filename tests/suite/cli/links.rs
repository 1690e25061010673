//! Folders that came from a stranger: where a name that lcplab chooses is a symbolic link there,
//! nothing is written through it, whatever it leads to.

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use super::err;

const WORDS: &str = "title = \"A\"\nlead = \"B\"\n[[section]]\ntitle = \"C\"\ntext = \"D\"\n";
const PROVED: &str = "title = \"A\"\nlead = \"B\"\n[[section]]\nstudy = \"cross-check\"\nscenes = [{ scene = \"fig7\" }]\n";
const GRID: &str =
    "family = \"stack\"\nmeasure = \"iterations\"\n[axes]\nsolver.name = [\"pgs\"]\n";
/// What a link may lead to, from the folder above `out`: a file, a folder, nothing, the folder
/// itself.
const TARGETS: [&str; 4] = ["home/keys", "home", "home/new", ""];

/// A command that writes into the folder `out`.
struct Writer {
    arguments: &'static [&'static str],
    /// A command that has to run before.
    first: &'static [&'static str],
    /// The names that it chooses; those of `first` are there already.
    names: &'static [&'static str],
}

const fn writer(arguments: &'static [&'static str], names: &'static [&'static str]) -> Writer {
    Writer { arguments, first: &[], names }
}

const RUN_GRID: &[&str] = &["grid", "run", "g.toml", "--out", "out"];
const WRITERS: &[Writer] = &[
    writer(&["report", "r.toml", "--out", "out"], &["index.html", "results.json"]),
    writer(
        &["report", "r.toml", "--section", "c", "--out", "out"],
        &["c", "c/index.html", "c/results.json"],
    ),
    Writer {
        arguments: &["report", "out/results.json"],
        first: &["report", "proved.toml", "--out", "out"],
        names: &["data", "index.html"],
    },
    writer(
        &["report", "engines", "--engine", "all", "--out", "out"],
        &["engines.json", "data", "index.html", "results.json"],
    ),
    writer(&["report", "chapter", "--out", "out"], &["index.html"]),
    writer(&["grid", "plan", "g.toml", "--out", "out"], &["plan.json"]),
    writer(RUN_GRID, &["plan.json", "tasks", "tasks/1.json"]),
    Writer {
        arguments: &["grid", "collect", "g.toml", "--out", "out"],
        first: RUN_GRID,
        names: &["data", "index.html", "results.csv", "results.json", "times.csv"],
    },
    writer(
        &["simulate", "fig6", "--steps", "2", "--out", "out"],
        &["final.toml", "forces.csv", "index.html", "ledger.csv", "results.json", "trajectory.csv"],
    ),
    writer(
        &["compare", "fig6", "--steps", "2", "--solver", "dantzig", "--out", "out"],
        &["data", "index.html"],
    ),
    writer(&["lesson", "1", "--out", "out"], &["01_complementarity.html", "engine.py", "live"]),
    writer(&["lesson", "1", "--ipynb", "--out", "out"], &["01_complementarity.ipynb", "engine.py"]),
    writer(&["live", "stack", "--out", "out"], &["stack.html"]),
    writer(&["problems", "--export", "out"], &["CITATION.cff", "index.csv"]),
    // Here the user names out/p, and lcplab the rest.
    writer(&["convert", "p.json", "out/p.mtx"], &["p_b.mtx", "p_lo.mtx", "p_hi.mtx"]),
    writer(
        &["compare", "p.json", "--solver", "pgs", "--profile", "out/p"],
        &["p.csv", "p.svg", "p.tex", "p_problems.csv"],
    ),
    writer(&["diagnose", "fig6", "--step", "1", "--out", "out/page.html"], &["page-step-1.json"]),
];

/// A folder with the files that the commands read, and one, `home`, that no command may change.
struct Workspace(tempfile::TempDir);

impl Workspace {
    fn new() -> Self {
        let workspace = Workspace(tempfile::tempdir().unwrap());
        let engines = concat!(env!("CARGO_MANIFEST_DIR"), "/reports/engines.json");
        let python = format!("#!/bin/sh\ncp '{engines}' \"$4\"\n");
        for (name, text) in [
            ("r.toml", WORDS),
            ("proved.toml", PROVED),
            ("g.toml", GRID),
            ("p.json", super::GOOD),
            ("home/keys", "keys"),
            ("python", &python),
        ] {
            let path = workspace.path(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let program = fs::Permissions::from_mode(0o755);
        fs::set_permissions(workspace.path("python"), program).unwrap();
        workspace
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
        command.current_dir(self.0.path()).args(arguments);
        command.env("LCPLAB_PYTHON", self.path("python")).output().unwrap()
    }

    /// The files outside of `out`, and what is in them.
    fn outside(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut files = BTreeMap::new();
        gather(self.0.path(), &self.path("out"), &mut files);
        files
    }
}

fn gather(folder: &Path, but: &Path, files: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path == but {
            continue;
        }
        match path.is_dir() && !path.is_symlink() {
            true => gather(&path, but, files),
            false => drop(files.insert(path.clone(), fs::read(&path).unwrap_or_default())),
        }
    }
}

/// What stands in a folder, and in the folders of it that are in the list.
fn names(folder: &Path, known: &[&str]) -> Vec<String> {
    let of = |folder: &Path| -> Vec<PathBuf> {
        fs::read_dir(folder).map_or(Vec::new(), |list| list.map(|e| e.unwrap().path()).collect())
    };
    let deeper = known.iter().filter(|name| name.contains('/'));
    let mut found = of(folder);
    for name in deeper {
        found.extend(of(folder.join(name).parent().unwrap()));
    }
    let mut names: Vec<String> =
        found.iter().map(|path| path.strip_prefix(folder).unwrap().display().to_string()).collect();
    names.sort();
    names.dedup();
    names
}

/// Runs a command into a folder with a link at one of its names.
fn attack(writer: &Writer, name: &str, target: &str) {
    let workspace = Workspace::new();
    fs::create_dir(workspace.path("out")).unwrap();
    if !writer.first.is_empty() {
        assert!(workspace.run(writer.first).status.success());
    }
    let link = workspace.path("out").join(name);
    fs::create_dir_all(link.parent().unwrap()).unwrap();
    let _ = fs::remove_file(&link);
    let _ = fs::remove_dir_all(&link);
    symlink(workspace.path(target), &link).unwrap();
    let before = workspace.outside();
    let output = workspace.run(writer.arguments);
    let what = format!("{:?}, {name} -> {target:?}: {}", writer.arguments, err(&output));
    assert_eq!(output.status.code(), Some(2), "{what}");
    assert!(err(&output).contains(&format!("out/{name}: is a symbolic link")), "{what}");
    assert!(workspace.outside() == before, "{what}");
    assert!(link.is_symlink(), "{what}");
}

#[test]
fn the_names_that_a_command_chooses_are_known() {
    // What `problems --export` writes, its own test says.
    for writer in WRITERS.iter().filter(|writer| writer.arguments[0] != "problems") {
        let workspace = Workspace::new();
        fs::create_dir(workspace.path("out")).unwrap();
        let first = if writer.first.is_empty() {
            Vec::new()
        } else {
            workspace.run(writer.first);
            names(&workspace.path("out"), writer.names)
        };
        let output = workspace.run(writer.arguments);
        assert!(output.status.code().is_some_and(|code| code < 2), "{}", err(&output));
        let found = names(&workspace.path("out"), writer.names);
        let by_user = ["p.mtx", "page.html"];
        let is_new = |name: &&String| {
            !by_user.contains(&name.as_str())
                && (!first.contains(name) || writer.names.contains(&name.as_str()))
        };
        let found: Vec<&String> = found.iter().filter(is_new).collect();
        let mut known = writer.names.to_vec();
        known.sort_unstable();
        assert_eq!(found, known, "{:?}", writer.arguments);
    }
}

#[test]
fn nothing_is_written_through_a_link_at_a_name_that_a_command_chooses() {
    for writer in WRITERS {
        for name in writer.names {
            for target in TARGETS {
                attack(writer, name, target);
            }
        }
    }
}

#[test]
fn folders_of_their_own_names_are_no_links_either() {
    for (folder, arguments) in [
        ("reports", &["report", "r.toml"][..]),
        ("reports/r", &["report", "r.toml"]),
        ("reports", &["report", "chapter"]),
        ("grids/g", &["grid", "run", "g.toml"]),
        ("reports/live", &["live", "stack"]),
        ("reports/lessons", &["lesson", "1"]),
        ("notebooks", &["lesson", "1", "--ipynb"]),
    ] {
        let workspace = Workspace::new();
        let link = workspace.path(folder);
        fs::create_dir_all(link.parent().unwrap()).unwrap();
        symlink(workspace.path("home"), &link).unwrap();
        let before = workspace.outside();
        let output = workspace.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", err(&output));
        let expected = format!("{folder}: is a symbolic link");
        assert!(err(&output).contains(&expected), "{arguments:?}: {}", err(&output));
        assert!(workspace.outside() == before, "{arguments:?}");
    }
}

#[test]
fn a_folder_or_file_that_the_user_names_may_be_a_link() {
    let workspace = Workspace::new();
    symlink(workspace.path("home"), workspace.path("out")).unwrap();
    let output = workspace.run(&["live", "stack", "--out", "out"]);
    assert!(output.status.success(), "{}", err(&output));
    assert!(workspace.path("home/stack.html").is_file());
    symlink(workspace.path("home/keys"), workspace.path("x.json")).unwrap();
    let output = workspace.run(&["problems", "fathi", "--out", "x.json"]);
    assert!(output.status.success(), "{}", err(&output));
    assert!(fs::read_to_string(workspace.path("home/keys")).unwrap().contains("fathi"));
}

#[test]
fn a_link_is_refused_before_the_work() {
    let workspace = Workspace::new();
    fs::create_dir(workspace.path("out")).unwrap();
    symlink(workspace.path("home/keys"), workspace.path("out/index.html")).unwrap();
    let endless = ["simulate", "fig6", "--steps", "1000000000", "--time-limit", "60"];
    let output = workspace.run(&[&endless[..], &["--out", "out"]].concat());
    assert_eq!(output.status.code(), Some(2), "{}", err(&output));
}
