//! `problems --export` and `compare-solvers --profile`: a set that can be cited, and a figure for a paper.

use std::collections::HashSet;
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
    let problems: Vec<_> =
        files.iter().filter(|file| file.extension().is_some_and(|e| e == "json")).collect();
    let bytes: u64 = files.iter().map(|file| fs::metadata(file).unwrap().len()).sum();
    assert!((100..=300).contains(&problems.len()) && bytes < 20_000_000, "{bytes}");
    assert_eq!(out(&output), format!("{} problems in {}\n", problems.len(), path.display()));
    let index = fs::read_to_string(path.join("index.csv")).unwrap();
    assert_eq!(index.lines().count(), 1 + problems.len());
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
    let families =
        ["compare-solvers", "murty", "cps-1", "--solver", "dantzig", "--solver", "lemke"];
    let output = run(&[&families[..], &["--profile", name.to_str().unwrap()]].concat());
    let table = fs::read_to_string(name.with_extension("tex")).unwrap();
    let rows: Vec<Vec<&str>> = table
        .lines()
        .filter(|line| line.starts_with("dantzig") || line.starts_with("lemke"))
        .map(|line| line.trim_end_matches(" \\\\").split(" & ").collect())
        .collect();
    // solver, fastest, within ten times, solved of all, took on, solved of these (in percent)
    let ends = |row: &[&str]| [row[3], row[4], row[5]].map(str::to_string);
    assert_eq!(rows.len(), 2, "{table} {}", out(&output));
    assert_eq!(ends(&rows[0]), ["50", "1", "100"], "{table}");
    assert_eq!(ends(&rows[1]), ["100", "2", "100"], "{table}");
    for ending in ["svg", "csv"] {
        assert!(fs::metadata(name.with_extension(ending)).unwrap().len() > 100);
    }
}
