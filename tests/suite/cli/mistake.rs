//! `diagnose PROBLEM ANSWER` from outside.

use super::{out, run};

/// Three balls on each other: x = (4, 3, 1).
const FIG7: &str = r#"{"A": {"dense": [[1, -1, 0], [-1, 2, -1], [0, -1, 2]]}, "b": [-1, -1, 1]}"#;

#[test]
fn the_mistake_behind_an_answer_is_named_with_the_exit_code_of_the_judge() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    };
    let problem = file("problem.json", FIG7);
    // Two sweeps by hand.
    let stopped = file("stopped.json", r#"{"x": [2, 1.5, 0.25]}"#);
    let message = run(&["diagnose", &problem, &stopped]);
    let text = String::from_utf8(message.stdout).unwrap();
    assert_eq!(message.status.code(), Some(1));
    assert!(text.contains("projected Gauss-Seidel, stopped after 2 sweeps (exactly)"), "{text}");
    assert!(text.contains("\nSweeps stopped too early: Allow more sweeps, start from"), "{text}");
    // Neither sweep meets a bound, and every number fits into 32 bits.
    assert!(text.contains("3 known mistakes may have given this x equally well"), "{text}");
    assert!(
        text.contains("Gauss-Seidel with the clamp after the sweep, stopped after 2"),
        "{text}"
    );
    // Of an answer that no mistake explains, the output states what it was compared with.
    let unknown = file("unknown.json", r#"{"x": [3.1415, 2.7182, 0.5772]}"#);
    let message = String::from_utf8(run(&["diagnose", &problem, &unknown]).stdout).unwrap();
    let compared = "the first 2,000 iterates of each method, and with the first 100 on each";
    assert!(message.contains(compared), "{message}");

    let right = file("right.json", r#"{"x": [4, 3, 1]}"#);
    let message = run(&["diagnose", &problem, &right, "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&message.stdout).unwrap();
    assert_eq!(message.status.code(), Some(0));
    assert_eq!((&json["verdict"], &json["mistakes"]), (&"proved".into(), &serde_json::json!([])));

    // A sweep from the last answer (4, 3, 2): x₀ = 1 + 3, x₁ = (1 + 4 + 2)/2, x₂ = (3.5 − 1)/2.
    let last = file("last.json", r#"{"x": [4, 3, 2]}"#);
    let swept = file("swept.json", r#"{"x": [4, 3.5, 1.25]}"#);
    let message =
        String::from_utf8(run(&["diagnose", &problem, &swept, "--last", &last]).stdout).unwrap();
    assert!(
        message.contains("Gauss-Seidel from the last answer, stopped after 1 sweep"),
        "{message}"
    );
    assert_eq!(run(&["diagnose", &problem, "--last", &last]).status.code(), Some(2));

    let short = file("short.json", r#"{"x": [4, 3]}"#);
    assert_eq!(run(&["diagnose", &problem, &short]).status.code(), Some(2));
    assert_eq!(run(&["diagnose", "fig7", &right]).status.code(), Some(2));
    let polygon = r#"{"model": "polygon-4", "A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]},
        "b": [-2, -2.6, -1.5], "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5]}"#;
    // Each tangent at its own limit μ x_n: right for the box, outside the polygon.
    let boxed = file("boxed.json", r#"{"x": [2, 1, 1]}"#);
    let message = run(&["diagnose", &file("polygon.json", polygon), &boxed]);
    assert_eq!(message.status.code(), Some(1));
    let text = String::from_utf8(message.stdout).unwrap();
    // Sweeps that clamp each tangent on its own solve the box.
    for name in [
        "projected Gauss-Seidel with each tangent clamped on its own, after 1 sweep or more (exactly)",
        "the solution with friction under the model coupled-box (exactly)",
    ] {
        assert!(text.contains(name), "{text}");
    }
}

#[test]
fn an_accepted_answer_is_accused_of_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    };
    let problem = file("problem.json", FIG7);
    let message = run(&["diagnose", &problem, &file("right.json", r#"{"x": [4, 3, 1]}"#)]);
    assert_eq!(
        (message.status.code(), out(&message).lines().count()),
        (Some(0), 1),
        "{}",
        out(&message)
    );
    // Near the solution, but not accepted: no method that leads to it is to blame.
    let near = file("near.json", r#"{"x": [4.0000123, 3.0000321, 1.0000213]}"#);
    let message = run(&["diagnose", &problem, &near]);
    assert_eq!(message.status.code(), Some(1));
    assert!(
        out(&message).contains("No known mistake was found that gives this x."),
        "{}",
        out(&message)
    );
    let object: serde_json::Value =
        serde_json::from_slice(&run(&["diagnose", &problem, &near, "--json"]).stdout).unwrap();
    assert_eq!(
        (&object["conclusion"], &object["precision"]),
        (&"compared".into(), &"8 significant digits".into())
    );
    assert_eq!(object["sweeps_compared"]["problem"], 2000);
    let distance = object["solution_distance"].as_f64().unwrap();
    assert!((distance / (3.21e-5 / 4.0) - 1.0).abs() < 1e-3, "{distance}");
}

#[test]
fn the_list_of_known_mistakes_is_that_of_the_page() {
    let message = run(&["diagnose", "--mistakes", "--json"]);
    assert_eq!(message.status.code(), Some(0));
    let list: serde_json::Value = serde_json::from_slice(&message.stdout).unwrap();
    let row = |own: &serde_json::Value| {
        let cell = |key: &str| own[key].as_str().unwrap().to_string();
        format!("| {} | {} | {} |", cell("name"), cell("computes"), cell("check"))
    };
    let known: Vec<String> = list["mistakes"].as_array().unwrap().iter().map(row).collect();
    let page = include_str!("../../../docs/mistakes.md").lines();
    let listed: Vec<&str> = page.filter(|line| line.starts_with("| ")).skip(2).collect();
    assert_eq!(listed, known, "docs/mistakes.md has the rows of `diagnose --mistakes`");
    let text = out(&run(&["diagnose", "--mistakes"]));
    for own in list["mistakes"].as_array().unwrap() {
        assert!(text.contains(own["name"].as_str().unwrap()), "{own}");
    }
    assert_eq!(run(&["diagnose"]).status.code(), Some(2));
    assert_eq!(run(&["diagnose", "stack", "--mistakes"]).status.code(), Some(2));
}
