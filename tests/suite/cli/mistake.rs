//! `diagnose PROBLEM ANSWER` from outside.

use super::run;

/// Three balls on each other: x = (4, 3, 1).
const FIG7: &str = r#"{"A": {"dense": [[1, -1, 0], [-1, 2, -1], [0, -1, 2]]}, "b": [-1, -1, 1]}"#;

#[test]
fn the_mistake_behind_an_answer_is_told_with_the_exit_code_of_the_judge() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    };
    let problem = file("problem.json", FIG7);
    // Two sweeps by hand.
    let stopped = file("stopped.json", r#"{"x": [2, 1.5, 0.25]}"#);
    let told = run(&["diagnose", &problem, &stopped]);
    let text = String::from_utf8(told.stdout).unwrap();
    assert_eq!(told.status.code(), Some(1));
    assert!(text.contains("projected Gauss-Seidel, stopped after 2 sweeps, exactly"), "{text}");

    let right = file("right.json", r#"{"x": [4, 3, 1]}"#);
    let told = run(&["diagnose", &problem, &right, "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&told.stdout).unwrap();
    assert_eq!(told.status.code(), Some(0));
    assert_eq!((&json["verdict"], &json["mistakes"]), (&"proved".into(), &serde_json::json!([])));

    // A sweep from the last answer (4, 3, 2): x₀ = 1 + 3, x₁ = (1 + 4 + 2)/2, x₂ = (3.5 − 1)/2.
    let last = file("last.json", r#"{"x": [4, 3, 2]}"#);
    let swept = file("swept.json", r#"{"x": [4, 3.5, 1.25]}"#);
    let told =
        String::from_utf8(run(&["diagnose", &problem, &swept, "--last", &last]).stdout).unwrap();
    assert!(told.contains("Gauss-Seidel from the last answer, stopped after 1 sweep"), "{told}");
    assert_eq!(run(&["diagnose", &problem, "--last", &last]).status.code(), Some(2));

    let short = file("short.json", r#"{"x": [4, 3]}"#);
    assert_eq!(run(&["diagnose", &problem, &short]).status.code(), Some(2));
    assert_eq!(run(&["diagnose", "fig7", &right]).status.code(), Some(2));
    let polygon = r#"{"model": "polygon-4", "A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]},
        "b": [-2, -2.6, -1.5], "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5]}"#;
    let told = run(&["diagnose", &file("polygon.json", polygon), &right]);
    assert_eq!(told.status.code(), Some(2));
    assert!(String::from_utf8(told.stderr).unwrap().contains("polygon-4"));
}
