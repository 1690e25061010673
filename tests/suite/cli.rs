//! The program as a user runs it: messages, exit codes, pipes.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

const GOOD: &str = r#"{"name": "pair", "A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, 2]}"#;

fn run_with(input: &str, arguments: &[&str]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lcplab"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // A program that refuses its arguments need not read its input.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn run(arguments: &[&str]) -> Output {
    run_with("", arguments)
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn solve_prints_one_json_object_with_the_fixed_keys() {
    for solver in ["pgs", "sor", "dantzig"] {
        let output = run_with(GOOD, &["solve", "-", "--solver", solver, "--json"]);
        assert_eq!(output.status.code(), Some(0));
        let answer: Value = serde_json::from_str(&out(&output)).unwrap();
        assert_eq!((&answer["status"], &answer["solver"]), (&"solved".into(), &solver.into()));
        for key in ["x", "w", "iterations", "natural_residual", "verdict", "message"] {
            assert!(answer.get(key).is_some(), "{key}");
        }
        assert_eq!(answer["x"].as_array().unwrap().len(), 2);
    }
}

#[test]
fn without_a_name_the_matrix_chooses_the_solver() {
    let skew = r#"{"A": {"dense": [[0, -1], [1, 1]]}, "b": [1, -2]}"#;
    for (problem, solver) in [(GOOD, "dantzig"), (skew, "lemke")] {
        let output = run_with(problem, &["solve", "-", "--json"]);
        let answer: Value = serde_json::from_str(&out(&output)).unwrap();
        assert_eq!((output.status.code(), &answer["solver"]), (Some(0), &solver.into()));
    }
}

#[test]
fn a_generated_problem_is_solved_from_the_pipe() {
    let fathi = run(&["generate", "fathi", "--n", "4", "--set", "reversed=1"]);
    let output = run_with(&out(&fathi), &["solve", "-", "--json"]);
    let answer: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((&answer["verdict"], &answer["iterations"]), (&"proved".into(), &1.into()));
    let wrong = run(&["generate", "fathi", "--seed", "4"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(err(&wrong).contains("fathi: seed: is no parameter of this family"));
    assert!(out(&run(&["problems"])).contains("\nfathi "));
    assert!(out(&run(&["problems", "stack"])).contains("ratio"));
}

#[test]
fn solve_tells_people_the_verdict() {
    let output = run_with(GOOD, &["solve", "-"]);
    assert!(out(&output).contains("verdict    proved: an exact solution lies within 0.0e0 of x"));
}

#[test]
fn an_answer_the_judge_refuses_exits_with_1() {
    let output =
        run_with(GOOD, &["solve", "-", "--solver", "sor", "--max-iterations", "1", "--json"]);
    let answer: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(answer["verdict"], "not_a_solution");
    assert_ne!(answer["status"], "solved");
}

#[test]
fn a_problem_without_solution_is_called_infeasible_only_with_proof() {
    let torn = r#"{"A": {"dense": [[1, 1], [1, 1]]}, "b": [-1, -2], "lo": ["-inf", "-inf"]}"#;
    let output = run_with(torn, &["solve", "-", "--json"]);
    let answer: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((output.status.code(), &answer["status"]), (Some(1), &"infeasible".into()));
}

#[test]
fn judge_accepts_and_refuses_answers_from_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    };
    let problem = write("problem.json", GOOD);
    let right = write("right.json", r#"{"x": [0.5, 0], "by": "hand"}"#);
    let wrong = write("wrong.json", r#"{"x": [0.5, 0.1]}"#);
    let short = write("short.json", r#"{"x": [0.5]}"#);
    assert_eq!(run(&["judge", &problem, &right]).status.code(), Some(0));
    let output = run(&["judge", &problem, &wrong, "--json"]);
    let verdict: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((output.status.code(), &verdict["verdict"]), (Some(1), &"not_a_solution".into()));
    let output = run(&["judge", &problem, &short]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).ends_with("short.json: x: has 1 entries, the problem has 2 rows\n"));
}

#[test]
fn bad_input_exits_with_2_and_one_message() {
    let no_file = run(&["solve", "no such file.json"]);
    assert_eq!(no_file.status.code(), Some(2));
    assert!(err(&no_file).starts_with("error: no such file.json: "));
    let no_json = run_with("{", &["solve", "-"]);
    assert_eq!((no_json.status.code(), out(&no_json)), (Some(2), String::new()));
    assert!(err(&no_json).starts_with("error: -: line 1, column 1: not valid JSON"));
    let no_solver = run_with(GOOD, &["solve", "-", "--solver", "magic"]);
    assert_eq!(no_solver.status.code(), Some(2));
    assert!(
        err(&no_solver).starts_with("error: there is no solver named \"magic\"; there are pgs")
    );
    for (option, value) in [("--tolerance", "-1"), ("--tolerance", "nan"), ("--omega", "2")] {
        let output = run_with(GOOD, &["solve", "-", &format!("{option}={value}")]);
        assert_eq!(output.status.code(), Some(2), "{option} {value}");
    }
}

#[test]
fn a_reader_who_goes_away_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lcplab"))
        .args(["solve", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    child.stdin.take().unwrap().write_all(GOOD.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), err(&output)), (Some(0), String::new()));
}

#[test]
fn every_command_has_help_with_an_example() {
    let overview = out(&run(&["--help"]));
    let commands = overview.split("Commands:").nth(1).unwrap().split("Options:").next().unwrap();
    let names = commands.lines().filter_map(|line| line.split_whitespace().next());
    for name in names.filter(|name| *name != "help") {
        let help = out(&run(&[name, "--help"]));
        assert!(help.contains("Example:\n  "), "{name} --help shows no example");
    }
}

#[test]
fn an_exported_step_is_solved_like_any_other_problem() {
    let exported = run(&["export", "fig7", "--step", "1"]);
    let problem: Value = serde_json::from_str(&out(&exported)).unwrap();
    assert_eq!(problem["rows"][0]["kind"], "normal");
    assert_eq!((&problem["rows"][0]["unit"], &problem["dt"]), (&"N s".into(), &1.0.into()));
    let solved = run_with(&out(&exported), &["solve", "-", "--json"]);
    let answer: Value = serde_json::from_str(&out(&solved)).unwrap();
    assert_eq!(answer["x"], serde_json::json!([4.0, 3.0, 1.0])); // errata, part 3
    assert_eq!(err(&solved), "");
}

#[test]
fn simulate_records_every_step_and_body() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let output = run(&["simulate", "pendulum", "--steps", "7", "--out", path, "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let summary: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((&summary["steps"], &summary["refuted_claims"]), (&7.into(), &0.into()));
    let lines =
        |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap().lines().count();
    assert_eq!((lines("ledger.csv"), lines("trajectory.csv")), (9, 9)); // heading, start, 7 steps
}

#[test]
fn compare_takes_a_scene_that_is_not_shipped() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let mine = out(&run(&["scenes", "fig7"])).replace("mass = 1", "mass = 2");
    std::fs::write(&path, mine).unwrap();
    let output = run(&["compare", path.to_str().unwrap(), "--steps", "1", "--json"]);
    let result: Value = serde_json::from_str(&out(&output)).unwrap();
    let runs = result["comparison"]["runs"].as_array().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(runs.iter().all(|run| run["claimed"] == run["accepted"]));
    let bad = out(&run(&["scenes", "fig7"])).replace("mass = 1", "mass = -1");
    std::fs::write(&path, bad).unwrap();
    let output = run(&["compare", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("bodies[1].mass: must be positive, is -1"), "{}", err(&output));
}

#[test]
fn a_family_is_chosen_on_the_command_line() {
    let families = |args: &[&str]| -> Vec<(String, String)> {
        let result: Value = serde_json::from_str(&out(&run(args))).unwrap();
        let runs = result["comparison"]["runs"].as_array().unwrap();
        let word = |run: &Value, key: &str| run[key].as_str().unwrap().to_string();
        runs.iter().map(|run| (word(run, "formulation"), word(run, "solver"))).collect()
    };
    let levels = families(&["compare", "fig7", "--steps", "1", "--json", "--solver", "pgs"]);
    assert_eq!(
        levels.iter().map(|run| run.0.as_str()).collect::<Vec<_>>(),
        ["velocity", "acceleration"]
    );
    let soft = ["compare", "fig7", "--steps", "1", "--json", "--formulation", "soft"];
    assert_eq!(families(&soft), [("soft".into(), "none".into())]);
    let output = run(&["simulate", "painleve", "--formulation", "acceleration"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("no solution exists"), "{}", out(&output));
}

#[test]
fn a_scene_whose_solver_does_not_exist_is_refused() {
    let output = run(&["simulate", "fig6", "--solver", "magic"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).starts_with("error: there is no solver named \"magic\""));
}
