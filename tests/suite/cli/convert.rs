//! `convert`, and problems in the formats of other programs.

use serde_json::Value;

use super::friction::pushed;
use super::{GOOD, err, out, run, run_with};

#[test]
fn problems_are_converted_and_taken_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    for name in ["good.mtx", "good.npz", "good.qps", "good.dat"] {
        let written = run_with(GOOD, &["convert", "-", &path(name)]);
        assert_eq!((written.status.code(), err(&written).as_str()), (Some(0), ""), "{name}");
        let solved = run(&["solve", &path(name), "--json"]);
        let answer: Value = serde_json::from_str(&out(&solved)).unwrap();
        assert_eq!(
            (&answer["verdict"], &answer["x"]),
            (&"proved".into(), &serde_json::json!([0.5, 0.0]))
        );
        assert_eq!(run(&["diagnose", &path(name)]).status.code(), Some(0));
    }
    let back = run(&["convert", &path("good"), "-"]); // the stem of good.mtx
    let problem: Value = serde_json::from_str(&out(&back)).unwrap();
    assert_eq!(problem["b"], serde_json::json!([-1.0, 2.0]));
    let compared = run(&["compare", &path("good.npz"), "--solver", "pgs", "--json"]);
    let rows: Value = serde_json::from_str(&out(&compared)).unwrap();
    assert_eq!((&rows["rows"][0]["accepted"], compared.status.code()), (&1.into(), Some(0)));
}

/// The bounds of a relay problem, and contacts with their bodies: W = ½ I and b = (−4, −1, ½) give
/// the impulse −2 b = (8, 2, −1), which sticks, for √5 is below ½ · 8.
#[test]
fn files_of_siconos_are_solved_as_the_problems_that_they_are() {
    let folder = "crates/files/tests/problems/exchange/siconos";
    for (name, expected) in
        [("relay", vec![1.0, 0.0]), ("global_of_three_rows", vec![8.0, 2.0, -1.0])]
    {
        let solved = run(&["solve", &format!("{folder}/{name}.dat"), "--json"]);
        assert_eq!(solved.status.code(), Some(0), "{name}: {}", err(&solved));
        let answer: Value = serde_json::from_str(&out(&solved)).unwrap();
        let x = answer["x"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap());
        assert!(x.zip(&expected).all(|(x, expected)| (x - expected).abs() < 1e-6), "{answer}");
    }
    let refused = run(&["solve", &format!("{folder}/refused_rolling.dat")]);
    assert_eq!((refused.status.code(), out(&refused).as_str()), (Some(2), ""));
    assert!(err(&refused).contains("this seems to be contacts with rolling friction"));
}

#[test]
fn what_a_format_cannot_carry_is_refused_or_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let refused = run_with(&pushed(), &["convert", "-", &path("pushed.qps")]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(err(&refused).contains("qps: friction_index: is given"));
    let named = run_with(&pushed(), &["convert", "-", &path("pushed.npz")]);
    let notes = "note: -: the friction model is coupled-box\nnote: the format cannot store source, frozen_at\n";
    assert_eq!(err(&named), notes);
    assert!(
        err(&run_with(GOOD, &["convert", "-", "-", "--to", "npz"])).contains("it needs a file")
    );
    assert!(out(&run(&["convert", "--list"])).contains("siconos        Siconos: "));
}

#[test]
fn a_conversion_that_changes_the_law_of_friction_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let formats: &[&str] =
        if cfg!(feature = "fclib") { &["cone.dat", "cone.hdf5"] } else { &["cone.dat"] };
    for name in formats {
        let format = if name.ends_with("dat") { "siconos" } else { "fclib" };
        let file = path(name);
        let written = err(&run_with(&pushed(), &["convert", "-", &file]));
        let warning = format!(
            "warning: {file}: {format} means coulomb-cone, - is coupled-box: the two problems have \
             different solutions\n"
        );
        assert!(written.contains(&warning), "{written}");
        // Reading says which law the file has, and carries it along.
        let read = run(&["convert", &file, "-"]);
        let problem: Value = serde_json::from_str(&out(&read)).unwrap();
        assert_eq!(problem["model"], "coulomb-cone");
        assert_eq!(err(&read), format!("note: {file}: the friction model is coulomb-cone\n"));
        // The same law: nothing changes. Back to rows with a box: it does.
        let same = err(&run(&["convert", &file, &path("again.dat")]));
        assert!(!same.contains("warning"), "{same}");
        let boxed = err(&run(&["convert", &file, &path("box.npz")]));
        assert!(boxed.contains("npz means coupled-box"), "{boxed}");
    }
    let to_output = err(&run_with(&pushed(), &["convert", "-", "-", "--to", "siconos"]));
    assert!(to_output.contains("warning: -: siconos means coulomb-cone"), "{to_output}");
}

/// In exact numbers the minimum lies at x = y = 0 up to a rounding error that the file contains.
#[test]
fn a_stated_scale_accepts_a_program_with_rounding_errors_in_its_limits() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/crates/files/tests/problems/exchange/matlab/rounding.mat"
    );
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    std::fs::write(path("zero.json"), r#"{"x": [0, 0, 0, 0]}"#).unwrap();
    let judged = |problem: &str| run(&["judge", problem, &path("zero.json")]).status.code();
    assert_eq!(judged(file), Some(1));
    run(&["convert", file, &path("scaled.json"), "--scale", "1e-6"]);
    assert_eq!(judged(&path("scaled.json")), Some(0));
    let negative = run(&["convert", file, &path("other.json"), "--scale=-1"]);
    assert_eq!(negative.status.code(), Some(2));
    assert!(err(&negative).contains("--scale: -1: must be finite and not negative"));
}
