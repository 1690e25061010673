//! `solve` and `judge`: answers, verdicts and what they are called.

use serde_json::Value;

use super::{GOOD, err, out, run, run_with};

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
fn an_answer_that_overflows_is_a_status_and_has_finite_numbers() {
    // x = −1e600.
    let problem = r#"{"A": {"dense": [[-1e-300]]}, "b": [-1e300], "lo": ["-inf"]}"#;
    for solver in ["lemke", "enumeration"] {
        let output = run_with(problem, &["solve", "-", "--solver", solver, "--json"]);
        assert_eq!(output.status.code(), Some(1), "{solver}: {}", out(&output));
        let answer: Value = serde_json::from_str(&out(&output)).unwrap();
        assert_eq!(answer["status"], "failed", "{answer}");
        assert_eq!(answer["message"], "an iterate was not finite; x is not an answer", "{answer}");
        assert_eq!(answer["x"], serde_json::json!([0.0]), "{answer}");
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
    let fathi = run(&["problems", "fathi", "--n", "4", "--set", "reversed=1"]);
    let output = run_with(&out(&fathi), &["solve", "-", "--json"]);
    let answer: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((&answer["verdict"], &answer["iterations"]), (&"proved".into(), &1.into()));
    let wrong = run(&["problems", "fathi", "--seed", "4"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(err(&wrong).contains("fathi: seed: is no parameter of this family"));
    assert!(out(&run(&["problems"])).contains("\nfathi "));
    assert!(out(&run(&["problems", "stack", "--parameters"])).contains("ratio"));
}

#[test]
fn the_meanings_of_the_residuals_stand_in_one_column() {
    // Its residuals have exponents of two digits.
    let problem = run(&["export", "incline", "--step", "1"]);
    let text = out(&run_with(&out(&problem), &["solve", "-"]));
    let meanings =
        ["error of the worst", "max |x", "largest distance", "largest product", "bound on"];
    let column = |meaning: &str| {
        let line = text.lines().find(|line| line.contains(meaning)).unwrap();
        line[..line.find(meaning).unwrap()].chars().count()
    };
    assert_eq!(meanings.map(column), [31; 5], "{text}");
}

#[test]
fn outside_the_bounds_no_duality_gap_is_printed() {
    // x is below its bound by a rounding error where w > 0: the gap would be −1e-16 times w.
    let problem = r#"{"A": {"dense": [[1, 0], [0, 1]]}, "b": [1, -1]}"#;
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    std::fs::write(path("p.json"), problem).unwrap();
    std::fs::write(path("x.json"), r#"{"x": [-1e-16, 1]}"#).unwrap();
    let text = out(&run(&["judge", &path("p.json"), &path("x.json")]));
    let gap = text.lines().find(|line| line.contains("duality gap")).unwrap();
    assert!(gap.contains(" –  bound on the error"), "{text}");
}

#[test]
fn solve_prints_the_verdict_as_text() {
    let output = run_with(GOOD, &["solve", "-"]);
    assert!(out(&output).contains("verdict    proved: x is an exact solution"));
}

#[test]
fn sweeps_in_another_order_end_at_the_same_x_by_another_path() {
    let stack = out(&run(&["problems", "stack", "--n", "5"]));
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
    assert!(err(&output).ends_with("short.json: x: has length 1, the problem has 2 rows\n"));
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
fn many_answers_and_their_iterates_have_a_row_each() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    };
    let problem = write("one.json", r#"{"A": {"dense": [[2]]}, "b": [-1]}"#);
    let path = write("path.json", r#"{"x": [0.5], "iterates": [[1], [0.75]]}"#);
    let wrong = write("wrong.json", r#"{"x": [1]}"#);
    let near = write("near.json", r#"{"x": [0.5000001]}"#);
    let judge = |arguments: &[&str]| run(&[&["judge", &problem], arguments].concat());
    let output = judge(&[&path, &wrong, "--json"]);
    let reported: serde_json::Value = serde_json::from_str(&out(&output)).unwrap();
    let word = |k: usize| reported["answers"][k]["verdict"].as_str().unwrap().to_string();
    // |2 x - 1| beside 2 x + 1: 1/3 and 1/5 of the terms, then nothing.
    assert_eq!(
        (0..4).map(word).collect::<Vec<_>>(),
        ["not_a_solution", "not_a_solution", "proved", "not_a_solution"]
    );
    assert_eq!(reported["answers"][1]["amount"], 0.2);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(judge(&[&path]).status.code(), Some(0)); // iterates aside
    let [loose, strict] = [&["--tolerance", "1e-6"][..], &["--tolerance", "1e-6", "--proved"]]
        .map(|options| judge(&[&[near.as_str()], options].concat()).status.code());
    assert_eq!((loose, strict), (Some(0), Some(0))); // proved: the exact solution is 1e-7 away
    let far = write("far.json", r#"{"x": [0.500001]}"#);
    let [loose, strict] = [&["--tolerance", "1e-5"][..], &["--tolerance", "1e-5", "--proved"]]
        .map(|options| judge(&[&[far.as_str()], options].concat()).status.code());
    assert_eq!((loose, strict), (Some(0), Some(1))); // 1e-6 away is more than a millionth of x
}

#[test]
fn a_trace_has_a_line_for_each_iterate_and_a_picture_the_rate_of_theory() {
    let folder = tempfile::tempdir().unwrap();
    let [problem, csv, svg] =
        ["pair.json", "trace.csv", "trace.svg"].map(|name| folder.path().join(name));
    std::fs::write(&problem, r#"{"A": {"dense": [[1, 0.5], [0.5, 1]]}, "b": [-1, -1]}"#).unwrap();
    let [problem, csv, svg] = [&problem, &csv, &svg].map(|path| path.to_str().unwrap());
    let output = run(&["solve", problem, "--solver", "pgs", "--trace", csv, "--plot", svg]);
    assert_eq!(output.status.code(), Some(0));
    let lines = std::fs::read_to_string(csv).unwrap();
    let residuals: Vec<f64> = lines
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(2).unwrap().parse().unwrap())
        .collect();
    assert!(out(&output).contains(&format!("solved, {} iterations", residuals.len() - 1)));
    // Gauss-Seidel on [[1, c], [c, 1]]: rho = c^2.
    for pair in residuals[2..10].windows(2) {
        assert!((pair[1] / pair[0] - 0.25).abs() < 1e-6, "{residuals:?}");
    }
    assert!(std::fs::read_to_string(svg).unwrap().contains("ρ = 0.250000"));
    let refused = run(&["solve", problem, "--model", "coulomb-cone", "--plot", svg]);
    assert_eq!(refused.status.code(), Some(2));
}

/// w = A x + b at x = 0 is b, and 0.5 m/s for a hundredth of a second are 5 mm.
#[test]
fn a_verdict_says_what_its_row_is_and_does() {
    let folder = tempfile::tempdir().unwrap();
    let answer = folder.path().join("answer.json");
    std::fs::write(&answer, r#"{"x": [0]}"#).unwrap();
    for (row, said) in [
        (
            r#""kind": "normal", "unit": "N s""#,
            "(foot on ground: approach velocity 0.5 m/s, 5 mm per step)",
        ),
        (r#""kind": "normal", "unit": "N""#, "(foot on ground: approach velocity 0.5 m/s²)"),
        (r#""kind": "joint", "unit": "N m s""#, "(foot on ground: w = −0.5 rad/s)"),
        (r#""kind": "joint""#, "(foot on ground)"),
    ] {
        let problem = format!(
            r#"{{"A": {{"dense": [[2]]}}, "b": [-0.5], "dt": 0.01, "rows": [{{"label": "foot on ground", {row}}}]}}"#
        );
        let judged = run_with(&problem, &["judge", "-", answer.to_str().unwrap()]);
        assert!(out(&judged).contains(said), "{row}: {}{}", out(&judged), err(&judged));
    }
}

#[test]
fn a_saddle_of_a_declared_objective_is_accepted_and_said_to_be_no_minimum() {
    let saddle = r#"{"A": {"dense": [[1, 3], [3, 1]]}, "b": [0, 0], "lo": [-1, -1], "hi": [1, 1]"#;
    let text = |more: &str| {
        let output = run_with(&format!("{saddle}{more}}}"), &["solve", "-", "--solver", "pgs"]);
        assert_eq!(output.status.code(), Some(0));
        out(&output)
    };
    assert!(text(r#", "objective": true"#).contains("no minimum: x satisfies the optimality"));
    assert!(!text("").contains("no minimum"));
    let problem = format!(r#"{saddle}, "objective": 1}}"#);
    assert!(err(&run_with(&problem, &["solve", "-"])).contains("objective: must be true or false"));
}

/// A body of 1 kg meets the ground at 3 m/s: the contact changes its velocity by 3 m/s, 3 √J.
#[test]
fn the_effect_of_the_constraints_is_known_as_well_as_the_answer() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (problem, answer) = (path("fall.json"), path("x.json"));
    let text = r#"{"A": {"dense": [[1]]}, "b": [-3], "motion": {"mass": [[0, 0, 1]],
        "jacobian": [[0, 0, 1]], "bias": [0], "compliance": [0], "target": [-3], "level": "velocity"}}"#;
    std::fs::write(&problem, text).unwrap();
    let error = |x: f64| {
        std::fs::write(&answer, format!("{{\"x\": [{x}]}}")).unwrap();
        let json = out(&run(&["judge", &problem, &answer, "--json"]));
        let error = serde_json::from_str::<Value>(&json).unwrap()["motion_error"].take();
        [&error["effect"], &error["relative"]].map(|v| v.as_f64().unwrap_or(f64::INFINITY))
    };
    for off in [0.0, 1e-6, 0.03, 0.3] {
        let [effect, relative] = error(3.0 - off);
        assert!((effect - 3.0).abs() <= 2.0 * off + 1e-9 && effect <= 3.0, "{off}: {effect}");
        assert!(relative >= off / 3.0, "{off}: {relative}");
    }
    // Nothing was done: the motion changes by nothing, and should by 3.
    assert!(error(0.0)[1] >= 1.0);
}
