//! A page in headless Chromium: a copy of it, in a frame of a given width, with a script before its
//! policy, which lets no other one in; and what that script saw when all was loaded.
//!
//! ```text
//! page + script ─→ frame.html in index.html ─→ chromium --dump-dom ─→ what the script saw, as JSON
//! ```
//!
//! Time is virtual, so that a film of seconds is over at once. Frames are not drawn then, so
//! callbacks of `requestAnimationFrame` come from a timer.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// Before the scripts of the page: frames from a timer, and an ear for complaints.
const BEFORE: &str = "
window.requestAnimationFrame = (tick) => setTimeout(() => tick(performance.now()), 16);
window.cancelAnimationFrame = clearTimeout;
window.complaints = [];
addEventListener('error', (event) => complaints.push(event.message));
addEventListener('unhandledrejection', (event) => complaints.push(String(event.reason)));
// Virtual time does not wait for a module that another thread compiles, so this thread does it.
WebAssembly.instantiate = async (bytes, imports) => {
    const module = new WebAssembly.Module(bytes);
    return { module, instance: new WebAssembly.Instance(module, imports) };
};
addEventListener('securitypolicyviolation', (event) => complaints.push(event.violatedDirective));
for (const kind of ['error', 'warn']) console[kind] = (...words) => complaints.push(words.join(' '));
";

/// What scripts of the tests may use.
const TOOLS: &str = "
const find = (name, within = document) => within.querySelector(name);
const all = (name, within = document) => [...within.querySelectorAll(name)];
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const press = (node, key) => node.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true }));
// Computed styles: checkVisibility does not see what changed since a frame was last drawn.
const shown = (node) => !node || (getComputedStyle(node).display !== 'none' && shown(node.parentElement));
";

/// A page and the folder that its copies are put into.
pub struct Page(pub String);

impl Page {
    /// What a script in the page returns, with the page in a frame of this width (px).
    pub fn seen(&self, width: u32, script: &str) -> Value {
        self.seen_by(&[], width, script)
    }

    /// The same with further options for the browser.
    pub fn seen_by(&self, options: &[&str], width: u32, script: &str) -> Value {
        let folder = tempfile::tempdir().unwrap();
        let after = format!(
            "addEventListener('load', async () => {{ {TOOLS}\n let answer = null;\n\
             try {{ answer = await (async () => {{ {script} }})(); }}\n\
             catch (reason) {{ complaints.push(String(reason)); }}\n\
             parent.postMessage(JSON.stringify({{ answer, complaints }}), '*'); }});"
        );
        let script = format!("<head><script>{BEFORE}{after}</script>");
        let page = self.0.replacen("<head>", &script, 1);
        fs::write(folder.path().join("frame.html"), page).unwrap();
        let frame = format!(
            "<!DOCTYPE html><html><body style=\"margin:0\"><script>\n\
             addEventListener('message', (event) => {{\n\
             const seen = document.body.appendChild(document.createElement('script'));\n\
             seen.type = 'application/json'; seen.id = 'seen';\n\
             seen.textContent = event.data.replaceAll('<', '\\\\u003c'); }});\n\
             </script><iframe src=\"frame.html\" style=\"border:0;width:{width}px;height:900px\">\
             </iframe></body></html>"
        );
        let index = folder.path().join("index.html");
        fs::write(&index, frame).unwrap();
        let flags = ["--enable-logging=stderr", "--virtual-time-budget=60000", "--dump-dom"];
        let output = chromium(folder.path(), &[&flags[..], options].concat(), &index);
        let [dom, said] = [output.stdout, output.stderr]
            .map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        let console: Vec<_> = said.lines().filter(|line| line.contains("CONSOLE")).collect();
        assert!(console.is_empty(), "{console:#?}");
        let rest = dom.split("id=\"seen\">").nth(1);
        let json = rest.and_then(|rest| rest.split("</script>").next());
        let json = json.unwrap_or_else(|| panic!("the script did not come to its end\n{said}"));
        let mut seen: Value = serde_json::from_str(json).unwrap();
        assert_eq!(seen["complaints"], serde_json::json!([]));
        seen["answer"].take()
    }
}

/// Runs Chromium on a page.
pub fn chromium(folder: &Path, options: &[&str], page: &Path) -> Output {
    let mut command = Command::new(program());
    command.args(["--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1400,1000"]);
    command.arg(format!("--user-data-dir={}", folder.join("profile").display()));
    command.args(options).arg(page).output().unwrap()
}

fn program() -> PathBuf {
    let path = std::env::var_os("PATH").unwrap();
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let mut programs = std::env::split_paths(&path).flat_map(|at| names.map(|name| at.join(name)));
    programs.find(|program| program.is_file()).expect("these tests need Chromium on the PATH")
}
