//! `--plugin`: a program of the user as a solver.

use serde_json::Value;

use super::{err, out, run};

/// The example of the documentation: Gauss-Seidel that knows no friction.
const SWEEPS: &str =
    concat!("python3 '", env!("CARGO_MANIFEST_DIR"), "/examples/plugins/sweeps.py'");

/// The JSON that a command puts out, and its exit code.
fn message(command: &[&str]) -> (Value, Option<i32>) {
    let output = run(&[command, &["--json"]].concat());
    let json = serde_json::from_str(&out(&output));
    (json.unwrap_or_else(|_| panic!("{}", err(&output))), output.status.code())
}

#[test]
fn a_problem_is_solved_by_a_plug_in_and_judged() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("push.json");
    std::fs::write(&file, r#"{"A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, 2]}"#).unwrap();
    let (answer, code) = message(&["solve", file.to_str().unwrap(), "--plugin", SWEEPS]);
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
    let (table, code) = message(&["compare", path, "--solver", "dantzig", "--plugin", SWEEPS]);
    let rows: Vec<_> = table["rows"].as_array().unwrap().iter().collect();
    let brief = |row: &Value| {
        let file = row["family"].as_str().unwrap().rsplit(['/', '\\']).next().unwrap().to_string();
        (file, row["solver"].clone(), row["accepted"].clone(), row["trouble"].clone())
    };
    let refused = rows.iter().map(|row| brief(row)).collect::<Vec<_>>();
    let of = |file: &str, solver: &str, accepted: u32, trouble: Value| {
        (file.to_string(), Value::from(solver), Value::from(accepted), trouble)
    };
    // x_t = 3 lies 2 beyond its bound; a friction force reaches as far as μ times the 4 of row 0's
    // terms.
    let beyond = "not a solution: scaled residual 1 in row 1, above the tolerance 10⁻⁸";
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

/// A solver of friction cones, of the documentation too.
const CONES: &str = concat!("python3 '", env!("CARGO_MANIFEST_DIR"), "/examples/plugins/cones.py'");

/// A mass of 1, pressed with 2 and pushed with 3 along both tangents, µ = ½: friction takes 1 of
/// it, along (1, 1)/√2.
const CONE: &str = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, -3],
    "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5], "model": "coulomb-cone"}"#;

/// A file of this text, and its folder.
fn file(text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("problem.json");
    std::fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap().to_string();
    (folder, path)
}

#[test]
fn a_plug_in_for_cones_solves_a_cone_and_is_compared() {
    let (_folder, cone) = file(CONE);
    let (answer, code) = message(&["solve", &cone, "--plugin", CONES]);
    assert_eq!(
        (&answer["solver"], &answer["model"], code),
        (&"cones".into(), &"coulomb-cone".into(), Some(0))
    );
    let x: Vec<f64> = answer["x"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
    for (x, exact) in x.iter().zip([2.0, 0.5f64.sqrt(), 0.5f64.sqrt()]) {
        assert!((x - exact).abs() < 1e-9, "{answer}");
    }
    let compare = ["compare", &cone, "--solver", "cone-pgs", "--plugin", CONES];
    let (table, code) = message(&compare);
    let rows = table["rows"].as_array().unwrap();
    let solved: Vec<_> = rows.iter().map(|row| (&row["solver"], &row["accepted"])).collect();
    assert_eq!(solved, [(&"cone-pgs".into(), &1.into()), (&"cones".into(), &1.into())]);
    assert_eq!(code, Some(0));
    let simulated = message(&[
        "simulate",
        "sliding",
        "--steps",
        "3",
        "--model",
        "coulomb-cone",
        "--plugin",
        CONES,
    ]);
    assert_eq!(
        (&simulated.0["solver"], simulated.1),
        (&"cones".into(), Some(0)),
        "{}",
        simulated.0
    );
}

#[test]
fn a_plug_in_for_boxes_never_gets_a_cone_and_says_so() {
    let (_folder, cone) = file(CONE);
    let reason = "it does not declare support for coulomb-cone";
    let output = run(&["solve", &cone, "--plugin", SWEEPS]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        err(&output).starts_with(&format!("error: solver sweeps: model: {reason}")),
        "{}",
        err(&output)
    );
    let (table, code) = message(&["compare", &cone, "--solver", "cone-pgs", "--plugin", SWEEPS]);
    let row = &table["rows"][1];
    assert_eq!(row["solver"], "sweeps");
    assert_eq!(row["trouble"], format!("not run: {reason}"));
    assert_eq!((&row["claimed"], &row["accepted"], code), (&0.into(), &0.into(), Some(1)));
    let (table, code) = message(&[
        "compare",
        "sliding",
        "--steps",
        "1",
        "--model",
        "coulomb-cone",
        "--scheme",
        "velocity",
        "--solver",
        "cone-pgs",
        "--plugin",
        SWEEPS,
    ]);
    assert_eq!(
        table["comparison"]["left_out"],
        serde_json::json!([{ "solver": "sweeps", "reason": reason }])
    );
    assert_eq!((table["comparison"]["runs"].as_array().map(Vec::len), code), (Some(1), Some(0)));
    let alone =
        run(&["compare", "sliding", "--steps", "1", "--model", "coulomb-cone", "--solver", "pgs"]);
    assert_eq!(alone.status.code(), Some(1), "{}", err(&alone));
    assert!(out(&alone).contains("not run: it supports"), "{}", out(&alone));
}

#[test]
fn a_solver_of_cones_is_hunted_under_its_model() {
    let model = ["--model", "coulomb-cone"];
    let search = ["hunt", "--measure", "false-claim", "--evaluations", "300"];
    let (found, code) = message(&[&search[..], &model, &["--plugin", CONES]].concat());
    assert_eq!((&found["found"], code), (&Value::Bool(false), Some(0)), "{found}");
    assert!(found["solved"].as_u64().unwrap() > 50, "{found}");
    let table = run(&[&["hunt", "--problems", "40", "--plugin", CONES], &model[..]].concat());
    assert_eq!(table.status.code(), Some(0), "{}", out(&table));
    assert!(
        out(&table).contains("40 problems with friction under coulomb-cone"),
        "{}",
        out(&table)
    );
    // A file states its model, and the hunt keeps to it.
    let (_folder, cone) = file(CONE);
    let output = run(&[&search[..], &["--from", &cone, "--plugin", SWEEPS]].concat());
    assert_eq!(output.status.code(), Some(2));
    assert!(
        err(&output).contains("it does not declare support for coulomb-cone"),
        "{}",
        err(&output)
    );
}

/// A plug-in of these lines, and its folder.
fn script(name: &str, answer: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("{name}.py"));
    let lines = format!(
        "import json, sys\nfor line in sys.stdin:\n    p = json.loads(line)\n    n = len(p['b'])\n    {answer}\n"
    );
    std::fs::write(&path, lines).unwrap();
    let command = format!("python3 '{}'", path.display());
    (folder, command)
}

#[test]
fn a_plug_in_that_solves_nothing_passes_no_gate() {
    for (name, answer, reason) in [
        ("idle", "print('{\"status\": \"iteration_limit\"}', flush=True)", "iteration limit"),
        ("dies", "print('{\"x\": [1]}' if n == 1 else [][1], flush=True)", "IndexError"),
    ] {
        let (_folder, command) = script(name, answer);
        let compare = ["compare", "pd", "stack", "--solver", "dantzig", "--plugin", &command];
        let output = run(&compare);
        assert_eq!(output.status.code(), Some(1), "{name}");
        let failed = err(&output);
        assert!(failed.contains(&format!("failed: {name} solves none of")), "{failed}");
        assert!(failed.contains(reason), "{failed}");
        let hunt = [
            "hunt",
            "--plugin",
            &command,
            "--measure",
            "false-claim",
            "--n",
            "2..4",
            "--evaluations",
            "60",
        ];
        let output = run(&hunt);
        assert_eq!(output.status.code(), Some(1), "{name}: {}", out(&output));
        assert!(
            err(&output).contains(&format!("failed: {name} solves none of 60")),
            "{}",
            err(&output)
        );
        let table =
            run(&["hunt", "--plugin", &command, "--problems", "5", "--model", "coupled-box"]);
        assert_eq!(table.status.code(), Some(1), "{name}: {}", out(&table));
    }
}

#[test]
fn what_is_found_shows_the_plug_ins_own_answer_and_the_right_one() {
    // Gauss-Seidel whose friction reaches 1/√2 as far as it should.
    let answer = "
    index, mu = p.get('friction_index', [-1] * n), p.get('mu', [0] * n)
    lo, hi = ([float(v) for v in p[key]] for key in ('lo', 'hi'))
    x = [0.0] * n
    for sweep in range(60):
        for i in range(n):
            if index[i] >= 0:
                hi[i] = mu[i] * x[index[i]] / 2**0.5
                lo[i] = -hi[i]
            w = sum(a * v for a, v in zip(p['A']['dense'][i], x)) + p['b'][i]
            x[i] = min(max(x[i] - w / p['A']['dense'][i][i], lo[i]), hi[i])
    print(json.dumps({'x': x}), flush=True)";
    let (folder, command) = script("root", answer);
    let file = folder.path().join("bug.json");
    let hunt = [
        "hunt",
        "--plugin",
        &command,
        "--measure",
        "false-claim",
        "--friction",
        "--out",
        file.to_str().unwrap(),
    ];
    let (found, code) = message(&hunt);
    assert_eq!((&found["found"], code), (&Value::Bool(true), Some(1)));
    let vector = |value: &Value| -> Vec<f64> {
        value.as_array().unwrap().iter().filter_map(Value::as_f64).collect()
    };
    let (own, right) = (vector(&found["x"]), vector(&found["right_x"]));
    assert_eq!((own.len(), right.len()), (3, 3));
    let mu = found["problem"]["mu"][1].as_f64().unwrap();
    let strength = |x: &[f64]| x[1].abs().max(x[2].abs()) / (mu * x[0]);
    assert!((strength(&own) * 2f64.sqrt() - 1.0).abs() < 1e-6, "{found:#}");
    assert!((strength(&right) - 1.0).abs() < 1e-9, "{found:#}");
    let told_file: Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    assert_eq!(vector(&told_file["hunt"]["x"]), own);
    assert_eq!(vector(&told_file["hunt"]["right_x"]), right);
    let test = found["test"].as_str().unwrap();
    assert!(test.starts_with("lcplab solve ") && test.trim() == test, "{test:?}");
    assert!(!test.contains("  ") && !test.contains('\n'), "{test:?}");
    let text = out(&run(&hunt));
    assert!(text.contains("x of root") && text.contains("correct x"), "{text}");
    assert_eq!(run(&["solve", file.to_str().unwrap()]).status.code(), Some(0));
}

#[test]
fn a_start_that_is_not_of_the_class_is_refused() {
    let (_folder, path) = file(r#"{"A": {"dense": [[1, 2], [2, 1]]}, "b": [-1, -1]}"#);
    let hunt = [
        "hunt",
        "--solver",
        "pgs",
        "--measure",
        "false-claim",
        "--from",
        &path,
        "--evaluations",
        "20",
    ];
    let output = run(&[&hunt[..], &["--class", "semidefinite"]].concat());
    assert_eq!(output.status.code(), Some(2));
    let reason = format!(
        "error: start: {path}: A is not symmetric positive semidefinite, even allowing for rounding\n"
    );
    assert_eq!(err(&output), reason);
    let output = run(&hunt);
    assert!(err(&output).contains("the search is not restricted to a class"), "{}", err(&output));
}

#[test]
fn the_hunt_finds_what_a_plug_in_says_that_is_not_true() {
    let output = run(&["hunt", "--problems", "18", "--plugin", SWEEPS]);
    assert_eq!(output.status.code(), Some(1));
    // It takes the bounds of friction rows as they stand: those of a block on a plane are infinite.
    let found = "sweeps on problem 7 (plane-friction): solved, but the scaled residual is";
    assert!(out(&output).contains(found), "{}", out(&output));
    // The command below it writes this problem and repeats the claim.
    let folder = tempfile::tempdir().unwrap();
    let command = format!("hunt --plugin \"{SWEEPS}\" --problem 7 --seed 1 --out bug.json");
    assert!(out(&output).contains(&format!("    lcplab {command}\n")), "{}", out(&output));
    let file = folder.path().join("bug.json");
    let file = file.to_str().unwrap();
    let one = ["hunt", "--plugin", SWEEPS, "--problem", "7", "--seed", "1", "--out", file];
    let output = run(&one);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains(found), "{}", out(&output));
    assert_eq!(message(&["solve", file, "--plugin", SWEEPS]).1, Some(1));
    // Without a false claim, too, and under a model.
    let cone = ["hunt", "--solver", "apgd", "--model", "coulomb-cone", "--problem", "2"];
    assert_eq!(run(&[&cone[..], &["--out", file]].concat()).status.code(), Some(0));
    let problem: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    assert_eq!(problem["model"], "coulomb-cone");
    assert_eq!(run(&["hunt", "--out", file]).status.code(), Some(2));
}

#[test]
fn the_smallest_problem_that_a_plug_in_gets_wrong_is_written_with_its_solution() {
    let folder = tempfile::tempdir().unwrap();
    let in_folder = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (script, file) = (in_folder("forgets.py"), in_folder("bug.json"));
    let right = std::fs::read_to_string("examples/plugins/sweeps.py").unwrap();
    let wrong = right
        .replace("min(max(x[i] - w / A[i][i], lo[i]), hi[i])", "max(x[i] - w / A[i][i], lo[i])");
    assert_ne!(wrong, right);
    std::fs::write(&script, wrong).unwrap(); // forgets the upper bounds
    let (plugin, file) = (format!("python3 {script}"), file.as_str());
    let hunt =
        ["hunt", "--plugin", &plugin, "--measure", "false-claim", "--n", "2..4", "--out", file];
    let [(found, code), (again, _)] = [message(&hunt), message(&hunt)];
    assert_eq!((&found["found"], code), (&Value::Bool(true), Some(1)));
    assert_eq!(found, again); // the same seed finds the same
    // As few rows as asked for, or one more where fewer show less than a tenth of the fault.
    let rows = found["problem"]["b"].as_array().map(Vec::len);
    assert!(matches!(rows, Some(2 | 3)), "{rows:?}");
    assert_eq!(found["problem"]["expected"]["complete"], true);
    // The file shows it again.
    assert_eq!(message(&["solve", file, "--plugin", &plugin]).1, Some(1));
}

#[test]
fn a_search_that_cannot_be_made_is_bad_usage() {
    for (options, reason) in [
        (&["--measure", "false-claim"][..], "give one solver"),
        (&["--measure", "luck", "--solver", "pgs"], "must be false-claim, failure"),
        (&["--measure", "ratio", "--solver", "pgs"], "needs a second solver"),
        (&["--measure", "false-claim", "--solver", "pgs", "--friction", "--n", "2"], "has 3 rows"),
        (&["--measure", "false-claim", "--solver", "cone-pgs"], "only friction cones"),
        (&["--measure", "error", "--solver", "apgd", "--model", "coulomb-cone"], "needs the exact"),
        (&["--measure", "ratio", "pgs"], "a ratio needs two solvers, A:B"),
        (&["--measure", "false-claim", "--solver", "pgs", "--n", "0..3"], "must lie within"),
        (&["--n", "3"], "--measure"),
    ] {
        let output = run(&[&["hunt"], options].concat());
        assert_eq!(output.status.code(), Some(2), "{options:?}");
        assert!(err(&output).contains(reason), "{options:?}: {}", err(&output));
    }
}

#[test]
fn a_command_that_is_no_plug_in_is_bad_usage() {
    let message = |options: &[&str]| {
        let output = run(&[&["hunt", "--problems", "1"], options].concat());
        assert_eq!(output.status.code(), Some(2));
        err(&output)
    };
    let refused = "error: plug-in true: start: it ended (exit status: 0)\n";
    assert_eq!(message(&["--plugin", "true"]), refused);
    let zero = message(&["--plugin", "true", "--plugin-time-limit", "0"]);
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
    { study = "convergence", methods = { problems = [{ problem = "DUMPS/*.json" }], solvers = ["mine", "dantzig"] } },
    { study = "profiles", families = ["DUMPS"], solvers = ["mine", "pgs"], tolerances = [1e-6] },
]
"#,
    );
    let to = folder.path().join("report");
    let report = ["report", &file, "--out", to.to_str().unwrap()];
    let refused = run(&report);
    assert_eq!(refused.status.code(), Some(2));
    let reason =
        format!("plugins: lists commands to run: mine: {SWEEPS}; add --allow-plugins to run them");
    assert!(err(&refused).contains(&reason) && !to.exists(), "{}", err(&refused));
    let allowed = run(&[&report[..], &["--allow-plugins"]].concat());
    assert_eq!(allowed.status.code(), Some(0), "{}", err(&allowed));
    assert!(err(&allowed).starts_with(&format!("plug-in mine: {SWEEPS}\n")));
    assert!(out(&allowed).contains("4 of 4 solvers succeed"), "{}", out(&allowed));
    assert!(
        out(&allowed).contains("4 attempts: 4 reported as solved, 4 answers accepted"),
        "{}",
        out(&allowed)
    );
    // Drawing it again runs nothing.
    let redrawn = run(&["report", to.join("results.json").to_str().unwrap()]);
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
    assert!(out(&collected).contains("2 of 2 tasks collected, 0 impossible, 0 false claims"));
}

#[test]
fn a_scene_is_stepped_by_a_plug_in_and_compared_with_another_solver() {
    let (summary, code) = message(&["simulate", "fig7", "--steps", "1", "--plugin", SWEEPS]);
    assert_eq!((&summary["solver"], code), (&"sweeps".into(), Some(0)), "{summary}");
    let velocity = ["--scheme", "velocity", "--solver", "dantzig", "--plugin", SWEEPS];
    let (message, code) = message(&[&["compare", "fig7", "--steps", "1"], &velocity[..]].concat());
    let runs = message["comparison"]["runs"].as_array().unwrap();
    let solvers: Vec<&Value> = runs.iter().map(|run| &run["solver"]).collect();
    assert_eq!((solvers, code), (vec![&Value::from("dantzig"), &"sweeps".into()], Some(0)));
}
