//! Models of friction on the command line.

use serde_json::Value;

use super::{GOOD, err, out, run, run_with};

/// A unit mass slides along t1: pressed with 2 N s, pushed with 3, μ = ½. Coulomb: x = (2, 1, 0).
pub fn pushed() -> String {
    out(&run(&["problems", "pushed-mass", "--set", "degrees=0"]))
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
    assert_eq!(chosen(&pushed(), &[]), None); // the boxed LCP unchanged
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
            "error: standard input: friction_index: is missing: coulomb-cone is",
        ),
        (
            GOOD,
            ["--solver", "cone-pgs"],
            "error: standard input: friction_index: is missing: coulomb-cone is",
        ),
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
        "error: solver pgs: model: it supports boxes, not coulomb-cone; these solve it: cone-pgs, apgd\n"
    );
    let mut unfrozen: Value = serde_json::from_str(&pushed()).unwrap();
    unfrozen.as_object_mut().unwrap().remove("frozen_at");
    let output = run_with(&unfrozen.to_string(), &["solve", "-", "--model", "frozen-box"]);
    assert!(
        err(&output).starts_with("error: standard input: frozen_at: is missing"),
        "{}",
        err(&output)
    );
}

#[test]
fn a_scene_is_stepped_and_exported_under_the_given_model() {
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
            "error: solver pgs: model: it supports boxes, not coulomb-cone; these solve it: cone-pgs, apgd",
        ),
        (
            vec!["simulate", "sliding", "--model", "polygon-8", "--scheme", "soft"],
            "error: sliding: contact.model: the scheme soft treats friction row by row and supports only \"coupled-box\"",
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
    assert_eq!(of("scheme"), ["velocity", "velocity"]); // the other level does not know it
}
