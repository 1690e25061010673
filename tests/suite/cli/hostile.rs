//! Files of strangers: whatever they are called and whatever is in them, they write where they may,
//! and steer no terminal.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use super::{err, out};

/// Clears the screen, sets the window's title, and in one character what two begin.
const ESCAPES: &str = "a\u{1b}[2J\u{1b}]0;owned\u{7}\u{9b}2Jb";

fn run_in(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lcplab")).current_dir(folder).args(arguments).output().unwrap()
}

/// Everything in a folder, however deep.
fn files(folder: &Path) -> Vec<String> {
    let inside = |path: &Path| if path.is_dir() { files(path) } else { Vec::new() };
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut all: Vec<String> = entries
        .flat_map(|path| [vec![path.display().to_string()], inside(&path)].concat())
        .collect();
    all.sort();
    all
}

const WORDS: &str = "title = \"A\"\nlead = \"B\"\n[[section]]\ntitle = \"C\"\ntext = \"D\"\n";
const SWEEP: &str =
    "family = \"stack\"\nmeasure = \"iterations\"\n[axes]\nsolver.name = [\"pgs\"]\n";

#[test]
fn a_file_whose_name_is_no_folder_writes_nothing() {
    for (arguments, text) in [(&["report"][..], WORDS), (&["grid", "run"], SWEEP)] {
        for name in ["...toml", "..toml", "a b.toml", "é.toml"] {
            let folder = tempfile::tempdir().unwrap();
            let inner = folder.path().join("reports");
            fs::create_dir(&inner).unwrap();
            fs::write(folder.path().join(name), text).unwrap();
            let before = files(folder.path());
            let output = run_in(folder.path(), &[arguments, &[name]].concat());
            assert_eq!(output.status.code(), Some(2), "{name}: {}", out(&output));
            assert!(
                err(&output).contains("becomes a file name: use only letters"),
                "{}",
                err(&output)
            );
            assert_eq!(files(folder.path()), before);
        }
    }
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a b.toml"), WORDS).unwrap();
    let output = run_in(folder.path(), &["report", "a b.toml", "--out", "c d"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
}

#[test]
fn names_of_runs_and_sections_lead_nowhere_else() {
    let folder = tempfile::tempdir().unwrap();
    let runs = "ledgers = [{ name = \"x/../../../../evil\", title = \"a\", text = \"b\", \
                scene = \"fig6\", duration = 0.1 }]";
    let ledger = format!("title = \"A\"\nlead = \"B\"\n[[section]]\nstudy = \"drift\"\n{runs}\n");
    fs::write(folder.path().join("r.toml"), ledger).unwrap();
    let before = files(folder.path());
    let output = run_in(folder.path(), &["report", "r.toml", "--out", "deep/er/r"]);
    assert_eq!(output.status.code(), Some(2), "{}", out(&output));
    assert!(err(&output).contains("\"x/../../../../evil\" becomes a file"), "{}", err(&output));
    assert_eq!(files(folder.path()), before);

    fs::write(folder.path().join("r.toml"), WORDS).unwrap();
    assert!(run_in(folder.path(), &["report", "r.toml", "--out", "r"]).status.success());
    let results = folder.path().join("r/results.json");
    let text = fs::read_to_string(&results).unwrap();
    assert!(text.contains("\"id\": \"c\""), "{text}");
    fs::write(&results, text.replace("\"id\": \"c\"", "\"id\": \"../../evil\"")).unwrap();
    let before = files(folder.path());
    let output = run_in(folder.path(), &["report", "r/results.json"]);
    assert_eq!(output.status.code(), Some(2), "{}", out(&output));
    assert!(err(&output).contains("\"../../evil\" becomes a file"), "{}", err(&output));
    assert_eq!(files(folder.path()), before);
}

#[test]
fn a_results_file_with_a_key_twice_is_not_drawn() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("r.toml"), WORDS).unwrap();
    assert!(run_in(folder.path(), &["report", "r.toml", "--out", "r"]).status.success());
    let results = folder.path().join("r/results.json");
    let text = fs::read_to_string(&results).unwrap();
    fs::write(&results, text.replacen('{', "{\"title\": \"Other\",", 1)).unwrap();
    let output = run_in(folder.path(), &["report", "r/results.json"]);
    assert_eq!(output.status.code(), Some(2), "{}", out(&output));
    assert!(err(&output).contains("the key \"title\" is given twice"), "{}", err(&output));
}

/// A scene of a ball on the floor, of this name.
fn scene(name: &str) -> String {
    format!(
        "title = \"A {name}\"\nteaches = \"B {name}\"\n[step]\ncount = 1\n\
         [[bodies]]\nname = \"floor\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"{name}\"\nshape = {{ sphere = 0.5 }}\nmass = 1\nposition = [0, 0, 0.5]\n"
    )
}

#[test]
fn names_do_not_steer_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let written: String = ESCAPES.chars().map(|c| format!("\\u{:04x}", c as u32)).collect();
    fs::write(folder.path().join("s.toml"), scene(&written)).unwrap();
    let problem = format!(
        "{{\"name\": \"{written}\", \"A\": {{\"dense\": [[1]]}}, \"b\": [1], \"{written}\": 1, \
         \"rows\": [{{\"label\": \"{written}\"}}]}}"
    );
    fs::write(folder.path().join("p.json"), &problem).unwrap();
    fs::write(folder.path().join("q.json"), problem.replace("[[1]]", &format!("\"{written}\"")))
        .unwrap();
    fs::write(folder.path().join("t.toml"), format!("{}\n\"{written}\" = 1\n", scene("b")))
        .unwrap();
    let long = "no such \u{1b}[2J.toml";
    let commands: [&[&str]; 12] = [
        &["simulate", "s.toml"],
        &["compare", "s.toml", "--solver", "dantzig"],
        &["diagnose", "s.toml"],
        &["explain", "s.toml"],
        &["explain", "s.toml", "--format", "markdown"],
        &["solve", "p.json"],
        &["diagnose", "p.json"],
        &["compare", "p.json"],
        &["solve", "q.json"],
        &["simulate", "t.toml"],
        &["simulate", long],
        &["grid", "plan", long],
    ];
    for arguments in commands {
        let output = run_in(folder.path(), arguments);
        let shown = out(&output) + &err(&output);
        assert!(!shown.is_empty(), "{arguments:?}");
        let steers = |c: &char| c.is_control() && !"\n\t".contains(*c);
        assert!(!shown.chars().any(|c| steers(&c)), "{arguments:?}: {shown:?}");
    }
}

#[test]
fn names_may_be_longer_than_a_format_is_wide() {
    let folder = tempfile::tempdir().unwrap();
    let name = "x".repeat(70_000);
    fs::write(folder.path().join("s.toml"), scene(&name)).unwrap();
    let sweep = format!("scene = \"{name}\"\nmeasure = \"drift\"\n[axes]\nsteps = [1]\n");
    fs::write(folder.path().join("w.toml"), sweep).unwrap();
    let labels = format!("{SWEEP}[labels]\nsolver.name = \"{name}\"\n");
    fs::write(folder.path().join("l.toml"), labels).unwrap();
    for arguments in [
        &["explain", "s.toml"][..],
        &["diagnose", "s.toml"],
        &["simulate", "s.toml"],
        &["compare", "s.toml", "--solver", "dantzig"],
        &["grid", "plan", "w.toml", "--out", "w"],
        &["grid", "plan", "l.toml", "--out", "l"],
    ] {
        let output = run_in(folder.path(), arguments);
        assert!(output.status.code().is_some_and(|code| code <= 2), "{arguments:?}");
        assert!(!err(&output).contains("panicked"), "{arguments:?}: {:.300}", err(&output));
    }
}

#[test]
fn formulas_of_a_report_run_nothing_and_end_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let deep = format!("{}x{}", "{".repeat(5000), "}".repeat(5000));
    for (text, code) in [("\\operatorname{<script>alert(1)</script>}", 2), (deep.as_str(), 0)] {
        let report = WORDS.replace("\"D\"", &format!("'${text}$'"));
        fs::write(folder.path().join("r.toml"), report).unwrap();
        let output = run_in(folder.path(), &["report", "r.toml", "--out", "r"]);
        assert_eq!(output.status.code(), Some(code), "{:.300}", err(&output));
        let page = fs::read_to_string(folder.path().join("r/index.html")).unwrap_or_default();
        assert!(!page.contains("<script>alert"));
    }
}
