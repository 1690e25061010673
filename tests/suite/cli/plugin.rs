//! `--plugin`: someone else's program as a solver.

use serde_json::Value;

use super::{err, out, run};

/// The example of the documentation: Gauss-Seidel that knows no friction.
const SWEEPS: &str =
    concat!("python3 '", env!("CARGO_MANIFEST_DIR"), "/examples/plugins/sweeps.py'");

/// The JSON that a command puts out, and its exit code.
fn told(command: &[&str]) -> (Value, Option<i32>) {
    let output = run(&[command, &["--json"]].concat());
    let json = serde_json::from_str(&out(&output));
    (json.unwrap_or_else(|_| panic!("{}", err(&output))), output.status.code())
}

#[test]
fn a_problem_is_solved_by_a_plug_in_and_judged() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("push.json");
    std::fs::write(&file, r#"{"A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, 2]}"#).unwrap();
    let (answer, code) = told(&["solve", file.to_str().unwrap(), "--plugin", SWEEPS]);
    assert_eq!((&answer["solver"], &answer["status"]), (&"sweeps".into(), &"solved".into()));
    assert_eq!((&answer["verdict"], code), (&"proved".into(), Some(0)));
    assert_eq!(answer["x"], serde_json::json!([0.5, 0.0]));
}

#[test]
fn a_folder_of_problems_shows_which_claims_are_wrong_and_in_which_row() {
    let folder = tempfile::tempdir().unwrap();
    let plain = r#"{"A": {"dense": [[2]]}, "b": [-4]}"#;
    // x_n = 2; the tangent is pushed with 3, and friction may be 1 of it.
    let friction = r#"{"A": {"dense": [[1, 0], [0, 1]]}, "b": [-2, -3], "friction_index": [-1, 0], "mu": [0, 0.5]}"#;
    for (name, text) in [("a.json", plain), ("b.json", friction), ("notes.md", "not a problem")] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let path = folder.path().to_str().unwrap();
    let (table, code) = told(&["compare-solvers", path, "--solver", "dantzig", "--plugin", SWEEPS]);
    let rows: Vec<_> = table["rows"].as_array().unwrap().iter().collect();
    let brief = |row: &Value| {
        let file = row["family"].as_str().unwrap().rsplit(['/', '\\']).next().unwrap().to_string();
        (file, row["solver"].clone(), row["accepted"].clone(), row["trouble"].clone())
    };
    let refused = rows.iter().map(|row| brief(row)).collect::<Vec<_>>();
    let of = |file: &str, solver: &str, accepted: u32, trouble: Value| {
        (file.to_string(), Value::from(solver), Value::from(accepted), trouble)
    };
    // x_t = 3 lies 2 beyond its bound; a friction force reaches as far as μ times the 4 of row 0's terms.
    let beyond = "not a solution: row 1 misses by 1 of its terms";
    assert_eq!(
        refused,
        [
            of("a.json", "dantzig", 1, Value::Null),
            of("a.json", "sweeps", 1, Value::Null),
            of("b.json", "dantzig", 1, Value::Null),
            of("b.json", "sweeps", 0, beyond.into()),
        ]
    );
    assert_eq!(code, Some(1));
}

#[test]
fn the_hunt_finds_what_a_plug_in_says_that_is_not_true() {
    let output = run(&["hunt", "--problems", "18", "--plugin", SWEEPS]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        out(&output).contains("sweeps on problem 6 (friction): solved, but row"),
        "{}",
        out(&output)
    );
}

#[test]
fn the_smallest_problem_that_a_plug_in_gets_wrong_is_written_with_its_solution() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bug.json");
    let file = file.to_str().unwrap();
    let hunt = ["hunt", "--plugin", SWEEPS, "--measure", "lie", "--n", "2..4", "--out", file];
    let [(found, code), (again, _)] = [told(&hunt), told(&hunt)];
    assert_eq!((&found["found"], code), (&Value::Bool(true), Some(1)));
    assert_eq!(found, again); // the same seed finds the same
    assert_eq!(found["problem"]["b"].as_array().map(Vec::len), Some(2)); // as small as it was asked for
    assert_eq!(found["problem"]["expected"]["complete"], true);
    // The file shows it again.
    assert_eq!(told(&["solve", file, "--plugin", SWEEPS]).1, Some(1));
}

#[test]
fn a_search_that_cannot_be_made_is_bad_usage() {
    for (options, reason) in [
        (&["--measure", "lie"][..], "one solver is hunted"),
        (&["--measure", "luck", "--solver", "pgs"], "must be lie, failure"),
        (&["--measure", "ratio", "--solver", "pgs"], "needs a rival"),
        (&["--measure", "ratio", "pgs"], "of two solvers, A:B"),
        (&["--measure", "lie", "--solver", "pgs", "--n", "0..3"], "must lie within"),
        (&["--n", "3"], "--measure"),
    ] {
        let output = run(&[&["hunt"], options].concat());
        assert_eq!(output.status.code(), Some(2), "{options:?}");
        assert!(err(&output).contains(reason), "{options:?}: {}", err(&output));
    }
}

#[test]
fn a_command_that_is_no_plug_in_is_bad_usage() {
    let told = |options: &[&str]| {
        let output = run(&[&["hunt", "--problems", "1"], options].concat());
        assert_eq!(output.status.code(), Some(2));
        err(&output)
    };
    let refused = "error: plug-in true: start: it ended (exit status: 0)\n";
    assert_eq!(told(&["--plugin", "true"]), refused);
    let zero = told(&["--plugin", "true", "--plugin-time-limit", "0"]);
    assert_eq!(zero, "error: plug-in true: time_limit: must be above 0, is 0\n");
}

/// A folder with two problems that the example solves, and a file whose studies name a plug-in.
fn declared(text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    for (name, b) in [("a", -1), ("b", -3)] {
        let text = format!(r#"{{"A": {{"dense": [[2, -1], [-1, 2]]}}, "b": [{b}, 2]}}"#);
        std::fs::write(folder.path().join(format!("{name}.json")), text).unwrap();
    }
    let file = folder.path().join("mine.toml");
    let plugins = format!("[plugins.mine]\ncommand = {SWEEPS:?}\n");
    std::fs::write(&file, text.replace("DUMPS", folder.path().to_str().unwrap()) + &plugins)
        .unwrap();
    let file = file.to_str().unwrap().to_string();
    (folder, file)
}

#[test]
fn a_report_runs_the_plug_ins_that_it_declares_if_it_is_allowed_to() {
    let (folder, file) = declared(
        r#"
title = "Mine"
lead = "Mine beside others."
section = [
    { study = "race", problems = [{ problem = "DUMPS/*.json" }], solvers = ["mine", "dantzig"] },
    { study = "profiles", families = ["DUMPS"], solvers = ["mine", "pgs"], tolerances = [1e-6] },
]
"#,
    );
    let to = folder.path().join("report");
    let report = ["report", &file, "--out", to.to_str().unwrap()];
    let refused = run(&report);
    assert_eq!(refused.status.code(), Some(2));
    let reason = format!("plugins: would run mine: {SWEEPS}; --allow-plugins lets it");
    assert!(err(&refused).contains(&reason) && !to.exists(), "{}", err(&refused));
    let allowed = run(&[&report[..], &["--allow-plugins"]].concat());
    assert_eq!(allowed.status.code(), Some(0), "{}", err(&allowed));
    assert!(err(&allowed).starts_with(&format!("plug-in mine: {SWEEPS}\n")));
    assert!(out(&allowed).contains("4 of 4 arrived"), "{}", out(&allowed));
    assert!(
        out(&allowed).contains("4 attempts, 4 claimed solved, 4 accepted"),
        "{}",
        out(&allowed)
    );
    // Drawing it again runs nothing.
    let redrawn = run(&["report", "--redraw", to.to_str().unwrap()]);
    assert_eq!((redrawn.status.code(), err(&redrawn)), (Some(0), String::new()));
}

#[test]
fn a_grid_runs_the_plug_ins_that_it_declares_if_it_is_allowed_to() {
    let (folder, file) = declared(
        r#"
family = "stack"
measure = "iterations"
axes.solver.name = ["mine", "dantzig"]
"#,
    );
    let to = folder.path().join("grid");
    let grid = ["grid", "run", &file, "--out", to.to_str().unwrap()];
    assert_eq!(run(&grid).status.code(), Some(2));
    let allowed = run(&[&grid[..], &["--allow-plugins"]].concat());
    assert_eq!(out(&allowed), "2 of 2 tasks run, 0 were done before\n", "{}", err(&allowed));
    let collected = run(&["grid", "collect", &file, "--out", to.to_str().unwrap()]);
    assert!(out(&collected).contains("2 of 2 tasks collected, 0 impossible, 0 claims refuted"));
}

#[test]
fn a_scene_is_stepped_by_a_plug_in_and_compared_with_another_solver() {
    let (summary, code) = told(&["simulate", "fig7", "--steps", "1", "--plugin", SWEEPS]);
    assert_eq!((&summary["solver"], code), (&"sweeps".into(), Some(0)), "{summary}");
    let velocity = ["--scheme", "velocity", "--solver", "dantzig", "--plugin", SWEEPS];
    let (told, code) = told(&[&["compare", "fig7", "--steps", "1"], &velocity[..]].concat());
    let runs = told["comparison"]["runs"].as_array().unwrap();
    let solvers: Vec<&Value> = runs.iter().map(|run| &run["solver"]).collect();
    assert_eq!((solvers, code), (vec![&Value::from("dantzig"), &"sweeps".into()], Some(0)));
}
