//! Files and pipes that are written to: whole or not at all, and one message where they cannot be.

use std::io::Write;
use std::process::{Command, Stdio};

use super::{GOOD, err};

#[test]
fn a_reader_who_goes_away_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lcplab"))
        .args(["solve", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    child.stdin.take().unwrap().write_all(GOOD.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), err(&output)), (Some(0), String::new()));
}

#[test]
fn a_link_stays_a_link_and_nothing_is_left_over() {
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (folder.path().join("a.json"), folder.path().join("b.json"));
    std::fs::write(&file, "old").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(&file, &link).unwrap();
    let output = super::run(&["problems", "fathi", "--out", link.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    #[cfg(unix)]
    assert!(std::fs::read_to_string(&file).unwrap().contains("fathi"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    let below = file.join("c.json");
    let refused = super::run(&["problems", "fathi", "--out", below.to_str().unwrap()]);
    assert_eq!((refused.status.code(), err(&refused).lines().count()), (Some(2), 1));
}
