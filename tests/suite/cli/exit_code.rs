//! Exit codes, and the hidden commands for a shell.

use super::{GOOD, err, out, run, run_with};

#[test]
fn the_exit_codes_of_the_help_are_those_of_commands() {
    let help = out(&run(&["--help"]));
    for code in ["\n  0  ", "\n  1  ", "\n  2  ", "\n  130  "] {
        assert!(help.contains(code), "{help}");
    }
    assert_eq!(run_with(GOOD, &["solve", "-"]).status.code(), Some(0));
    // The solution is (3, 3); one sweep does not reach it.
    let coupled = r#"{"A": {"dense": [[2, -1], [-1, 2]]}, "b": [-3, -3]}"#;
    let unsolved = run_with(coupled, &["solve", "-", "--solver", "pgs", "--max-iterations", "1"]);
    assert_eq!(unsolved.status.code(), Some(1));
    assert_eq!(run_with("{", &["solve", "-"]).status.code(), Some(2));
    assert_eq!(run(&["solve"]).status.code(), Some(2));
}

#[test]
fn completions_and_the_manual_know_the_commands() {
    for shell in ["bash", "zsh", "fish"] {
        assert!(out(&run(&["completions", shell])).contains("simulate"));
    }
    assert!(out(&run(&["man", "solve"])).contains("tolerance"));
    let unknown = run(&["man", "nothing"]);
    assert!(err(&unknown).starts_with("error: there is no command named \"nothing\""));
}
