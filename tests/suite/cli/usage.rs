//! Options and help.

use std::process::Command;

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
            &["compare", "pd", "--solver", "lemke", "--solver", "pgs", "--omega", "1.5"],
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
    let output = run(&["compare", "pd", "--solver", "sor", "--solver", "lemke", "--omega", "1.5"]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(err(&output), "note: --omega applies only to sor\n");
}

#[test]
fn an_old_word_is_an_error_that_names_the_new_one() {
    for (old, new) in [
        (&["verify", "--only", "pendulum"][..], "lcplab report verification --list"),
        (&["generate", "fathi"], "lcplab problems FAMILY"),
        (&["compare-solvers", "dumps"], "lcplab compare"),
        (&["--time-limit", "5", "verify"], "lcplab report verification --list"),
        (&["simulate", "fig6", "--formulation", "soft"], "lcplab simulate SCENE --scheme NAME"),
        (
            &["compare", "pd", "--require-accepted", "pgs"],
            "lcplab test PROBLEMS --solver NAME or --plugin COMMAND",
        ),
        (&["report", "--redraw", "reports/standard"], "lcplab report FOLDER/results.json"),
        (&["report", "solvers", "--pdf"], "lcplab report --out FILE.pdf"),
        (&["report", "dumps", "--sweeps", "10"], "lcplab diagnose FOLDER --sweeps N"),
    ] {
        let output = run(old);
        let reported = err(&output);
        assert_eq!((output.status.code(), reported.lines().count()), (Some(2), 1), "{reported}");
        assert!(reported.ends_with(&format!(" was replaced; use {new}\n")), "{reported}");
    }
}

#[test]
fn the_command_that_only_the_python_package_has_names_that_package() {
    let output = run(&["import", "arm.xml"]);
    assert_eq!(output.status.code(), Some(2));
    let message = "error: import is a command of the Python package: run pip install \"./python[mujoco]\" in the \
                   repository of lcplab, then python -m lcplab import FILE\n";
    assert_eq!(err(&output), message);
    let overview = out(&run(&["--help"]));
    assert!(overview.contains("The Python package adds the command lcplab import"), "{overview}");
}

#[test]
fn the_overview_begins_with_what_most_people_need() {
    let overview = out(&run(&["--help"]));
    let first = overview.split("\n\n").find(|part| part.starts_with("Most used:")).unwrap();
    let names = first.lines().skip(1).filter_map(|line| line.split_whitespace().next());
    let needed =
        ["solve", "judge", "diagnose", "hunt", "test", "receipts", "simulate", "report", "lesson"];
    assert_eq!(names.collect::<Vec<_>>(), needed);
}

/// A line is broken only where the next word does not fit.
fn broken_early(help: &str, width: usize) -> Vec<String> {
    let is_prose = |line: &str| line.starts_with(char::is_alphabetic) && !line.ends_with(':');
    let lines: Vec<&str> = help.lines().collect();
    let pairs = lines.windows(2).filter(|pair| is_prose(pair[0]) && is_prose(pair[1]));
    let fits = |pair: &&[&str]| {
        let word = pair[1].split(' ').next().unwrap_or_default();
        pair[0].chars().count() + 1 + word.chars().count() <= width
    };
    pairs.filter(fits).map(|pair| pair.join("\n")).collect()
}

#[test]
fn prose_of_a_help_fills_the_lines_of_narrow_and_wide_terminals() {
    for (columns, width) in [("60", 60), ("80", 80), ("200", 100)] {
        for name in commands(&out(&run(&["--help"]))) {
            let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
            let output = command.args([&name, "--help"]).env("COLUMNS", columns).output().unwrap();
            assert_eq!(broken_early(&out(&output), width), [""; 0], "{name} at {columns}");
        }
    }
}

#[test]
fn a_default_of_an_option_is_that_of_the_command() {
    let default = |command: &str, option: &str| {
        let help = out(&run(&[command, "--help"])).replace('\n', " ");
        let words: Vec<&str> = help.split_whitespace().collect();
        let help = words.join(" ");
        let (_, of_option) = help.split_once(&format!(" {option} <")).unwrap();
        let (_, default) = of_option.split_once("[default: ").unwrap();
        default.split(']').next().unwrap().to_string()
    };
    for command in ["solve", "test"] {
        assert_eq!(default(command, "--omega"), "1.3", "{command}");
        assert_eq!(default(command, "--order"), "natural", "{command}");
        assert_eq!(default(command, "--seed"), "1", "{command}");
    }
    for option in ["--omega", "--order", "--seed", "--tolerance", "--max-iterations"] {
        assert_eq!(default("simulate", option), "the scene's", "{option}");
        let both = default("compare", option);
        assert!(both.starts_with("the scene's; for problems "), "{both}");
    }
    assert!(default("hunt", "--at-least").contains("stop at the first problem found"));
}

#[test]
fn plug_ins_are_repeatable_where_several_solvers_run() {
    for (command, is_repeatable) in
        [("compare", true), ("hunt", true), ("test", true), ("solve", false), ("diagnose", false)]
    {
        let help = out(&run(&[command, "--help"]));
        let (_, plugin) = help.split_once("--plugin <").unwrap();
        let plugin = plugin.split("\n      -").next().unwrap();
        assert_eq!(plugin.contains("(repeatable)"), is_repeatable, "{command}: {plugin}");
    }
}

#[test]
fn a_report_has_at_most_twelve_options() {
    let help = out(&run(&["report", "--help"]));
    let options = help.lines().filter(|line| line.trim_start().starts_with('-'));
    assert!(options.count() <= 12, "{help}");
}

/// The commands that the overview lists.
fn commands(overview: &str) -> Vec<String> {
    let lines = overview.split("Options:").next().unwrap().lines();
    let listed = lines.filter(|line| line.starts_with("  ") && line.len() > 20);
    listed.filter_map(|line| Some(line.split_whitespace().next()?.into())).collect()
}

#[test]
fn every_command_has_help_with_an_example() {
    let mut names = commands(&out(&run(&["--help"])));
    for name in &names {
        let help = out(&run(&[name, "--help"]));
        let has_example = ["Example:\n  ", "Examples:\n  "].iter().any(|head| help.contains(head));
        assert!(has_example, "{name} --help shows no example");
    }
    names.sort_unstable();
    let page = include_str!("../../../docs/commands.md").lines();
    let mut documented: Vec<String> = page
        .filter_map(|line| Some(line.strip_prefix("| `lcplab ")?.split([' ', '`']).next()?.into()))
        .collect();
    documented.sort_unstable();
    assert_eq!(names, documented, "the overview and docs/commands.md have the same commands");
}
