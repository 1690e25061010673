//! Renamed commands and options, and the command that only the Python package has.

use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Old commands, and what to use instead.
const COMMANDS: [(&str, &str); 3] = [
    ("verify", "report verification --list"),
    ("generate", "problems FAMILY"),
    ("compare-solvers", "compare"),
];

/// Old options: the command, the option, and what to use instead.
const OPTIONS: [(&str, &str, &str); 15] = [
    ("simulate", "--formulation", "simulate SCENE --scheme NAME"),
    ("compare", "--formulation", "compare SCENE --scheme NAME"),
    ("compare", "--require-accepted", "test PROBLEMS --solver NAME or --plugin COMMAND"),
    ("export", "--formulation", "export SCENE --scheme NAME"),
    ("explain", "--formulation", "explain SCENE --scheme NAME"),
    ("judge", "--fail-on", "judge PROBLEM ANSWER --proved"),
    ("report", "--redraw", "report FOLDER/results.json"),
    ("report", "--schema", "report --print schema"),
    ("report", "--pdf", "report --out FILE.pdf"),
    ("report", "--tolerance", "report --compare OLD NEW TOLERANCE"),
    ("report", "--absolute", "report --compare OLD NEW TOLERANCE"),
    ("report", "--fresh", "report, after deleting results.json"),
    ("report", "--solver", "diagnose FOLDER --solver NAME"),
    ("report", "--max-iterations", "diagnose FOLDER --max-iterations N"),
    ("report", "--sweeps", "diagnose FOLDER --sweeps N"),
];

/// `import` needs MuJoCo's compiler, which has an interface for Python.
const IMPORT: &str = "import is a command of the Python package: run pip install \"./python[mujoco]\" in the \
                      repository of lcplab, then python -m lcplab import FILE";

/// What to use instead of a command or option that clap does not know; `words` is the command line.
pub fn instead(error: &clap::Error, words: &[String]) -> Option<String> {
    let unknown = |kind| match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.as_str()),
        _ => None,
    };
    let (old, new) = match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let word = unknown(ContextKind::InvalidSubcommand)?;
            if word == "import" {
                return Some(IMPORT.into());
            }
            *COMMANDS.iter().find(|(old, _)| *old == word)?
        }
        ErrorKind::UnknownArgument => {
            let word = unknown(ContextKind::InvalidArg)?;
            let is_of = |command: &str| words.iter().any(|word| word == command);
            let is_meant =
                |&&(command, old, _): &&(&str, &str, &str)| is_of(command) && old == word;
            let &(_, old, new) = OPTIONS.iter().find(is_meant)?;
            (old, new)
        }
        _ => return None,
    };
    Some(format!("{old} was replaced; use lcplab {new}"))
}
