//! `--time-limit`, `--max-memory` and Ctrl-C: an honest end with what was computed.

use std::time::{Duration, Instant};

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

/// A plug-in that answers nothing but 30 problems, and then sleeps far longer than the time limit.
const SLOW: &str = r#"
import json, sys, time
for number, line in enumerate(sys.stdin):
    if number > 30: time.sleep(20)
    print(json.dumps({"status": "iteration_limit"}), flush=True)
"#;

#[test]
fn a_hunt_out_of_time_prints_its_table_and_says_which_problems_were_tested() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("slow.py");
    std::fs::write(&script, SLOW).unwrap();
    let plugin = format!("python3 '{}'", script.display());
    let options = ["--plugin-time-limit", "60", "--time-limit", "2"];
    let start = Instant::now();
    let output = run(&[&["hunt", "--plugin", &plugin][..], &options].concat());
    assert!(start.elapsed() < Duration::from_secs(12));
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(err(&output), "error: stopped by the time limit of 2 s\n");
    let text = out(&output);
    // One answer is to the greeting.
    assert!(text.contains("30 problems of 18 kinds, seed 1: 0 false claims"), "{text}");
    assert!(text.contains("stopped: of 10000 problems, numbers 0 to "), "{text}");
    assert!(text.contains("which were not finished"), "{text}");
}

#[test]
fn a_long_hunt_ends_at_its_time_limit() {
    let start = Instant::now();
    let output = run(&["hunt", "--problems", "10000000", "--time-limit", "1", "--json"]);
    assert!(start.elapsed() < Duration::from_secs(10));
    assert_eq!(output.status.code(), Some(1));
    let record: Value = serde_json::from_str(&out(&output)).unwrap();
    let unfinished = record["unfinished"].as_array().unwrap().len() as u64;
    let [problems, given] = ["problems", "given"].map(|key| record[key].as_u64().unwrap());
    assert!(problems > 0 && problems + unfinished == given, "{record}");
}
