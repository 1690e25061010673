//! Ctrl-C and SIGTERM: a clean end with what was computed, and exit code 130.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::{err, out};

/// The signals that ask for an end, and their numbers.
const ENDS: [(&str, u32); 2] = [("INT", 2), ("TERM", 15)];
/// SIGHUP's number.
const HANG_UP: u32 = 1;

/// Starts a command; one that would not end by itself within a minute fails its test, not hangs it.
fn start(program: &str, arguments: &[&str]) -> Child {
    Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts")
}

fn lcplab(arguments: &[&str]) -> Child {
    start(env!("CARGO_BIN_EXE_lcplab"), &[arguments, &["--time-limit", "60"]].concat())
}

/// Whether a process has a signal in this set of /proc: SigCgt if it listens, SigIgn if it ignores.
fn is_in(child: &Child, set: &str, signal: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(set)?.strip_prefix(':'));
    let mask = line.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Whether a command has begun and sleeps: of one that reads standard input, until something comes.
fn is_reading(child: &Child) -> bool {
    let process = format!("/proc/{}", child.id());
    let program = fs::read_link(format!("{process}/exe")).unwrap_or_default();
    let status = fs::read_to_string(format!("{process}/status")).unwrap_or_default();
    program == Path::new(env!("CARGO_BIN_EXE_lcplab"))
        && status.lines().any(|line| line.starts_with("State:") && line.contains("S (sleeping)"))
}

/// Waits until a condition holds, up to a time limit.
#[track_caller]
fn wait_until(is_so: impl Fn() -> bool) {
    for _ in 0..6000 {
        if is_so() {
            return;
        }
        sleep(Duration::from_millis(10));
    }
    panic!("waited for a minute in vain");
}

fn send(child: &Child, signal: &str) {
    let sent = Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status();
    assert!(sent.unwrap().success());
}

/// Ends a command by a signal once it listens and something is so.
fn end(child: Child, (signal, number): (&str, u32), is_so: impl Fn() -> bool) -> Output {
    wait_until(|| is_in(&child, "SigCgt", number) && is_so());
    send(&child, signal);
    child.wait_with_output().unwrap()
}

#[track_caller]
fn assert_interrupted(output: &Output) {
    let reported = "stopping; press Ctrl-C again to end at once\nerror: interrupted\n";
    assert_eq!((output.status.code(), err(output).as_str()), (Some(130), reported));
}

/// No file is left under its temporary name.
fn assert_tidy(folder: &Path) {
    let names = fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name());
    let left: Vec<_> = names.filter(|name| name.to_string_lossy().starts_with('.')).collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn an_interrupted_solve_prints_its_last_iterate() {
    for signal in ENDS {
        let folder = tempfile::tempdir().unwrap();
        let problem = folder.path().join("good.json");
        fs::write(&problem, super::GOOD).unwrap();
        let endless = ["--solver", "admm", "--tolerance", "0", "--max-iterations", "1000000000000"];
        let solve = ["solve", problem.to_str().unwrap(), "--json"];
        let output = end(lcplab(&[&solve[..], &endless].concat()), signal, || true);
        assert_interrupted(&output);
        let answer: Value = serde_json::from_str(&out(&output)).unwrap();
        assert_eq!(answer["message"], "interrupted");
        assert_eq!(answer["x"].as_array().unwrap().len(), 2);
    }
}

#[test]
fn an_interrupted_simulation_writes_what_it_recorded() {
    for signal in ENDS {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().to_str().unwrap();
        let simulate = ["simulate", "fig6", "--steps", "1000000000", "--out", path, "--json"];
        let output = end(lcplab(&simulate), signal, || true);
        assert_interrupted(&output);
        let summary: Value = serde_json::from_str(&out(&output)).unwrap();
        let ledger = fs::read_to_string(folder.path().join("ledger.csv")).unwrap();
        let steps = summary["steps"].as_u64().unwrap() as usize;
        assert_eq!(ledger.lines().count(), steps + 2); // heading, start
        for file in ["trajectory.csv", "forces.csv", "results.json", "index.html"] {
            assert!(folder.path().join(file).is_file(), "{file}");
        }
        assert_tidy(folder.path());
    }
}

#[test]
fn an_interrupted_grid_keeps_its_tasks_and_goes_on_from_them() {
    for signal in ENDS {
        let folder = tempfile::tempdir().unwrap();
        let (file, results) = (folder.path().join("long.toml"), folder.path().join("results"));
        let long = "scene = 'pendulum'\nmeasure = 'drift'\n[axes]\nsteps = [1, 2, 100000000]\n";
        fs::write(&file, long).unwrap();
        let (file, path) = (file.to_str().unwrap(), results.to_str().unwrap());
        let run = ["grid", "run", file, "--out", path, "--threads", "1"];
        let task = |number: usize| results.join(format!("tasks/{number}.json"));
        let output = end(lcplab(&run), signal, || task(1).exists() && task(2).exists());
        assert_interrupted(&output);
        assert_eq!(out(&output), "2 of 3 tasks run, 0 were done before\n");
        for number in [1, 2] {
            let record: Value = serde_json::from_slice(&fs::read(task(number)).unwrap()).unwrap();
            assert_eq!(record["finding"]["values"]["steps"], number as f64);
        }
        assert_tidy(&results.join("tasks"));
        let again = end(lcplab(&run), signal, || true);
        assert_eq!(out(&again), "0 of 3 tasks run, 2 were done before\n");
        assert_eq!(again.status.code(), Some(130));
    }
}

#[test]
fn an_interrupted_report_writes_its_page_and_goes_on_from_its_results() {
    let folder = tempfile::tempdir().unwrap();
    let (file, results) = (folder.path().join("long.toml"), folder.path().join("page"));
    let report = "title = 'Long'\nlead = ''\n\
                  [[section]]\nstudy = 'cross-check'\nscenes = [{ scene = 'fig7' }]\n\
                  [[section]]\nstudy = 'drift'\n[[section.ledgers]]\nname = 'swing'\n\
                  title = ''\ntext = ''\nscene = 'pendulum'\nduration = 1e7\n";
    fs::write(&file, report).unwrap();
    let (file, path) = (file.to_str().unwrap(), results.to_str().unwrap());
    let run = ["report", file, "--out", path, "--threads", "1"];
    let is_done = |section: usize| {
        let text = fs::read(results.join("results.json")).unwrap();
        let found: Value = serde_json::from_slice(&text).unwrap();
        found["sections"][section]["tasks"][0].get("finding").is_some()
    };
    // The first task takes no time on a machine that has some; the second one never ends.
    for seconds in [1, 2, 4, 8, 16] {
        let child = lcplab(&run);
        wait_until(|| is_in(&child, "SigCgt", ENDS[0].1));
        sleep(Duration::from_secs(seconds));
        assert_interrupted(&end(child, ENDS[0], || true));
        assert!(fs::read_to_string(results.join("index.html")).unwrap().contains("Long"));
        assert_tidy(&results);
        if is_done(0) {
            break;
        }
    }
    assert!(is_done(0) && !is_done(1));
    let again = end(lcplab(&run), ENDS[1], || true);
    assert_interrupted(&again);
    assert!(is_done(0) && out(&again).contains("1 of 2 tasks done"), "{}", out(&again));
}

#[test]
fn an_interrupted_hunt_prints_its_table() {
    for signal in ENDS {
        let child = lcplab(&["hunt", "--problems", "10000000", "--solver", "murty"]);
        let start = Instant::now();
        let output = end(child, signal, || start.elapsed() > Duration::from_secs(1));
        assert!(start.elapsed() < Duration::from_secs(10));
        assert_interrupted(&output);
        assert!(out(&output).contains("stopped: of 10000000 problems, numbers 0 to "));
    }
}

#[test]
fn a_hang_up_that_nohup_ignores_stays_ignored() {
    let program = env!("CARGO_BIN_EXE_lcplab");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let line = format!(
        "trap '' HUP; exec '{program}' simulate fig6 --steps 1000000000 --time-limit 60 --out '{path}'"
    );
    let child = start("sh", &["-c", &line]);
    wait_until(|| is_in(&child, "SigCgt", ENDS[0].1));
    assert!(is_in(&child, "SigIgn", HANG_UP));
    send(&child, "HUP");
    let output = end(child, ENDS[1], || true);
    assert_interrupted(&output);
}

#[test]
fn a_command_that_has_nothing_to_keep_ends_by_the_signal_itself() {
    use std::os::unix::process::ExitStatusExt;
    for (signal, number) in ENDS {
        let child = lcplab(&["judge", "-", "-"]); // waits for its input
        wait_until(|| is_reading(&child));
        // A shell ignores SIGINT for the jobs in its background, and so does what they start.
        let is_ignored = is_in(&child, "SigIgn", number);
        send(&child, signal);
        let output = child.wait_with_output().unwrap();
        let end = if is_ignored { None } else { Some(number as i32) };
        assert_eq!(output.status.signal(), end, "{}", err(&output));
        assert_eq!(err(&output).is_empty(), !is_ignored);
    }
}
