//! A page checks the proof that it carries, and sees where it was tampered with.

use std::fs;
use std::process::Command;

use serde_json::json;

use super::driver::Page;

/// The page that `prove` writes about a step of a scene.
fn proved(scene: &str) -> Page {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for (command, from, to) in [
        ("export", scene.into(), path("step.json")),
        ("prove", path("step.json"), path("proof.html")),
    ] {
        let mut lcplab = Command::new(env!("CARGO_BIN_EXE_lcplab"));
        let output = lcplab.arg(command).arg(from).arg("--out").arg(to).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    Page(fs::read_to_string(path("proof.html")).unwrap())
}

const CLICK: &str = "find('.check').click();
    const output = find('output');
    return [output.className, output.textContent.split(' (')[0], find('.check').hidden];";

#[test]
fn a_click_on_the_button_checks_the_proof() {
    let found = proved("fig7").seen(390, CLICK);
    assert_eq!(found, json!(["good", "Proved: exactly one solution exists", false]));
}

#[test]
fn a_proof_that_was_tampered_with_is_refused() {
    let tampered = "const given = find('.proof code');
        given.textContent = given.textContent.replace('\"numerators\":[\"4\"', '\"numerators\":[\"5\"');";
    let found = proved("fig7").seen(1280, &format!("{tampered}{CLICK}"));
    assert_eq!(found, json!(["bad", "Refused: w of row 0 has the wrong sign.", false]));
}
