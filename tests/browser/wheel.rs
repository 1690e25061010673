//! The wheel for Pyodide in Chromium: its command line prints what the program prints.
//!
//! ```text
//! python3 release/pyodide.py
//! npm install --prefix target/pyodide pyodide@314
//! cargo test --test browser -- --ignored
//! ```

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};

use super::driver::served;
use super::python::pyodide;

/// An answer that is wrong.
const ANSWER: &str = "{\"x\": [0, 0, 0, 0, 0, 0]}";

/// Commands, in this order in one folder, which contains the answer. They use what browsers do not
/// have: threads (`simulate`, `compare`, a time limit), and the end of the process (`--version`,
/// `--help`, a wrong option).
const COMMANDS: [&str; 14] = [
    "--version",
    "solve --help",
    "solve --no-such-option",
    "problems pushed-rod --out problem.json",
    "solve problem.json",
    "judge problem.json answer.json",
    "prove problem.json --out proof.json",
    "check problem.json proof.json",
    "explain problem.json",
    "diagnose problem.json",
    "compare problem.json --time-limit 60",
    "simulate stack --steps 20 --out stack",
    "export stack --step 3 --out stack.json",
    "lesson 3 --out lessons",
];

/// The only wheel for Pyodide in target/wheels.
fn wheel() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/wheels");
    let mut wheels = fs::read_dir(&folder).into_iter().flatten().map(|entry| entry.unwrap().path());
    let is_one = |path: &PathBuf| path.to_string_lossy().ends_with("_wasm32.whl");
    wheels.find(is_one).expect("this test needs the wheel: python3 release/pyodide.py")
}

/// What the commands print in a browser, and their exit codes.
fn in_a_browser() -> Value {
    let folder = tempfile::tempdir().unwrap();
    let wheel = wheel();
    let name = wheel.file_name().unwrap().to_string_lossy().into_owned();
    fs::copy(&wheel, folder.path().join(&name)).unwrap();
    for entry in fs::read_dir(pyodide()).unwrap().map(Result::unwrap) {
        if entry.file_type().unwrap().is_file() {
            fs::copy(entry.path(), folder.path().join(entry.file_name())).unwrap();
        }
    }
    // The package needs NumPy, which the npm package of Pyodide does not contain; its extension
    // module, which is the command line, does not.
    let python = "
import importlib.machinery, importlib.util, pathlib
place = importlib.util.find_spec('lcplab').submodule_search_locations[0]
module, = pathlib.Path(place).glob('_lcplab*.so')
loader = importlib.machinery.ExtensionFileLoader('_lcplab', str(module))
spec = importlib.util.spec_from_file_location('_lcplab', module, loader=loader)
_lcplab = importlib.util.module_from_spec(spec)
loader.exec_module(_lcplab)
lambda words: _lcplab.run(['lcplab', *words.split()])
";
    let script = format!(
        "const {{ loadPyodide }} = await import('./pyodide.mjs');
        const python = await loadPyodide({{ packages: [] }});
        let text = '';
        const write = (bytes) => {{ text += new TextDecoder().decode(bytes); return bytes.length; }};
        python.FS.writeFile('answer.json', {answer});
        python.setStdout({{ write }});
        python.setStderr({{ write: (bytes) => bytes.length }});
        await python.loadPackage(new URL({name}, document.baseURI).href, {{ checkIntegrity: false, messageCallback: () => {{}} }});
        const run = python.runPython({python});
        return {commands}.map((words) => {{ text = ''; return [words, run(words), text]; }});",
        name = json!(name),
        python = json!(python),
        commands = json!(COMMANDS),
        answer = json!(ANSWER),
    );
    served(folder.path(), &script)
}

/// What the program prints, and its exit codes.
fn in_a_terminal() -> Value {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("answer.json"), ANSWER).unwrap();
    let run = |words: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
        command.args(words.split_whitespace()).current_dir(folder.path());
        let output = command.output().unwrap();
        json!([words, output.status.code(), String::from_utf8(output.stdout).unwrap()])
    };
    COMMANDS.iter().map(|words| run(words)).collect()
}

/// The result of a command, of `compare` without the times: of each line what is left of them.
fn timeless(result: &Value) -> Value {
    let (words, text) = (result[0].as_str().unwrap(), result[2].as_str().unwrap());
    match text.lines().find_map(|line| line.split_once("time (ms)")) {
        Some((before, _)) if words.starts_with("compare") => {
            let columns = before.chars().count();
            let left = |line: &str| line.chars().take(columns).collect::<String>();
            json!([words, result[1], text.lines().map(left).collect::<Vec<_>>()])
        }
        _ => result.clone(),
    }
}

#[test]
#[ignore = "needs the wheel for Pyodide: python3 release/pyodide.py"]
fn the_command_line_prints_in_a_browser_what_it_prints_in_a_terminal() {
    let (seen, expected) = (in_a_browser(), in_a_terminal());
    let [seen, expected] = [&seen, &expected].map(|value| value.as_array().expect("an array"));
    for (seen, expected) in seen.iter().zip(expected) {
        assert_eq!(timeless(seen), timeless(expected));
    }
    assert_eq!(seen.len(), COMMANDS.len());
}
