//! Hostile surroundings: full disks, folders that cannot be written, inputs that are no files or
//! never end. One message, the exit code of the help, and what was there before is still there.

use std::fs;
use std::os::unix::fs::FileTypeExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use super::{GOOD, err, out, run, run_with};

/// Invalid input or a file that cannot be read or written: one line on standard error alone.
#[track_caller]
fn assert_refused(output: &Output, message: &str) {
    let reported = format!("error: {message}\n");
    assert_eq!((output.status.code(), err(output)), (Some(2), reported));
}

fn sh(line: &str) -> Output {
    let line = line.replace("lcplab", env!("CARGO_BIN_EXE_lcplab"));
    Command::new("sh").args(["-c", &line]).stdin(Stdio::null()).output().unwrap()
}

#[test]
fn a_full_disk_is_one_message() {
    let full = "/dev/full: No space left on device (os error 28)";
    assert_refused(&run(&["problems", "fathi", "--out", "/dev/full"]), full);
    assert_refused(&run(&["export", "fig6", "--step", "1", "--out", "/dev/full"]), full);
    assert_refused(&run_with(GOOD, &["convert", "-", "/dev/full", "--to", "json"]), full);
    for command in ["solve -", "scenes", "problems fathi"] {
        let output = sh(&format!("echo '{GOOD}' | lcplab {command} > /dev/full"));
        assert_refused(&output, "standard output: No space left on device (os error 28)");
    }
}

#[test]
fn a_disk_that_fills_up_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let old = folder.path().join("old.json");
    fs::write(&old, "old").unwrap();
    // A file of at most 1024 bytes stands for a disk that is full halfway; who wants more gets
    // SIGXFSZ, too.
    let path = old.display();
    for trap in ["trap '' XFSZ; ", ""] {
        let line = format!("{trap}ulimit -f 1; exec lcplab problems stack --n 100 --out {path}");
        assert_refused(&sh(&line), &format!("{path}: File too large (os error 27)"));
        assert_eq!(fs::read_to_string(&old).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}

#[test]
fn what_was_computed_is_written_even_if_it_cannot_be_printed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().display();
    let output = sh(&format!("lcplab simulate fig6 --steps 5 --out {path} > /dev/full"));
    assert_refused(&output, "standard output: No space left on device (os error 28)");
    let ledger = fs::read_to_string(folder.path().join("ledger.csv")).unwrap();
    assert_eq!(ledger.lines().count(), 7); // heading, start, 5 steps
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_the_work() {
    // Not even root can write to /proc; below a device there is no folder.
    for (folder, reason) in [
        ("/proc/lcplab", "No such file or directory (os error 2)"),
        ("/dev/null/lcplab", "Not a directory (os error 20)"),
    ] {
        for command in [
            &["simulate", "fig6", "--steps", "1000000000"][..],
            &["compare", "fig6", "--steps", "2"],
            &["grid", "run", "omega"],
            &["report", "standard"],
        ] {
            let output = run(&[command, &["--time-limit", "60", "--out", folder]].concat());
            assert_eq!(output.status.code(), Some(2), "{command:?}: {}", err(&output));
            let reported = err(&output);
            assert!(reported.starts_with(&format!("error: {folder}")), "{reported}");
            assert!(reported.ends_with(&format!(": {reason}\n")), "{reported}");
            assert_eq!((reported.lines().count(), out(&output)), (1, String::new()), "{reported}");
        }
    }
}

#[test]
fn a_reader_who_goes_away_is_no_error_of_any_command() {
    for command in [
        "--help",
        "scenes --schema",
        "problems",
        "chapter",
        "problems stack --n 200",
        "export stack --step 1",
        "completions bash",
        "man",
        "simulate fig6 --steps 3 --json",
        "report --list",
    ] {
        // The exit code of the command itself, after `head` has gone.
        let output = sh(&format!("{{ lcplab {command}; echo $? >&2; }} | head -c 1"));
        assert_eq!((err(&output).as_str(), out(&output).len()), ("0\n", 1), "{command}");
    }
}

#[test]
fn a_pipe_with_a_name_is_read_like_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
    let path = pipe.display();
    let read = sh(&format!("echo '{GOOD}' > {path} & lcplab solve {path} --time-limit 60"));
    assert_eq!((read.status.code(), err(&read)), (Some(0), String::new()));
    let written = sh(&format!("cat {path} & lcplab problems fathi --out {path}; wait"));
    assert!(out(&written).starts_with('{') && written.status.success(), "{}", err(&written));
    // Nothing writes to the pipe: the endless wait ends at the time limit.
    let waiting = run(&["solve", pipe.to_str().unwrap(), "--time-limit", "0.2"]);
    let reported = "error: stopped by the time limit of 0.2 s; unfinished work is lost\n";
    assert_eq!((waiting.status.code(), err(&waiting).as_str()), (Some(1), reported));
}

#[test]
fn a_folder_is_no_file_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let is_folder = format!("{path}: Is a directory (os error 21)");
    assert_refused(&run(&["judge", path, path]), &is_folder);
    assert_refused(&run(&["solve", path]), &is_folder);
    assert_refused(&run(&["problems", "fathi", "--out", path]), &is_folder);
    assert!(Path::new(path).is_dir());
    // Of these a folder may have the name of what is shipped: it is neither.
    for (command, what) in [
        (&["simulate"][..], "scene file or shipped scene"),
        (&["grid", "plan"], "grid file or shipped grid"),
        (&["report"], "report file or shipped report"),
    ] {
        let refused = run(&[command, &[path]].concat());
        let reported = format!("error: there is no {what} named {path:?}; there are ");
        assert_eq!(refused.status.code(), Some(2));
        assert!(err(&refused).starts_with(&reported), "{}", err(&refused));
    }
    // Its name, if it is that of a shipped report, means the report.
    fs::create_dir(folder.path().join("friction")).unwrap();
    let inside = format!("cd {path} && lcplab report friction --section no_such_section");
    let reported = err(&sh(&inside));
    assert!(reported.contains("no section named"), "{reported}");
}

#[test]
fn an_endless_input_is_refused_at_the_limit() {
    let more = "is larger than 1 MB, the limit for reading";
    let zeros = run(&["solve", "/dev/zero", "--max-memory", "1MB"]);
    assert_refused(&zeros, &format!("/dev/zero: {more}"));
    let yes = sh("yes | lcplab solve - --max-memory 1MB");
    assert_refused(&yes, &format!("standard input: {more}"));
    let answer = run_with(GOOD, &["judge", "-", "/dev/zero", "--max-memory", "1MB"]);
    assert_refused(&answer, &format!("/dev/zero: {more}"));
    for command in
        [&["simulate", "/dev/zero"][..], &["report", "/dev/zero"], &["grid", "plan", "/dev/zero"]]
    {
        assert_refused(&run(command), "/dev/zero: is larger than 100 MB, the limit for reading");
    }
}
