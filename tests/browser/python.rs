//! Python cells in the reader's browser: all of them print what the lessons say, can be changed,
//! name the line of an error, and can be stopped.
//!
//! Pyodide is needed once: `npm install --prefix target/pyodide pyodide@314`, or any other
//! distribution in the folder that LCPLAB_PYODIDE names.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};
use tempfile::TempDir;

use super::driver::{Page, served};

pub fn pyodide() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/pyodide/node_modules/pyodide");
    let folder = std::env::var_os("LCPLAB_PYODIDE").map_or(own, PathBuf::from);
    let message = "these tests need Pyodide: npm install --prefix target/pyodide pyodide@314";
    assert!(folder.join("pyodide.mjs").exists(), "{message}");
    folder
}

/// A folder with these lessons, whose cells can be run.
fn lessons(which: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    command.args(["lesson", which, "--pyodide"]).arg(pyodide()).arg("--out").arg(folder.path());
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

/// Clicks of a reader: cell k of a page, and what it ends with.
const CLICKS: &str = "
    const cells = (page) => all('div.python', page.document);
    const output = (cell) => { const place = find('.language-text', cell); return shown(place) ? place.textContent.trimEnd() : ''; };
    const status = (cell) => find('.status', cell).textContent;
    const ended = async (cell) => {
        while (!/^(Done|Error|Stopped|Python could)/.test(status(cell))) await wait(20);
        return status(cell).replace(/[0-9.]+ s/, 's');
    };
    const run = (cell) => { find('.status', cell).textContent = ''; find('.run', cell).click(); return ended(cell); };
    const code = (cell) => find('[contenteditable]', cell);
    const write = (cell, text) => { code(cell).textContent = text; code(cell).dispatchEvent(new Event('input')); };
";

/// Runs the cells of every second lesson, from this one on, in one browser, and compares what they
/// print with the lessons; returns the number of lessons.
fn cells_of_every_second_lesson(first: usize) -> usize {
    let folder = lessons("--all");
    let mut names: Vec<_> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.starts_with(char::is_numeric) && name.ends_with(".html"))
        .collect();
    names.sort();
    let names: Vec<String> = names.into_iter().skip(first).step_by(2).collect();
    let script = format!(
        "{CLICKS}
        const wrong = [];
        let count = 0;
        for (const name of {}) {{
            const page = await open(name), of = cells(page);
            all('details.part', page.document).forEach((part) => part.open = true);
            const said = of.map(output);
            count += of.length;
            const end = await run(of.at(-1));
            if (end !== 'Done in s') wrong.push([name, end]);
            of.forEach((cell, k) => {{ if (output(cell) !== said[k]) wrong.push([name, k + 1, output(cell), said[k]]); }});
        }}
        return {{ wrong, count }};",
        json!(names)
    );
    let seen = served(folder.path(), &script);
    assert_eq!(seen["wrong"], json!([]));
    let written = |name: &String| {
        let lesson =
            format!("{}/notebooks/{}", env!("CARGO_MANIFEST_DIR"), name.replace("html", "md"));
        std::fs::read_to_string(lesson).unwrap().matches("\n```python\n").count()
    };
    assert_eq!(seen["count"], Value::from(names.iter().map(written).sum::<usize>()));
    names.len()
}

// Two tests, so that two processors share the longest work of this suite.

#[test]
fn every_cell_of_lessons_with_odd_numbers_prints_what_the_lesson_says() {
    assert_eq!(cells_of_every_second_lesson(0), 9);
}

#[test]
fn every_cell_of_lessons_with_even_numbers_prints_what_the_lesson_says() {
    assert_eq!(cells_of_every_second_lesson(1), 8);
}

#[test]
fn a_changed_cell_runs_as_if_for_the_first_time_and_can_be_reset() {
    let folder = lessons("4");
    // The last cell of lesson 4 changes u in place.
    let script = format!(
        "{CLICKS}
        const page = await open('04_sweeping.html'), last = cells(page).at(-1), said = output(last), original = code(last).textContent;
        const ends = [await run(last), output(last) === said, await run(last), output(last) === said];
        write(last, `${{original.trimEnd()}}\nprint(6 * 7)\n`);
        ends.push(await run(last), output(last).split('\\n')[1]);
        all('.bar button', last)[1].click();
        ends.push(await run(last), output(last) === said && code(last).textContent === original);
        return ends;"
    );
    let done = "Done in s";
    let line = "42";
    let expected = json!([done, true, done, true, done, line, done, true]);
    assert_eq!(served(folder.path(), &script), expected);
}

#[test]
fn an_error_names_its_cell_and_line_and_the_cells_above_run_first() {
    let folder = lessons("1");
    let script = format!(
        "{CLICKS}
        const page = await open('01_complementarity.html'), [first, second, third] = cells(page);
        write(second, 'def f(x):\\n    return np.linalg.norm(x) + y\\nf([3.0, 4])\\n');
        const ends = [await run(third), output(second), find('pre.failed', second) !== null];
        write(second, 'print(v_star < 0)\\nif True print(1)\\n');
        ends.push(await run(second), output(second).includes('cell 2\", line 2'), output(second).includes('SyntaxError'), output(first).startsWith('v* = '));
        write(second, 'np.fft(1)\\n');
        ends.push(await run(second), output(second).split('\\n').at(-1));
        return ends;"
    );
    let seen = served(folder.path(), &script);
    let traceback = seen[1].as_str().unwrap();
    assert_eq!(seen[0], "Error in cell 2");
    for part in ["File \"cell 2\", line 3", "return np.linalg.norm(x) + y", "NameError: name 'y'"] {
        assert!(traceback.contains(part), "{traceback}");
    }
    assert!(!traceback.contains("arrays.py") && !traceback.contains("in run"), "{traceback}");
    assert_eq!(seen[2], true);
    assert_eq!(
        seen.as_array().unwrap()[3..7],
        [json!("Error in cell 2"), json!(true), json!(true), json!(true)]
    );
    let missing =
        "AttributeError: NumPy is missing here, and arrays.py, which replaces it, has no fft";
    assert_eq!(seen[8], missing);
}

#[test]
fn an_endless_cell_is_stopped_by_its_button_by_time_and_by_its_output() {
    let folder = lessons("1");
    let script = format!(
        "{CLICKS}
        const page = await open('01_complementarity.html'), [first, second] = cells(page);
        write(second, 'while True: pass\\n');
        find('.run', second).click();
        while (!status(second).startsWith('Running cell 2')) await wait(20);
        const others = cells(page).map((cell) => find('.run', cell).disabled);
        find('.run', second).click();
        const ends = [others, await ended(second), find('.run', second).textContent];
        const slow = page.setTimeout;
        page.setTimeout = (act, ms) => slow.call(page, act, ms / 60); // 60 s pass in one
        ends.push(await run(second));
        page.setTimeout = slow;
        write(second, 'while True: print(\"again and again\")\\n');
        ends.push(await run(second), output(second).length < 200000);
        ends.push(await run(first), output(first).startsWith('v* = '));
        return ends;"
    );
    let ends = json!([
        [true, false, true, true],
        "Stopped. Python starts again at the next run.",
        "Run cell 2",
        "Stopped: cell 2 ran for s. Python starts again at the next run.",
        "Stopped: cell 2 printed more than 100000 characters. Python starts again at the next run.",
        true,
        "Done in s",
        true,
    ]);
    assert_eq!(served(folder.path(), &script), ends);
}

#[test]
fn python_starts_from_the_memory_that_an_earlier_page_kept_unless_it_is_spoiled() {
    let folder = lessons("1");
    // Each start of Python draws another seed for the hashes of texts; a kept memory holds its own.
    let script = format!(
        "{CLICKS}
        const hash = async () => {{
            const page = await open('01_complementarity.html'), [first] = cells(page);
            write(first, 'print(hash(\"text\"))');
            const end = await run(first);
            return end === 'Done in s' ? Number(output(first)) : end;
        }};
        const kept = async () => {{
            const cache = await caches.open('lcplab'), [place] = await cache.keys();
            return {{ cache, place, size: place ? (await (await cache.match(place)).arrayBuffer()).byteLength : 0 }};
        }};
        const isKept = async () => {{ while ((await kept()).size < 1e6) await wait(50); }};
        const cold = await hash();
        await isKept();
        const warm = await hash(), {{ cache, place }} = await kept();
        await cache.put(place, new Response('spoiled'));
        const afresh = await hash();
        await isKept();
        return [cold, warm, afresh, await hash()];"
    );
    let seen = served(folder.path(), &script);
    let hash = |k: usize| seen[k].as_i64().unwrap_or_else(|| panic!("{seen}"));
    assert_eq!(hash(0), hash(1));
    assert_ne!(hash(1), hash(2));
    assert_eq!(hash(2), hash(3));
}

#[test]
fn enter_keeps_the_indentation_and_shift_enter_runs() {
    let folder = lessons("1");
    let script = format!(
        "{CLICKS}
        const page = await open('01_complementarity.html'), [first] = cells(page);
        write(first, 'for k in 1, 2:');
        code(first).focus();
        page.getSelection().selectAllChildren(code(first));
        page.getSelection().collapseToEnd();
        const press = (init) => code(first).dispatchEvent(new page.KeyboardEvent('keydown', {{ key: 'Enter', bubbles: true, cancelable: true, ...init }}));
        press({{}});
        page.document.execCommand('insertText', false, 'print(k)');
        const text = code(first).innerText;
        press({{ shiftKey: true }});
        return [text.trimEnd(), await ended(first), output(first), code(first).getAttribute('role')];"
    );
    let expected = json!(["for k in 1, 2:\n    print(k)", "Done in s", "1\n2", "textbox"]);
    assert_eq!(served(folder.path(), &script), expected);
}

#[test]
fn a_page_opened_as_a_file_is_readable_and_says_how_its_cells_run() {
    let folder = lessons("1");
    let page = std::fs::read_to_string(folder.path().join("01_complementarity.html")).unwrap();
    let script = "return [all('.python .bar, .python [contenteditable]').length, all('.hint').length, find('.hint').textContent.includes('http.server')];";
    assert_eq!(Page(page.clone()).seen(390, script), json!([0, 1, true]));
    assert!(page.contains("; worker-src 'self';"));
    let plain = super::written(&["lesson", "1"], "01_complementarity.html");
    assert!(!plain.0.contains("worker-src") && !plain.0.contains("python/worker.js"));
}
