//! `lcplab test`: a solver on problems, and a recorded run.

use std::path::Path;

use serde_json::{Value, json};

use super::{err, out, run};

/// x = b/2, row by row, of diagonal problems; what else it does is set by the settings: a wrong
/// answer, a crash, many iterations, a residual of 1e-9.
const SOLVER: &str = r#"
import json, os, struct, sys
for line in sys.stdin:
    p = json.loads(line)
    n = len(p["b"])
    x = [max(0.0, -b / p["A"]["dense"][i][i]) for i, b in enumerate(p["b"])]
    answer = {"status": "solved", "iterations": 10}
    bug = os.environ.get("BUG", "") if n > 1 else ""
    if bug == "crash": sys.exit(3)
    if bug == "wrong": x[0] += 1
    if bug == "gives up": answer["status"] = "iteration_limit"; x[0] += 1
    if bug == "slow": answer["iterations"] = 21
    if bug == "loose": x[0] *= 1 + 1e-9
    if bug.startswith("single"): x = list(struct.unpack(f"{n}f", struct.pack(f"{n}f", *x)))
    if bug == "single, wrong": x[0] *= 1.1
    print(json.dumps({"x": x, **answer}), flush=True)
"#;

/// A folder with the solver and two problems: x = (1, 3) and x = (2).
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("mine.py", SOLVER);
    std::fs::create_dir(folder.path().join("dumps")).unwrap();
    write("dumps/two.json", r#"{"A": {"dense": [[2, 0], [0, 1]]}, "b": [-2, -3]}"#);
    write("dumps/one.json", r#"{"A": {"dense": [[1]]}, "b": [-2]}"#);
    folder
}

/// Runs the test in the folder, with a bug, and returns the JSON and the exit code.
fn tested(folder: &Path, bug: &str, more: &[&str]) -> (Value, Option<i32>) {
    let path = |name: &str| folder.join(name).to_str().unwrap().to_string();
    let plugin = format!("mine=env 'BUG={bug}' python3 '{}'", path("mine.py"));
    let (dumps, baseline) = (path("dumps"), path("base.json"));
    let test = ["test", &dumps, "--plugin", &plugin, "--json", "--baseline", &baseline];
    let output = run(&[&test[..], more].concat());
    let text = out(&output);
    (serde_json::from_str(&text).unwrap_or(Value::Null), output.status.code())
}

/// The verdicts on the two problems, one.json first, and the second one's reason.
fn verdicts(report: &Value) -> (String, String, String) {
    let of = |k: usize, key: &str| report["problems"][k][key].as_str().unwrap_or("").to_string();
    (of(0, "verdict"), of(1, "verdict"), of(1, "why"))
}

#[test]
fn a_solver_that_loses_a_recorded_answer_fails_and_the_reason_is_named() {
    let folder = folder();
    let (_, code) = tested(folder.path(), "", &["--update"]);
    assert_eq!(code, Some(0));
    let (report, code) = tested(folder.path(), "", &[]);
    assert_eq!((verdicts(&report).1, code), ("passed".into(), Some(0)));
    for (bug, reason) in [
        ("wrong", "was accepted, is a false claim: "),
        ("crash", "was accepted, is without an answer: "),
        ("gives up", "was accepted, is not solved: "),
        ("slow", "21 iterations, recorded are 10"),
        ("loose", "scaled residual 5.0e-10, recorded is 0.0e0"),
    ] {
        let (report, code) = tested(folder.path(), bug, &[]);
        let (first, second, why) = verdicts(&report);
        assert_eq!((first.as_str(), second.as_str(), code), ("passed", "failed", Some(1)), "{bug}");
        assert!(why.starts_with(reason), "{bug}: {why}");
    }
    // With larger factors than the planted ones, the last two pass.
    let larger = ["--worse-iterations", "2.2"];
    assert_eq!(tested(folder.path(), "slow", &larger).1, Some(0));
}

#[test]
fn a_recorded_failure_passes_until_it_gets_worse() {
    let folder = folder();
    assert_eq!(tested(folder.path(), "gives up", &["--update"]).1, Some(0));
    let known = tested(folder.path(), "gives up", &[]);
    assert_eq!((verdicts(&known.0).1, known.1), ("known".into(), Some(0)));
    let fixed = tested(folder.path(), "", &[]);
    assert_eq!((verdicts(&fixed.0).1, fixed.1), ("fixed".into(), Some(0)));
    let worse = tested(folder.path(), "wrong", &[]);
    assert_eq!((verdicts(&worse.0).1, worse.1), ("failed".into(), Some(1)));
}

#[test]
fn without_a_baseline_every_answer_must_be_accepted() {
    let folder = folder();
    let dumps = folder.path().join("dumps");
    let dumps = dumps.to_str().unwrap();
    let output = run(&["test", dumps, "--solver", "dantzig", "--solver", "murty"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(out(&output), "dantzig: 2 problems, 2 passed\nmurty: 2 problems, 2 passed\n");
    // x = 1, but a sweep divides by the negative diagonal entry.
    let bad = folder.path().join("dumps/bad.json");
    std::fs::write(&bad, r#"{"A": {"dense": [[-1]]}, "b": [-0.5], "hi": [1]}"#).unwrap();
    let output = run(&["test", dumps, "--solver", "pgs"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("failed  "), "{}", out(&output));
    // w = −1 for every x: no solution exists. Dantzig's ray proves it; pgs, which cannot divide by
    // 0, claims nothing.
    std::fs::write(&bad, r#"{"A": {"dense": [[0]]}, "b": [-1]}"#).unwrap();
    for solver in ["dantzig", "pgs"] {
        let output = run(&["test", dumps, "--solver", solver]);
        assert_eq!(output.status.code(), Some(0), "{solver}: {}", out(&output));
    }
    let stated =
        r#"{"A": {"dense": [[0]]}, "b": [-1], "expected": {"solutions": [], "complete": true}}"#;
    std::fs::write(&bad, stated).unwrap();
    let output = run(&["test", dumps, "--solver", "pgs"]);
    assert_eq!(output.status.code(), Some(0), "{}", out(&output));
}

#[test]
fn a_recorded_problem_that_is_not_tested_any_more_fails() {
    let folder = folder();
    let junit = folder.path().join("test.xml");
    let junit = junit.to_str().unwrap();
    assert_eq!(tested(folder.path(), "", &["--update"]).1, Some(0));
    std::fs::remove_file(folder.path().join("dumps/one.json")).unwrap();
    let (report, code) = tested(folder.path(), "", &["--junit", junit]);
    let missing = report["missing"][0][1].as_str().unwrap();
    assert!(missing.ends_with("one.json") && code == Some(1) && report["ok"] == false, "{report}");
    assert!(std::fs::read_to_string(junit).unwrap().contains("but was not tested"));
    let (report, code) = tested(folder.path(), "", &["--allow-missing"]);
    assert!(code == Some(0) && report["ok"] == true, "{report}");
    // A solver under another name is another solver.
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let other = ["test", &path("dumps"), "--solver", "pgs", "--baseline", &path("base.json")];
    let output = run(&other);
    assert_eq!(output.status.code(), Some(1));
    let reason = "failed: the baseline has 2 results of mine, which was not tested (tested: pgs)";
    assert!(err(&output).starts_with(reason), "{}", err(&output));
}

#[test]
fn one_file_has_one_name_however_its_path_is_written() {
    let folder = folder();
    let absolute = folder.path().canonicalize().unwrap().join("dumps");
    for command in ["test", "receipts"] {
        let dumps: &[&str] = match command {
            "test" => &["--solver", "dantzig"],
            _ => {
                let frame = json!({"A": {"dense": [[1]]}, "b": [-1], "answer": {"x": [1.0]},
                    "motion": {"mass": [[0, 0, 1.0]], "jacobian": [[0, 0, 1.0]], "bias": [0.0],
                        "compliance": [0.0], "target": [-1.0]}});
                for name in ["one", "two"] {
                    let path = folder.path().join(format!("dumps/{name}.json"));
                    std::fs::write(path, frame.to_string()).unwrap();
                }
                &[]
            }
        };
        let run = |path: &str, more: &[&str]| {
            let mut all = std::process::Command::new(env!("CARGO_BIN_EXE_lcplab"));
            all.args([command, path, "--baseline", "base.json"]).args(dumps).args(more);
            all.current_dir(folder.path()).output().unwrap()
        };
        assert_eq!(run("dumps", &["--update"]).status.code(), Some(0));
        for path in ["dumps/", "./dumps", "dumps//", absolute.to_str().unwrap()] {
            let output = run(path, &[]);
            assert_eq!(output.status.code(), Some(0), "{command} {path}: {}", out(&output));
        }
        let fewer = run("dumps/one.json", &[]);
        assert_eq!(fewer.status.code(), Some(1), "{command}: {}", out(&fewer));
        let fewer = run("dumps/one.json", &["--allow-missing"]);
        assert_eq!(fewer.status.code(), Some(0), "{command}: {}", out(&fewer));
    }
}

#[test]
fn the_answers_of_frames_in_a_folder_are_no_problems() {
    let folder = folder();
    let dumps = folder.path().join("dumps");
    std::fs::write(dumps.join("one.x.json"), r#"{"x": [2]}"#).unwrap();
    let path = dumps.to_str().unwrap();
    let pattern = format!("{path}/*.json");
    for command in [
        &["test", path, "--solver", "dantzig"][..],
        &["test", &pattern, "--solver", "dantzig"],
        &["compare", path, "--solver", "dantzig"],
        &["diagnose", path, "--solver", "pgs"],
    ] {
        let output = run(command);
        assert_eq!(output.status.code(), Some(0), "{command:?}: {}", err(&output));
    }
}

#[test]
fn junit_and_sarif_carry_the_failures() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    assert_eq!(tested(folder.path(), "gives up", &["--update"]).1, Some(0));
    let (junit, sarif) = (path("test.xml"), path("test.sarif"));
    tested(folder.path(), "wrong", &["--junit", &junit, "--sarif", &sarif]);
    let junit = std::fs::read_to_string(junit).unwrap();
    assert!(junit.contains(r#"tests="2" failures="1" skipped="0""#), "{junit}");
    assert!(junit.contains(r#"<failure message="was not solved, is a false claim: "#), "{junit}");
    let sarif: Value = serde_json::from_str(&std::fs::read_to_string(sarif).unwrap()).unwrap();
    let results = sarif["runs"][0]["results"].as_array().unwrap();
    assert_eq!((results.len(), &results[0]["level"]), (1, &json!("error")));
}

#[test]
fn a_recorded_run_says_what_was_accepted() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let record = ["test", &path("dumps"), "--solver", "pgs", "--sweeps", "0", "--update"];
    let output = run(&[&record[..], &["--baseline", &path("base.json")]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let text = out(&output);
    assert!(text.starts_with("pgs: 2 problems, 0 accepted; recorded\n  known   "), "{text}");
}

#[test]
fn a_baseline_that_cannot_be_used_is_refused() {
    let folder = folder();
    assert_eq!(tested(folder.path(), "", &[]).1, Some(2), "there is no such file");
    assert_eq!(tested(folder.path(), "", &["--update"]).1, Some(0));
    assert_eq!(tested(folder.path(), "", &["--tolerance", "1e-6"]).1, Some(2));
    std::fs::write(folder.path().join("base.json"), r#"{"x": [1]}"#).unwrap();
    assert_eq!(tested(folder.path(), "", &[]).1, Some(2));
    // A frozen box without its key frozen_at: there is no problem to test.
    let frozen = r#"{"A": {"dense": [[1, 0], [0, 1]]}, "b": [-2, -3], "friction_index": [-1, 0],
        "mu": [0, 0.5], "model": "frozen-box"}"#;
    std::fs::write(folder.path().join("dumps/frozen.json"), frozen).unwrap();
    // One tangent is a coupled box, whether the file says so or not.
    let box_ = folder.path().join("box.json");
    std::fs::write(&box_, frozen.replace("frozen-box", "coupled-box")).unwrap();
    let output = run(&["test", box_.to_str().unwrap(), "--solver", "dantzig"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let dumps = folder.path().join("dumps");
    let output = run(&["test", dumps.to_str().unwrap(), "--solver", "dantzig"]);
    assert_eq!(output.status.code(), Some(2), "{}", out(&output));
    assert!(err(&output).contains("frozen.json"), "{}", err(&output));
    let output = run(&["test", "pd"]);
    let reason = "error: options: --plugin: name the solver to test with --plugin COMMAND or --solver NAME\n";
    assert_eq!((err(&output).as_str(), output.status.code()), (reason, Some(2)));
    assert_eq!(run(&["test", "pd", "--solver", "pgs", "--update"]).status.code(), Some(2));
}

/// Masses of 100 g that rest on a floor, and x = 0.3 N s, which single precision rounds by 4e-8:
/// more than the tolerance 1e-8, but a motion error of 4e-8 of what the floor changes.
#[test]
fn a_solver_in_single_precision_can_pass_by_its_motion_error() {
    let folder = folder();
    std::fs::remove_file(folder.path().join("dumps/one.json")).unwrap();
    let text = r#"{"A": {"dense": [[10, 0], [0, 10]]}, "b": [-3, -3], "motion": {
        "mass": [[0, 0, 0.1], [1, 1, 0.1]], "jacobian": [[0, 0, 1], [1, 1, 1]], "bias": [0, 0],
        "compliance": [0, 0], "target": [-3, -3], "level": "velocity"}}"#;
    std::fs::write(folder.path().join("dumps/two.json"), text).unwrap();
    let dumps = folder.path().join("dumps");
    let code = |bug: &str, more: &[&str]| {
        let plugin =
            format!("env 'BUG={bug}' python3 '{}'", folder.path().join("mine.py").display());
        let test = ["test", dumps.to_str().unwrap(), "--plugin", &plugin];
        run(&[&test[..], more].concat()).status.code()
    };
    assert_eq!(code("single", &[]), Some(1));
    assert_eq!(code("single", &["--motion-error", "1e-2"]), Some(0));
    assert_eq!(code("single", &["--motion-error", "1e-9"]), Some(1));
    assert_eq!(code("single, wrong", &["--motion-error", "1e-2"]), Some(1));
    assert_eq!(code("single", &["--motion-error", "2"]), Some(2));
}
