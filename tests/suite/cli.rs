//! The program as a user runs it: messages, exit codes, pipes.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

const GOOD: &str = r#"{"name": "pair", "A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, 2]}"#;

pub fn run_with(input: &str, arguments: &[&str]) -> Output {
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

pub fn run(arguments: &[&str]) -> Output {
    run_with("", arguments)
}

pub fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn err(output: &Output) -> String {
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
fn scenes_lists_every_joint_with_its_fields() {
    let list = out(&run(&["scenes", "--joints"]));
    for joint in lcplab::constraint::ALL {
        assert!(list.contains(&format!("\n{joint}\n")) || list.starts_with(&format!("{joint}\n")));
    }
    assert!(list.contains("1 or 2 bodies, axis, [point]\n"), "{list}");
}

#[test]
fn solve_tells_people_the_verdict() {
    let output = run_with(GOOD, &["solve", "-"]);
    assert!(out(&output).contains("verdict    proved: an exact solution lies within 0.0e0 of x"));
}

/// A unit mass slides along t1: pressed with 2 N s, pushed with 3, μ = ½. Coulomb: x = (2, 1, 0).
fn pushed() -> String {
    out(&run(&["generate", "pushed-mass", "--set", "degrees=0"]))
}

#[test]
fn friction_problems_are_generated_solved_under_each_model_and_judged() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    };
    let problem = write("pushed.json", &pushed());
    for (model, solver, x) in [
        ("frozen-box", "pgs", [2.0, 1.0, 0.0]),
        ("coupled-box", "dantzig", [2.0, 1.0, 0.0]),
        ("polygon-8", "lemke", [2.0, 1.0, 0.0]),
        ("coulomb-cone", "cone-pgs", [2.0, 1.0, 0.0]),
        ("associated-cone", "clarabel", [2.8, 1.4, 0.0]),
    ] {
        let solved = run(&["solve", &problem, "--model", model, "--solver", solver, "--json"]);
        let answer: Value = serde_json::from_str(&out(&solved)).unwrap();
        assert_eq!((solved.status.code(), &answer["status"]), (Some(0), &"solved".into()));
        assert_eq!((&answer["model"], &answer["solver"]), (&model.into(), &solver.into()));
        for (k, x) in x.iter().enumerate() {
            assert!((answer["x"][k].as_f64().unwrap() - x).abs() < 1e-6, "{model}: {answer}");
        }
        let judged = write("answer.json", &out(&solved));
        assert_eq!(run(&["judge", &problem, &judged, "--model", model]).status.code(), Some(0));
        let other = if model == "associated-cone" { "coulomb-cone" } else { "associated-cone" };
        let refused = run(&["judge", &problem, &judged, "--model", other, "--json"]);
        let verdict: Value = serde_json::from_str(&out(&refused)).unwrap();
        assert_eq!(
            (refused.status.code(), &verdict["verdict"]),
            (Some(1), &"not_a_solution".into())
        );
    }
}

#[test]
fn a_solver_for_cones_or_the_file_chooses_the_model() {
    let chosen = |text: &str, arguments: &[&str]| {
        let output = run_with(text, &[&["solve", "-", "--json"], arguments].concat());
        let answer: Value = serde_json::from_str(&out(&output)).unwrap();
        answer["model"].as_str().map(str::to_string)
    };
    let stated = pushed().replacen('{', "{\"model\": \"polygon-12\", ", 1);
    assert_eq!(chosen(&pushed(), &[]), None); // the boxed LCP as it stands
    assert_eq!(chosen(&pushed(), &["--solver", "cone-pgs"]).as_deref(), Some("coulomb-cone"));
    assert_eq!(chosen(&stated, &[]).as_deref(), Some("polygon-12"));
    assert_eq!(chosen(&stated, &["--model", "frozen-box"]).as_deref(), Some("frozen-box"));
}

#[test]
fn a_scene_with_friction_is_solved_under_coulombs_law() {
    let exported = out(&run(&["export", "incline"]));
    let output = run_with(&exported, &["solve", "-", "--model", "coulomb-cone", "--json"]);
    let answer: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((output.status.code(), &answer["status"]), (Some(0), &"solved".into()));
    for contact in answer["contacts"].as_array().unwrap() {
        // The box slides: full friction, straight against the slip.
        assert!((contact["strength"].as_f64().unwrap() - 1.0).abs() < 1e-6, "{contact}");
        assert!(contact["misalignment"].as_f64().unwrap() < 1e-3, "{contact}");
    }
}

#[test]
fn models_that_do_not_fit_are_bad_usage_with_one_message() {
    for (text, arguments, message) in [
        (
            GOOD,
            ["--model", "coulomb-cone"],
            "error: -: friction_index: is missing: coulomb-cone is",
        ),
        (GOOD, ["--solver", "cone-pgs"], "error: -: friction_index: is missing: coulomb-cone is"),
        (
            &pushed(),
            ["--model", "sphere"],
            "error: invalid value 'sphere' for '--model <MODEL>': there",
        ),
        (
            &pushed(),
            ["--model", "polygon-6"],
            "error: invalid value 'polygon-6' for '--model <MODEL>':",
        ),
    ] {
        let output = run_with(text, &[&["solve", "-"][..], &arguments].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).starts_with(message), "{}", err(&output));
    }
    let arguments = ["solve", "-", "--model", "coulomb-cone", "--solver", "pgs"];
    assert_eq!(
        err(&run_with(&pushed(), &arguments)),
        "error: there is no solver for this model of friction named \"pgs\"; there are cone-pgs, apgd\n"
    );
    let mut unfrozen: Value = serde_json::from_str(&pushed()).unwrap();
    unfrozen.as_object_mut().unwrap().remove("frozen_at");
    let output = run_with(&unfrozen.to_string(), &["solve", "-", "--model", "frozen-box"]);
    assert!(err(&output).starts_with("error: -: frozen_at: is missing"), "{}", err(&output));
}

#[test]
fn sweeps_in_another_order_end_at_the_same_x_by_another_path() {
    let stack = out(&run(&["generate", "stack", "--n", "5"]));
    let answer = |arguments: &[&str]| {
        let all = [&["solve", "-", "--solver", "pgs", "--json"], arguments].concat();
        let output = run_with(&stack, &all);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        serde_json::from_str::<Value>(&out(&output)).unwrap()
    };
    let natural = answer(&[]);
    assert_eq!(answer(&["--order", "natural"]), natural);
    let shuffled = answer(&["--order", "shuffled", "--seed", "3"]);
    assert_eq!(answer(&["--order", "shuffled", "--seed", "3"]), shuffled);
    assert_ne!(answer(&["--order", "shuffled", "--seed", "4"])["x"], shuffled["x"]);
    for other in [answer(&["--order", "reverse"]), shuffled] {
        assert_ne!(other["x"], natural["x"]);
        for k in 0..5 {
            // Contact k carries the 5 − k bodies above it.
            assert!((other["x"][k].as_f64().unwrap() - (5 - k) as f64).abs() < 1e-4, "{other}");
        }
    }
}

#[test]
fn an_option_that_no_solver_of_the_command_uses_is_bad_usage() {
    for (arguments, message) in [
        (
            &["solve", "-", "--order", "reverse"][..],
            "error: options: --order: dantzig does not use it; pgs and sor do\n",
        ),
        (
            &["solve", "-", "--solver", "pgs", "--damping", "0.5"],
            "error: options: --damping: pgs does not use it; jacobi does\n",
        ),
        (
            &["solve", "-", "--solver", "pgs", "--seed", "5"],
            "error: options: --seed: needs --order shuffled\n",
        ),
        (
            &["compare-solvers", "stack", "--solver", "lemke", "--solver", "pgs", "--omega", "1.5"],
            "error: options: --omega: none of these solvers uses it; sor and ssor do\n",
        ),
        (
            &["simulate", "fig6", "--steps", "1", "--solver", "dantzig", "--omega", "1.5"],
            "error: options: --omega: dantzig does not use it; sor and ssor do\n",
        ),
        (
            &["solve", "-", "--solver", "jacobi", "--damping", "2"],
            "error: settings: damping: must lie between 0 and 2, is 2\n",
        ),
    ] {
        let output = run_with(GOOD, arguments);
        assert_eq!((output.status.code(), err(&output)), (Some(2), message.to_string()));
    }
    let output = run(&[
        "compare-solvers",
        "stack",
        "--solver",
        "sor",
        "--solver",
        "lemke",
        "--omega",
        "1.5",
    ]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(err(&output), "note: --omega goes to sor alone\n");
}

#[test]
fn a_scene_is_stepped_in_the_order_asked_for() {
    let sweeps = |arguments: &[&str]| {
        let all = ["simulate", "stack", "--steps", "2", "--solver", "pgs", "--json"];
        let output = run(&[&all[..], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        out(&output)
    };
    assert_eq!(sweeps(&["--order", "natural"]), sweeps(&[]));
    assert_ne!(sweeps(&["--order", "reverse"]), sweeps(&[]));
}

#[test]
fn the_comparison_has_clarabel_beside_the_solvers_and_a_row_a_model() {
    let output = run(&["compare-solvers", "pushed-mass", "stack", "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let result: Value = serde_json::from_str(&out(&output)).unwrap();
    let rows = result["rows"].as_array().unwrap();
    let of = |family: &str, solver: &str| -> Vec<&Value> {
        let of_this = |row: &&Value| row["family"] == family && row["solver"] == solver;
        rows.iter().filter(of_this).map(|row| &row["model"]).collect()
    };
    assert_eq!(of("stack", "clarabel"), [&Value::Null]);
    assert_eq!(of("pushed-mass", "clarabel"), ["frozen-box", "associated-cone"]);
    assert_eq!(of("pushed-mass", "cone-pgs"), ["associated-cone", "coulomb-cone"]);
    assert_eq!(of("pushed-mass", "lemke").len(), 5);
    let none = run(&["compare-solvers", "stack", "--model", "coulomb-cone"]);
    assert_eq!(none.status.code(), Some(2));
    assert_eq!(err(&none), "error: options: --model: none of these families has friction\n");
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
    let page = std::fs::read_to_string(folder.path().join("index.html")).unwrap();
    assert!(page.contains("\"steps\":[0,1,2,3,4,5,6,7]"), "all instants can be played");
}

#[test]
fn compare_shows_the_solvers_asked_for_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let all = ["compare", "pendulum", "--steps", "3", "--solver", "dantzig", "--out", path];
    assert_eq!(
        run(&[&all[..], &["--show", "pgs:1", "--show", "dantzig"]].concat()).status.code(),
        Some(0)
    );
    let page = std::fs::read_to_string(folder.path().join("index.html")).unwrap();
    let names: Vec<_> = page
        .split("<p class=\"take\">")
        .skip(1)
        .map(|rest| rest.split('<').next().unwrap())
        .collect();
    assert_eq!(names, ["pgs, velocity, 1 sweep", "dantzig, velocity"]);
    for (name, reason) in [("pgs:0", "is no number of sweeps"), ("magic", "magic")] {
        let output = run(&[&all[..], &["--show", name]].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).contains(reason), "{}", err(&output));
    }
}

#[test]
fn simulate_draws_as_many_instants_as_asked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    for (frames, shown) in [(None, 6), (Some("3"), 3), (Some("60"), 11)] {
        let mut arguments = vec!["simulate", "pendulum", "--steps", "10", "--out", path, "--json"];
        arguments.extend(frames.iter().flat_map(|frames| ["--frames", frames]));
        assert_eq!(run(&arguments).status.code(), Some(0));
        let svg = std::fs::read_to_string(folder.path().join("frames.svg")).unwrap();
        assert_eq!(svg.matches("class=\"instant\"").count(), shown); // the start and 10 steps
    }
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

#[test]
fn explain_writes_each_form_and_refuses_what_it_does_not_know() {
    let text = out(&run(&["explain", "fig6", "--solver", "pgs"]));
    assert!(text.contains("x₀ = 2 N s") && !text.contains('\u{1b}'), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("fig6.html");
    let page = page.to_str().unwrap();
    assert_eq!(run(&["explain", "fig6", "--format", "html", "--out", page]).status.code(), Some(0));
    assert!(std::fs::read_to_string(page).unwrap().starts_with("<!DOCTYPE html>"));
    let problem = run_with(GOOD, &["explain", "-", "--format", "markdown"]);
    assert!(out(&problem).starts_with("# pair, by dantzig\n"));
    for (arguments, message) in [
        (&["fig6", "--solver", "simplex"][..], "there are pgs, sor, dantzig, lemke"),
        (&["fig6", "--format", "pdf"], "possible values: text, markdown, html"),
        (&["fig6", "--solver", "pgs", "--omega", "1.2"], "pgs does not use it; sor does"),
        (&["fig6", "--solver", "sor", "--omega", "2.5"], "must lie between 0 and 2, is 2.5"),
        (&["-", "--steps", "2"], "--steps: is for scenes, this is a problem"),
        (&["nothing"], "there is no scene file or shipped scene named \"nothing\""),
    ] {
        let refused = run(&[&["explain"], arguments].concat());
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}");
        assert!(err(&refused).contains(message), "{arguments:?}: {}", err(&refused));
    }
}

#[test]
fn verify_prints_a_row_a_closed_form_and_says_how_many_pass() {
    let table = run(&["verify", "--only", "free-fall", "--fast"]);
    assert_eq!(table.status.code(), Some(0), "{}", err(&table));
    assert!(out(&table).ends_with("8 of 8 rows pass\n"), "{}", out(&table));
    let json = run(&["verify", "--only", "free-fall", "--fast", "--json"]);
    let page: Value = serde_json::from_str(&out(&json)).unwrap();
    // Semi-implicit Euler's height is of first order: the derived order, and the observed one.
    let row = &page["rows"][1];
    assert_eq!(row["row"]["criterion"]["order"], 1.0);
    assert!((row["observed_order"].as_f64().unwrap() - 1.0).abs() < 0.1, "{row}");
    let unknown = run(&["verify", "--only", "free-fly"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(err(&unknown).contains("there is no closed form named \"free-fly\""));
}

#[test]
fn a_scene_is_stepped_and_exported_under_the_model_that_is_asked_for() {
    let summary = |arguments: &[&str]| -> Value {
        let all = [&["simulate", "sliding", "--steps", "5", "--json"], arguments].concat();
        let output = run(&all);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        serde_json::from_str(&out(&output)).unwrap()
    };
    let cone = summary(&["--model", "coulomb-cone"]);
    assert_eq!((&cone["model"], &cone["solver"]), (&"coulomb-cone".into(), &"apgd".into()));
    assert_eq!((&cone["problems"], &cone["accepted"]), (&5.into(), &5.into()));
    let sweeps = summary(&["--model", "coulomb-cone", "--solver", "cone-pgs"]);
    assert_eq!(sweeps["solver"], "cone-pgs");
    let plain = summary(&[]);
    assert_eq!((&plain["model"], &plain["solver"]), (&"coupled-box".into(), &"dantzig".into()));
    for model in ["frozen-box", "polygon-8", "coulomb-cone"] {
        let exported = run(&["export", "sliding", "--step", "3", "--model", model]);
        let problem: Value = serde_json::from_str(&out(&exported)).unwrap();
        assert_eq!(problem["model"], model);
        let solved = run_with(&out(&exported), &["solve", "-"]);
        assert_eq!(solved.status.code(), Some(0), "{model}: {}", out(&solved));
    }
}

#[test]
fn a_model_goes_with_solvers_and_families_that_take_it() {
    for (arguments, message) in [
        (
            vec!["simulate", "sliding", "--model", "coulomb-cone", "--solver", "pgs"],
            "error: there is no solver for this model of friction named \"pgs\"; there are cone-pgs, apgd",
        ),
        (
            vec!["simulate", "sliding", "--model", "polygon-8", "--formulation", "soft"],
            "error: sliding: contact.model: the family soft rubs row by row and knows \"coupled-box\" only",
        ),
    ] {
        let output = run(&arguments);
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).starts_with(message), "{}", err(&output));
    }
    let all = ["compare", "sliding", "--steps", "2", "--model", "associated-cone", "--json"];
    let result: Value = serde_json::from_str(&out(&run(&all))).unwrap();
    let runs = result["comparison"]["runs"].as_array().unwrap();
    let of = |key: &str| runs.iter().map(|run| run[key].as_str().unwrap()).collect::<Vec<_>>();
    assert_eq!(of("solver"), ["cone-pgs", "apgd"]);
    assert_eq!(of("formulation"), ["velocity", "velocity"]); // the other level does not know it
}

#[test]
fn a_report_is_not_begun_if_nothing_can_print_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    command.args(["report", "chapter", "--pdf", "--out"]).arg(path.join("out")).env("PATH", path);
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        err(&output),
        "error: --pdf: PATH: has none of chromium, chromium-browser, google-chrome, one of which prints the \
         page\n"
    );
    assert!(!path.join("out").exists());
}

#[test]
fn problems_are_converted_and_taken_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    for name in ["good.mtx", "good.npz", "good.qps", "good.dat"] {
        let written = run_with(GOOD, &["convert", "-", &path(name)]);
        assert_eq!((written.status.code(), err(&written).as_str()), (Some(0), ""), "{name}");
        let solved = run(&["solve", &path(name), "--json"]);
        let answer: Value = serde_json::from_str(&out(&solved)).unwrap();
        assert_eq!((&answer["verdict"], &answer["x"]), (&"proved".into(), &serde_json::json!([0.5, 0.0])));
        assert_eq!(run(&["diagnose", &path(name)]).status.code(), Some(0));
    }
    let back = run(&["convert", &path("good"), "-"]); // the stem of good.mtx
    let problem: Value = serde_json::from_str(&out(&back)).unwrap();
    assert_eq!(problem["b"], serde_json::json!([-1.0, 2.0]));
    let compared = run(&["compare-solvers", &path("good.npz"), "--solver", "pgs", "--json"]);
    let rows: Value = serde_json::from_str(&out(&compared)).unwrap();
    assert_eq!((&rows["rows"][0]["accepted"], compared.status.code()), (&1.into(), Some(0)));
}

#[test]
fn what_a_format_cannot_carry_is_refused_or_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let refused = run_with(&pushed(), &["convert", "-", &path("pushed.qps")]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(err(&refused).contains("qps: friction_index: is given"));
    let named = run_with(&pushed(), &["convert", "-", &path("pushed.npz")]);
    assert_eq!(err(&named), "note: left behind: source, frozen_at\n");
    assert!(err(&run_with(GOOD, &["convert", "-", "-", "--to", "npz"])).contains("it needs a file"));
    assert!(out(&run(&["convert", "--list"])).contains("siconos        Siconos: "));
}
