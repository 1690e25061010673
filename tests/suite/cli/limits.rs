//! `--time-limit`, `--max-memory` and Ctrl-C: an honest end with what was computed.

use serde_json::Value;

use super::{GOOD, err, out, run, run_with};

#[test]
fn a_time_limit_ends_a_solve_with_its_last_iterate() {
    let endless = ["--tolerance", "0", "--max-iterations", "18446744073709551615"];
    let all = ["solve", "-", "--solver", "admm", "--time-limit", "0.3", "--json"];
    let output = run_with(GOOD, &[&all[..], &endless].concat());
    let answer: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(answer["message"], "stopped by the time limit of 0.3 s");
    assert_eq!(err(&output), "error: stopped by the time limit of 0.3 s\n");
}

#[test]
fn a_simulation_out_of_time_writes_what_it_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let steps = ["--steps", "1000000000", "--time-limit", "0.5", "--json"];
    let output = run(&[&["simulate", "fig6", "--out", path][..], &steps].concat());
    let summary: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    let taken = summary["steps"].as_u64().unwrap() as usize;
    let ledger = std::fs::read_to_string(folder.path().join("ledger.csv")).unwrap();
    assert_eq!(ledger.lines().count(), taken + 2); // heading, start
    let names = std::fs::read_dir(folder.path()).unwrap().flatten().map(|file| file.file_name());
    assert!(names.into_iter().all(|name| !name.to_string_lossy().starts_with(".lcplab")));
}

#[test]
fn what_would_take_too_much_memory_is_refused_with_the_numbers() {
    let output = run_with(GOOD, &["solve", "-", "--max-memory", "100B"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        err(&output).contains("the limit is 100 B (raise it with --max-memory)"),
        "{}",
        err(&output)
    );
    let output = run(&["compare", "fig6", "--steps", "1000000000"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        err(&output).contains("the limit is 4 GB (raise it with --max-memory)"),
        "{}",
        err(&output)
    );
    let output = run_with(GOOD, &["solve", "-", "--max-memory", "5parsecs"]);
    assert!(err(&output).contains("must be a positive number with a unit"), "{}", err(&output));
}
