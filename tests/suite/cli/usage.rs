//! Options and help.

use super::{GOOD, err, out, run, run_with};

#[test]
fn an_option_that_no_solver_of_the_command_uses_is_bad_usage() {
    for (arguments, message) in [
        (
            &["solve", "-", "--order", "reverse"][..],
            "error: options: --order: dantzig does not use it; pgs and sor do\n",
        ),
        (
            &["solve", "-", "--solver", "pgs", "--damping", "0.5"],
            "error: options: --damping: pgs does not use it; jacobi does\n",
        ),
        (
            &["solve", "-", "--solver", "pgs", "--seed", "5"],
            "error: options: --seed: needs --order shuffled\n",
        ),
        (
            &["compare-solvers", "stack", "--solver", "lemke", "--solver", "pgs", "--omega", "1.5"],
            "error: options: --omega: none of these solvers uses it; sor and ssor do\n",
        ),
        (
            &["simulate", "fig6", "--steps", "1", "--solver", "dantzig", "--omega", "1.5"],
            "error: options: --omega: dantzig does not use it; sor and ssor do\n",
        ),
        (
            &["solve", "-", "--solver", "jacobi", "--damping", "2"],
            "error: settings: damping: must lie between 0 and 2, is 2\n",
        ),
    ] {
        let output = run_with(GOOD, arguments);
        assert_eq!((output.status.code(), err(&output)), (Some(2), message.to_string()));
    }
    let output = run(&[
        "compare-solvers",
        "stack",
        "--solver",
        "sor",
        "--solver",
        "lemke",
        "--omega",
        "1.5",
    ]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(err(&output), "note: --omega goes to sor alone\n");
}

#[test]
fn every_command_has_help_with_an_example() {
    let overview = out(&run(&["--help"]));
    let lines = overview.split("Options:").next().unwrap().lines();
    let listed = lines.filter(|line| line.starts_with("  ") && line.len() > 20);
    let mut names: Vec<&str> = listed.filter_map(|line| line.split_whitespace().next()).collect();
    for name in &names {
        let help = out(&run(&[name, "--help"]));
        assert!(help.contains("Example:\n  "), "{name} --help shows no example");
    }
    names.sort_unstable();
    let page = include_str!("../../../docs/commands.md").lines();
    let mut documented: Vec<&str> =
        page.filter_map(|line| line.strip_prefix("| `lcplab ")?.split([' ', '`']).next()).collect();
    documented.sort_unstable();
    assert_eq!(names, documented, "the overview and docs/commands.md have the same commands");
}
