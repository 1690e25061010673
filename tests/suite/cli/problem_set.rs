//! `problems --export` and `compare --profile`: a set that can be cited, and a figure for a paper.

use std::collections::{BTreeSet, HashSet};
use std::ffi::OsStr;
use std::fs;

use super::{out, run};
use lcplab::lcp::file::Problem;

#[test]
fn the_set_is_small_has_no_problem_twice_and_an_index_of_cards() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("set");
    let output = run(&["problems", "--export", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0));
    let files: Vec<_> = fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()).collect();
    let (problems, others): (Vec<_>, Vec<_>) =
        files.iter().partition(|file| file.extension().is_some_and(|e| e == "json"));
    let others: BTreeSet<_> = others.iter().map(|file| file.file_name().unwrap()).collect();
    assert_eq!(others, BTreeSet::from(["CITATION.cff", "index.csv"].map(OsStr::new)));
    let bytes: u64 = files.iter().map(|file| fs::metadata(file).unwrap().len()).sum();
    assert!((100..=300).contains(&problems.len()) && bytes < 20_000_000, "{bytes}");
    assert_eq!(out(&output), format!("{} problems in {}\n", problems.len(), path.display()));
    let index = fs::read_to_string(path.join("index.csv")).unwrap();
    assert_eq!(index.lines().count(), 1 + problems.len());
    assert!(index.contains("MuJoCo: creep after 1 s"), "{index}");
    let hashes: HashSet<&str> =
        index.lines().skip(1).filter_map(|line| line.rsplit(',').next()).collect();
    assert_eq!(hashes.len(), problems.len());
    for file in problems {
        let problem = Problem::read(file).unwrap();
        assert!(problem.warnings.is_empty(), "{:?}", problem.warnings);
        let name = file.file_name().unwrap().to_str().unwrap();
        let card = index.lines().find(|line| line.starts_with(name)).unwrap();
        assert!(card.contains(&format!(",{},", problem.lcp.len())), "{card}");
    }
}

#[test]
fn a_profile_counts_what_was_not_attempted_as_not_solved_and_once_more_without() {
    let folder = tempfile::tempdir().unwrap();
    let name = folder.path().join("profile");
    // Murty's matrix is not symmetric: dantzig does not take it, lemke does; both solve cps-1.
    let families = ["compare", "murty", "cps-1", "--solver", "dantzig", "--solver", "lemke"];
    let output = run(&[&families[..], &["--profile", name.to_str().unwrap()]].concat());
    let table = fs::read_to_string(name.with_extension("tex")).unwrap();
    let rows: Vec<Vec<&str>> = table
        .lines()
        .filter(|line| line.starts_with("dantzig") || line.starts_with("lemke"))
        .map(|line| line.trim_end_matches(" \\\\").split(" & ").collect())
        .collect();
    // solver, fastest, within ten times, solved of all, attempted, solved of these (in percent)
    let ends = |row: &[&str]| [row[3], row[4], row[5]].map(str::to_string);
    assert_eq!(rows.len(), 2, "{table} {}", out(&output));
    assert_eq!(ends(&rows[0]), ["50", "1", "100"], "{table}");
    assert_eq!(ends(&rows[1]), ["100", "2", "100"], "{table}");
    for ending in ["svg", "csv"] {
        assert!(fs::metadata(name.with_extension(ending)).unwrap().len() > 100);
    }
    let problems = fs::read_to_string(folder.path().join("profile_problems.csv")).unwrap();
    assert_eq!(problems.lines().count(), 1 + 4, "{problems}");
}

#[test]
fn a_solve_that_takes_too_long_is_none_and_an_unfinished_comparison_has_no_profile() {
    let folder = tempfile::tempdir().unwrap();
    let column = folder.path().join("column.json");
    let column = column.to_str().unwrap();
    run(&["problems", "stack", "--n", "2000", "--out", column]);
    // Gauss-Seidel needs some n² = 4 million sweeps.
    let slow = ["compare", column, "--solver", "pgs", "--max-iterations", "1000000000"];
    let output = run(&[&slow[..], &["--json", "--solve-time-limit", "0.2"]].concat());
    let message: serde_json::Value = serde_json::from_str(&out(&output)).unwrap();
    let row = &message["rows"][0];
    assert_eq!(row["trouble"], "no answer: no answer within its time limit of 0.2 s");
    assert_eq!((&row["claimed"], output.status.code()), (&0.into(), Some(1))); // it solved nothing
    let name = folder.path().join("profile");
    let profile = ["--profile", name.to_str().unwrap(), "--time-limit", "0.2"];
    let output = run(&[&slow[..], &profile].concat());
    let said = String::from_utf8_lossy(&output.stderr).to_string();
    assert!(said.contains("no profile was written"), "{said}");
    assert!(!name.with_extension("svg").exists());
}

#[test]
fn a_file_is_solved_under_the_model_that_it_states_alone() {
    let folder = tempfile::tempdir().unwrap();
    let contact = r#"{"A": {"dense": [[1,0,0],[0,1,0],[0,0,1]]}, "b": [-2,-3,0], "friction_index": [-1,0,0], "mu": [0,0.5,0.5]"#;
    for (name, model) in [("box.json", "}"), ("disc.json", r#", "model": "coulomb-cone"}"#)] {
        fs::write(folder.path().join(name), format!("{contact}{model}")).unwrap();
    }
    let pattern = format!("{}/*.json", folder.path().display());
    let output = run(&["compare", &pattern, "--json"]);
    let message: serde_json::Value = serde_json::from_str(&out(&output)).unwrap();
    let models: HashSet<(bool, &str)> = message["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| {
            (row["family"].as_str().unwrap().ends_with("box.json"), row["model"].as_str().unwrap())
        })
        .collect();
    assert_eq!(models, HashSet::from([(true, "coupled-box"), (false, "coulomb-cone")]));
}

#[test]
fn a_file_that_denies_a_solution_is_not_believed_against_a_proof() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("denied.json");
    let text =
        r#"{"A": {"dense": [[1]]}, "b": [-1], "expected": {"complete": true, "solutions": []}}"#;
    fs::write(&file, text).unwrap();
    let output = run(&["compare", file.to_str().unwrap(), "--solver", "pgs", "--json"]);
    let message: serde_json::Value = serde_json::from_str(&out(&output)).unwrap();
    let row = &message["rows"][0];
    assert_eq!((&row["proved"], &row["false_claims"]), (&1.into(), &0.into()), "{row}");
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn what_is_symmetric_but_for_rounding_is_diagnosed_as_symmetric() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rounded.json");
    let text = r#"{"A": {"dense": [[2, 1], [1.0000000000000002, 2]]}, "b": [-1, -1]}"#;
    fs::write(&file, text).unwrap();
    let output = run(&["diagnose", file.to_str().unwrap()]);
    assert!(!out(&output).contains("not symmetric"), "{}", out(&output));
}
