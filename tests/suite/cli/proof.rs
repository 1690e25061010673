//! `prove`, `check` and `explain` of files that state a friction model, and proofs that prove
//! nothing.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use super::{err, out, run};

/// A ball pushed along both tangents: (2, √½, √½) in the cone, (2, 1, 1) in the coupled box.
const CONE: &str = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, -3],
    "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5], "model": "coulomb-cone"}"#;

/// A folder with a problem file, and the path of a proof in it.
fn folder(problem: &str) -> (tempfile::TempDir, PathBuf, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let [file, proof] = ["problem.json", "proof.json"].map(|name| folder.path().join(name));
    fs::write(&file, problem).unwrap();
    (folder, file, proof)
}

fn lcplab(command: &str, paths: &[&Path], options: &[&str]) -> Output {
    let paths = paths.iter().map(|path| path.to_str().unwrap());
    run(&[command].into_iter().chain(paths).chain(options.iter().copied()).collect::<Vec<_>>())
}

fn lcpcheck(paths: &[&Path], model: &[&str]) -> Output {
    let checker = Path::new(env!("CARGO_MANIFEST_DIR")).join("proofs/lcpcheck.py");
    Command::new("python3").arg(checker).args(paths).args(model).output().unwrap()
}

/// The crate of the pages has a copy, because a crate is published with its own files alone.
#[test]
fn the_checker_of_the_pages_is_that_of_the_folder_proofs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let [page, shipped] = ["crates/page/src/page/lcpcheck.js", "proofs/lcpcheck.js"]
        .map(|name| fs::read_to_string(root.join(name)).unwrap());
    assert!(page == shipped, "copy proofs/lcpcheck.js to crates/page/src/page");
}

#[test]
fn the_solution_of_a_cone_is_proved_by_a_box_around_it() {
    let (_folder, problem, proof) = folder(CONE);
    for kind in [&[][..], &["--kind", "cone-solution"]] {
        let write = [&["--out", proof.to_str().unwrap()][..], kind].concat();
        let proved = lcplab("prove", &[&problem], &write);
        assert_eq!(proved.status.code(), Some(0), "{}", err(&proved));
        assert!(out(&proved).starts_with("cone-solution: an exact solution"), "{}", out(&proved));
        for output in
            [lcplab("check", &[&problem, &proof], &[]), lcpcheck(&[&problem, &proof], &[])]
        {
            assert_eq!(output.status.code(), Some(0), "{}", out(&output));
            assert!(out(&output).contains("coulomb-cone"), "{}", out(&output));
        }
    }
}

#[test]
fn a_cone_is_not_proved_as_a_box_unless_the_box_is_asked_for() {
    let (_folder, problem, proof) = folder(CONE);
    let write = ["--out", proof.to_str().unwrap()];
    for kind in ["unique", "within"] {
        let refused = lcplab("prove", &[&problem], &[&write[..], &["--kind", kind]].concat());
        assert_eq!((refused.status.code(), proof.exists()), (Some(2), false), "{}", out(&refused));
        for part in ["model: is coulomb-cone", "about boxes", "--model coupled-box"] {
            assert!(err(&refused).contains(part), "{}", err(&refused));
        }
    }
    let asked = lcplab("prove", &[&problem], &[&write[..], &["--model", "coupled-box"]].concat());
    assert_eq!(asked.status.code(), Some(0), "{}", err(&asked));
    assert!(out(&asked).contains("under the friction model coupled-box"), "{}", out(&asked));
    // It is a proof of the box, and none of the file.
    let paths = [&*problem, &*proof];
    for (output, expected) in [
        (lcplab("check", &paths, &[]), 1),
        (lcpcheck(&paths, &[]), 1),
        (lcplab("check", &paths, &["--model", "coupled-box"]), 0),
        (lcpcheck(&paths, &["coupled-box"]), 0),
    ] {
        assert_eq!(output.status.code(), Some(expected), "{}", out(&output));
        assert!(out(&output).contains("model"), "{}", out(&output));
    }
}

#[test]
fn that_no_solution_exists_is_proved_under_every_model_where_one_vector_shows_it() {
    // w_n = −1 − x_n
    let text = CONE.replace("[[1, 0, 0]", "[[-1, 0, 0]").replace("[-2, ", "[-1, ");
    let (_folder, problem, proof) = folder(&text);
    let proved = lcplab("prove", &[&problem], &["--out", proof.to_str().unwrap()]);
    assert_eq!(proved.status.code(), Some(0), "{}", err(&proved));
    let claim =
        "no solution exists, proved by a Farkas vector, under the friction model coulomb-cone";
    assert!(out(&proved).contains(claim), "{}", out(&proved));
    for output in [lcplab("check", &[&problem, &proof], &[]), lcpcheck(&[&problem, &proof], &[])] {
        assert_eq!(output.status.code(), Some(0), "{}", out(&output));
        assert!(out(&output).contains("coulomb-cone"), "{}", out(&output));
    }
}

#[test]
fn a_page_of_a_proof_contains_the_problem_under_the_given_model() {
    let (folder, problem, _) = folder(CONE);
    let page = folder.path().join("proof.html");
    let options = ["--model", "coupled-box", "--out", page.to_str().unwrap()];
    assert_eq!(lcplab("prove", &[&problem], &options).status.code(), Some(0));
    let text = fs::read_to_string(page).unwrap().replace("&quot;", "\"");
    assert!(
        text.contains(r#""model":"coupled-box""#) && !text.contains(r#""model":"coulomb-cone""#)
    );
}

/// x₀ + x₁ = 1 for every solution of `cps-1`; around the ring of `wedged` all rows add up to −4.
#[test]
fn a_page_of_a_proof_shows_both_solutions_or_the_vector() {
    let folder = tempfile::tempdir().unwrap();
    let cells = |family: &str| -> Vec<Vec<String>> {
        let [problem, page] = ["p.json", "p.html"].map(|name| folder.path().join(name));
        let [problem, page] = [&problem, &page].map(|path| path.to_str().unwrap());
        run(&["problems", family, "--out", problem]);
        run(&["prove", problem, "--out", page]);
        let html = fs::read_to_string(page).unwrap();
        let rows = html.split("<tr").skip(2).map(|row| row.split("</tr>").next().unwrap());
        let cell =
            |cell: &str| cell.split('>').nth(1).unwrap().split('<').next().unwrap().to_string();
        rows.map(|row| row.split("<td").skip(1).map(cell).collect()).collect()
    };
    let points = cells("cps-1");
    let value = |text: &str| match text.split_once('/') {
        Some((a, b)) => a.parse::<f64>().unwrap() / b.parse::<f64>().unwrap(),
        None => text.parse().unwrap(),
    };
    assert_eq!(points.len(), 2);
    for column in [1, 2] {
        assert_eq!(value(&points[0][column]) + value(&points[1][column]), 1.0);
    }
    assert_ne!(points[0][1], points[0][2]);
    assert_eq!(cells("wedged").len(), 4);
}

#[test]
fn a_cone_is_explained_as_a_cone_and_judged_as_one() {
    let (_folder, problem, _) = folder(CONE);
    let cone = lcplab("explain", &[&problem], &[]);
    assert_eq!(cone.status.code(), Some(0), "{}", err(&cone));
    for part in [
        "The friction model is coulomb-cone.",
        "(0.707107, 0.707107)",
        "The coupled box for comparison",
    ] {
        assert!(out(&cone).contains(part), "{part} in {}", out(&cone));
    }
    let boxed = lcplab("explain", &[&problem], &["--model", "coupled-box"]);
    assert!(out(&boxed).contains("x = (2, 1, 1)"), "{}", out(&boxed));
}

#[test]
fn isolated_solutions_are_not_listed_as_corners() {
    // w₁ = x₂ and w₂ = 1 − x₁ − x₂ vanish where x > 0: at (t, 0), 0 ≤ t ≤ 1, and at (0, 1) alone.
    let (_folder, problem, _) = folder(r#"{"A": {"dense": [[0, 1], [-1, -1]]}, "b": [0, 1]}"#);
    let all = out(&lcplab("prove", &[&problem], &["--all"]));
    let words = "There are infinitely many solutions, in one part, and one isolated:\n\
                 every point between\n  x = (0, 0)\n  x = (1, 0)\nisolated\n  x = (0, 1)\n";
    assert_eq!(all, words);
}

#[test]
fn corners_that_look_alike_are_listed_once() {
    // w₃ ≥ 0 and w₂ ≥ 0 hold x₁ between 0.333333333 and 0.33333333333, with x₂ = x₃ = 0.
    let (_folder, problem, _) = folder(
        r#"{"A": {"dense": [[0, 1, 1], [-1, -1, 0], [1, 0, -1]]}, "b": [0, 0.33333333333, -0.333333333]}"#,
    );
    let all = out(&lcplab("prove", &[&problem], &["--all"]));
    let words = "There are infinitely many solutions:\nevery point between\n  x = (0.333333, 0, 0)\n  \
                 and 1 more point, which differs by less than the digits shown: see --json\n";
    assert_eq!(all, words);
}

#[test]
fn a_negative_distance_bound_or_residual_is_bad_input_in_one_line() {
    let (_folder, problem, proof) = folder(r#"{"A": {"dense": [[2]]}, "b": [-1]}"#);
    let hash = "648314a8cb7843f1eee098ca3be4e42c2a841353525801c2703e87d95819ee84";
    let half = r#""x": {"denominator": "2", "numerators": ["1"]}"#;
    let motion = r#""motion": {"denominator": "1", "numerators": []}"#;
    for (place, claim) in [
        ("distance", format!(r#""kind": "solution", {half}, "answer": [0.5], "distance": -1.0"#)),
        ("distance", format!(r#""kind": "solution", {half}, "answer": [0.5], "distance": -5e-324"#)),
        ("bound", format!(r#""kind": "motion", "answer": [0.5], {motion}, "bound": -1"#)),
        (
            "residual",
            r#""kind": "within", "answer": [0.5], "residual": {"numerator": "-1", "denominator": "2"}"#
                .to_string(),
        ),
    ] {
        let text = format!(r#"{{"format": "lcplab-proof-1", "problem": "{hash}", {claim}}}"#);
        fs::write(&proof, text).unwrap();
        let refused = lcplab("check", &[&problem, &proof], &[]);
        assert_eq!(refused.status.code(), Some(2), "{}", out(&refused));
        let message = err(&refused);
        assert!(message.contains(place) && message.contains("negative"), "{message}");
        assert_eq!(message.trim_end().lines().count(), 1, "{message}");
        assert_eq!(lcpcheck(&[&problem, &proof], &[]).status.code(), Some(1));
    }
}

/// The same contact twice: any shares of the load solve it, and two answers prove that.
#[test]
fn two_answers_prove_that_the_solution_is_not_unique() {
    let (folder, problem, proof) = folder(r#"{"A": {"dense": [[1, 1], [1, 1]]}, "b": [-1, -1]}"#);
    let [first, second, wrong] = ["a", "b", "c"].map(|name| folder.path().join(name));
    for (file, x) in [(&first, "[1, 0]"), (&second, "[0.25, 0.75]"), (&wrong, "[1, 1]")] {
        fs::write(file, format!("{{\"x\": {x}}}")).unwrap();
    }
    let write = ["--out", proof.to_str().unwrap()];
    let proved = lcplab("prove", &[&problem, &first, &second], &write);
    assert_eq!(proved.status.code(), Some(0), "{}", err(&proved));
    assert_eq!(out(&proved), "not-unique: two different solutions exist\n");
    assert_eq!(lcpcheck(&[&problem, &proof], &[]).status.code(), Some(0));
    let refused = lcplab("prove", &[&problem, &first, &wrong], &[]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(err(&refused).contains("not-unique: the second answer"), "{}", err(&refused));
}

/// w = −x between −1 and 1: twelve rows with three solutions each.
#[test]
fn more_solutions_than_can_be_listed_are_refused_in_one_line() {
    let row = |i: usize| (0..12).map(move |j| if i == j { "-1" } else { "0" });
    let rows: Vec<String> =
        (0..12).map(|i| format!("[{}]", row(i).collect::<Vec<_>>().join(","))).collect();
    let all = |value: &str| format!("[{}]", [value; 12].join(","));
    let text = format!(
        r#"{{"A": {{"dense": [{}]}}, "b": {}, "lo": {}, "hi": {}}}"#,
        rows.join(","),
        all("0"),
        all("-1"),
        all("1")
    );
    let (_folder, problem, _) = folder(&text);
    let refused = lcplab("prove", &[&problem], &["--all"]);
    assert_eq!(refused.status.code(), Some(2), "{}", err(&refused));
    let reported = "has more than 1,024 solutions, too many to list";
    assert!(err(&refused).trim_end().ends_with(reported), "{}", err(&refused));
    assert_eq!(err(&refused).lines().count(), 1, "{}", err(&refused));
}

#[test]
fn a_proof_from_a_rejected_answer_is_about_the_problem_alone() {
    // x = (1.5, 0) is the solution.
    let (folder, problem, proof) = folder(r#"{"A": {"dense": [[2, 0], [0, 1]]}, "b": [-3, 1]}"#);
    let wrong = folder.path().join("wrong.json");
    fs::write(&wrong, r#"{"x": [1.6, 0]}"#).unwrap();
    let output = lcplab("prove", &[&problem, &wrong], &["--out", proof.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    let first = format!("the judge rejects {}: not a solution: ", wrong.display());
    assert!(err(&output).starts_with(&first), "{}", err(&output));
    assert!(err(&output).contains("in row 0"), "{}", err(&output));
    assert_eq!(lcplab("check", &[&problem, &proof], &[]).status.code(), Some(0));
    fs::write(&wrong, r#"{"x": [1.5, 0]}"#).unwrap();
    assert_eq!(lcplab("prove", &[&problem, &wrong], &[]).status.code(), Some(0));
}
