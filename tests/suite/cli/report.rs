//! `report`: what it goes on from, and the command that makes a page again.

use indicatif::ProgressBar;
use lcplab::report::experiment::Experiment;
use lcplab::report::results::Results;
use lcplab::report::{run as runner, write};
use lcplab::solver::{Registry, Stop};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use super::{err, out, run};

const TWO: &str = "title = 'Two'\nlead = ''\n\
                   [[section]]\nstudy = 'cross-check'\nscenes = [{ scene = 'fig7' }]\n\
                   [[section]]\nstudy = 'grid'\ngrid = 'ratio'\n";

/// The results of a run of the file that ended before its last task.
fn interrupted(file: &Path, folder: &Path) -> Results {
    let experiment = Experiment::load(file.to_str().unwrap()).unwrap();
    let hidden = ProgressBar::hidden();
    let whole = runner::run(
        &experiment,
        None,
        Registry::standard(),
        &hidden,
        &Stop::default(),
        &|_| Ok(()),
    )
    .unwrap();
    let mut stopped = whole.clone();
    let last = stopped.sections.last_mut().unwrap().tasks.last_mut().unwrap();
    last.finding = None;
    write::results(&stopped, folder).unwrap();
    whole
}

fn read(folder: &Path) -> Value {
    let text = fs::read_to_string(folder.join("results.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// The first number in a value, to be changed.
fn first_number(value: &mut Value) -> Option<&mut Value> {
    match value {
        Value::Number(_) => Some(value),
        Value::Array(items) => items.iter_mut().find_map(first_number),
        Value::Object(fields) => fields.values_mut().find_map(first_number),
        _ => None,
    }
}

#[test]
fn an_interrupted_report_repeats_the_tasks_edited_since() {
    let folder = tempfile::tempdir().unwrap();
    let (file, page) = (folder.path().join("two.toml"), folder.path().join("page"));
    fs::write(&file, TWO).unwrap();
    let names = ["report", file.to_str().unwrap(), "--out", page.to_str().unwrap()];
    let whole = serde_json::to_value(interrupted(&file, &page)).unwrap();
    let untouched = run(&names);
    assert_eq!((untouched.status.code(), err(&untouched).as_str()), (Some(0), ""));
    assert_eq!(read(&page)["sections"], whole["sections"]);

    // A finding, the settings that it belongs to, the version that made it, the checksum itself.
    let edits: [&dyn Fn(&mut Value); 4] = [
        &|results| {
            let finding = &mut results["sections"][0]["tasks"][0]["finding"];
            *first_number(finding).unwrap() = 12345.into();
        },
        &|results| {
            results["sections"][0]["tasks"][0]["finding"] = Value::Null;
            results["sections"][0]["tasks"][0]["failure"] = "no time".into();
        },
        &|results| {
            let section = results["sections"][0].as_object_mut().unwrap();
            section.remove("checksum").expect("one is written while the report is not done");
        },
        &|results| results["sections"][0]["checksum"] = "0123456789abcdef".into(),
    ];
    for edit in edits {
        interrupted(&file, &page);
        let mut results = read(&page);
        edit(&mut results);
        fs::write(page.join("results.json"), results.to_string()).unwrap();
        let output = run(&names);
        let path = page.join("results.json");
        let reported = format!(
            "warning: {}: section cross-check was edited: lcplab computes it again\n",
            path.display()
        );
        assert_eq!((output.status.code(), err(&output)), (Some(0), reported));
        assert_eq!(read(&page)["sections"], whole["sections"]);
    }
}

#[test]
fn what_is_complete_carries_no_checksum() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("two.toml");
    fs::write(&file, TWO).unwrap();
    let whole = interrupted(&file, folder.path());
    let sections = read(folder.path())["sections"].clone();
    assert!(sections.as_array().unwrap().iter().all(|part| part["checksum"].is_string()));
    write::results(&whole, folder.path()).unwrap();
    let sections = read(folder.path())["sections"].clone();
    assert!(sections.as_array().unwrap().iter().all(|part| part["checksum"].is_null()));
}

#[test]
fn a_page_has_the_command_that_reproduces_it() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("my reports");
    fs::create_dir(&inner).unwrap();
    let (file, page) = (inner.join("mine.toml"), inner.join("page"));
    fs::write(&file, TWO).unwrap();
    let (file, page) = (file.to_str().unwrap(), page.to_str().unwrap());
    assert_eq!(run(&["report", file, "--out", page]).status.code(), Some(0));
    let html = || fs::read_to_string(Path::new(page).join("index.html")).unwrap();
    let line = format!("lcplab report '{file}'");
    let escaped = |text: &str| text.replace('\'', "&#39;").replace('"', "&#34;");
    let has = |line: &str| html().contains(line) || html().contains(&escaped(line));
    assert!(has(&line), "{line}");
    assert!(has(&format!("{line} --section ratio")), "each section's own");

    let again = std::process::Command::new("sh")
        .args(["-c", &line.replacen("lcplab", env!("CARGO_BIN_EXE_lcplab"), 1)])
        .output()
        .unwrap();
    assert_eq!(again.status.code(), Some(0), "{}", err(&again));
    assert!(out(&again).contains("index.html") && has(&line));

    let part = run(&["report", file, "--section", "ratio", "--out", page]);
    assert_eq!(part.status.code(), Some(0), "{}", err(&part));
    let html = fs::read_to_string(Path::new(page).join("ratio/index.html")).unwrap();
    let line = format!("lcplab report '{file}' --section ratio");
    assert!(html.contains(&line) || html.contains(&escaped(&line)), "{line}");
}

#[test]
fn problem_files_make_a_report_of_who_solves_them_and_a_page_of_what_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let set = ["--set", "generate.count=3"];
    for step in ["1", "2"] {
        let file = at(&format!("step-{step}.json"));
        let reported =
            run(&[&["export", "stack", "--step", step, "--out", &file][..], &set].concat());
        assert_eq!(reported.status.code(), Some(0));
    }
    let files = at("step-*.json");
    let text = format!(
        "title = 'Mine'\nlead = ''\n[[section]]\nstudy = 'solved'\nfiles = ['{files}']\n\
         solvers = [{{ solver = 'dantzig' }}]\n\
         [[section]]\nstudy = 'profiles'\nfamilies = ['{files}']\nmax_iterations = 2000\n"
    );
    fs::write(at("mine.toml"), text).unwrap();
    let report = run(&["report", &at("mine.toml"), "--out", &at("page")]);
    assert_eq!(report.status.code(), Some(0));
    let page = fs::read_to_string(at("page/index.html")).unwrap();
    for part in ["problems that have a solution", "step-1", "accepted"] {
        assert!(page.contains(part), "{part}");
    }
    // It is drawn again from its results to the same bytes.
    assert_eq!(run(&["report", &at("page/results.json")]).status.code(), Some(0));
    assert!(page == fs::read_to_string(at("page/index.html")).unwrap());
    // Two sweeps leave half of the weight.
    let folder = folder.path().to_str().unwrap();
    fs::remove_file(at("mine.toml")).unwrap();
    let why = at("why.html");
    run(&["diagnose", folder, "--solver", "pgs", "--sweeps", "2", "--out", &why]);
    assert!(fs::read_to_string(why).unwrap().contains("2 sweeps of pgs leave"));
}

#[test]
fn a_shipped_report_prints_as_a_start_for_one_of_ones_own() {
    let printed = run(&["report", "--print", "friction"]);
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/reports/friction.toml");
    assert_eq!(out(&printed), fs::read_to_string(file).unwrap());
    assert_eq!(run(&["report", "--print", "fiction"]).status.code(), Some(2));
    let schema: serde_json::Value =
        serde_json::from_str(&out(&run(&["report", "--print", "schema"]))).unwrap();
    assert_eq!(schema["title"], "A report of lcplab");
}

#[test]
fn a_figure_alone_is_that_of_the_page() {
    let folder = tempfile::tempdir().unwrap();
    let (file, page) = (folder.path().join("two.toml"), folder.path().join("page"));
    fs::write(&file, TWO).unwrap();
    let [file, page] = [&file, &page].map(|path| path.to_str().unwrap());
    assert_eq!(run(&["report", file, "--out", page]).status.code(), Some(0));
    let results = format!("{page}/results.json");
    for (ending, source) in [("svg", results.as_str()), ("csv", file)] {
        let alone = folder.path().join(format!("alone.{ending}"));
        let out = ["--figure", "ratio_error", "--out", alone.to_str().unwrap()];
        let reported = run(&[&["report", source][..], &out].concat());
        assert_eq!(reported.status.code(), Some(0), "{}", err(&reported));
        let beside = Path::new(page).join(format!("data/ratio_error.{ending}"));
        assert_eq!(fs::read(&alone).unwrap(), fs::read(beside).unwrap());
    }
    let refused = |figure: &str, out: &str| {
        let reported = run(&["report", &results, "--figure", figure, "--out", out]);
        assert_eq!(reported.status.code(), Some(2));
        err(&reported)
    };
    assert!(refused("nothing", "a.svg").contains("named \"nothing\"; there are ratio_error"));
    assert!(refused("ratio_error", "a.png").contains("must end in .svg, .pdf or .csv"));
}

/// In place of Python: a script that notes how it was called and writes the shipped record, or
/// fails.
#[cfg(unix)]
fn report_on_engines(folder: &Path, script: &str, more: &[&str]) -> Output {
    use std::os::unix::fs::PermissionsExt;
    let python = folder.join("python");
    fs::write(&python, format!("#!/bin/sh\n{script}\n")).unwrap();
    fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    command.args(["report", "engines", "--engine", "mujoco,rapier", "--out"]);
    command.arg(folder.join("page")).args(more).env("LCPLAB_PYTHON", python).output().unwrap()
}

#[cfg(unix)]
#[test]
fn engines_that_are_named_run_before_their_page_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let record = concat!(env!("CARGO_MANIFEST_DIR"), "/reports/engines.json");
    let called = folder.path().join("called");
    let script = format!("echo \"$@\" >{}; cp {record} \"$4\"", called.display());
    let output = report_on_engines(folder.path(), &script, &[]);
    assert!(output.status.success(), "{}", err(&output));
    let called = fs::read_to_string(called).unwrap();
    assert!(called.starts_with("-m lcplab.cards --out /"), "{called}");
    assert!(called.ends_with("/engines.json --engine mujoco,rapier\n"), "{called}");
    assert_eq!(
        fs::read(folder.path().join("page/engines.json")).unwrap(),
        fs::read(record).unwrap()
    );
    let page = fs::read_to_string(folder.path().join("page/index.html")).unwrap();
    assert!(page.contains("MuJoCo") && page.contains("--engine mujoco,rapier"));
}

#[cfg(unix)]
#[test]
fn engines_that_do_not_run_are_one_message() {
    let folder = tempfile::tempdir().unwrap();
    for (status, is_missing) in [(1, true), (2, false)] {
        let output = report_on_engines(folder.path(), &format!("exit {status}"), &[]);
        assert_eq!(output.status.code(), Some(2));
        let message = err(&output);
        assert!(message.contains(&format!("ended with exit status: {status}")), "{message}");
        assert_eq!(message.contains("pip install ./python"), is_missing, "{message}");
    }
    let output = report_on_engines(folder.path(), "exit 0", &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("wrote no record"), "{}", err(&output));
    let output = run(&["report", "scenes", "--engine", "mujoco"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("applies to the report engines"), "{}", err(&output));
}

#[cfg(unix)]
#[test]
fn engines_that_take_too_long_end_at_the_time_limit() {
    let folder = tempfile::tempdir().unwrap();
    let called = folder.path().join("called");
    let output = report_on_engines(
        folder.path(),
        &format!("sleep 20; touch {}", called.display()),
        &["--time-limit", "1"],
    );
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("its results are lost"), "{}", err(&output));
    assert!(!called.exists());
}

#[test]
fn no_engine_is_none_and_not_all() {
    let output = run(&["report", "engines", "--engine", ""]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("names no engine"), "{}", err(&output));
}
