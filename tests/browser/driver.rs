//! A page in headless Chromium: a copy of it, in a frame of a given width, with a script before its
//! policy, which lets no other one in; and what that script saw when all was loaded.
//!
//! ```text
//! page + script ─→ frame.html in index.html ─→ chromium --dump-dom ─→ what the script saw, as JSON
//! ```
//!
//! Time is virtual, so that an animation of seconds is over at once. Frames are not drawn then, so
//! callbacks of `requestAnimationFrame` come from a timer.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Duration;

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

/// What a script returns that opens pages of a folder in a frame. The folder is served over HTTP,
/// and time is real: workers start in no other way.
pub fn served(folder: &Path, script: &str) -> Value {
    let page = format!(
        "<!DOCTYPE html><html><body><script type=\"module\">{TOOLS}
        const open = async (name, width = 1280) => {{
            document.querySelector('iframe')?.remove();
            const frame = document.createElement('iframe');
            frame.style = `width:${{width}}px;height:900px`;
            frame.src = name;
            await new Promise((done) => {{ frame.onload = done; document.body.append(frame); }});
            return frame.contentWindow;
        }};
        const run = async () => {{ {script} }};
        const seen = await run().catch((reason) => String(reason.stack));
        await fetch('seen', {{ method: 'POST', body: JSON.stringify(seen) }});
        </script></body></html>"
    );
    fs::write(folder.join("test.html"), page).unwrap();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("http://{}/test.html", listener.local_addr().unwrap());
    let (answers, seen) = channel();
    let root = folder.to_path_buf();
    thread::spawn(move || {
        for stream in listener.incoming().map_while(Result::ok) {
            let (root, answers) = (root.clone(), answers.clone());
            thread::spawn(move || answer(&stream, &root, &answers));
        }
    });
    let profile = tempfile::tempdir().unwrap();
    let mut command = Command::new(program());
    command.args(["--headless=new", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr"]);
    command.arg(format!("--user-data-dir={}", profile.path().display())).arg(address);
    let mut browser = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let seen = seen.recv_timeout(Duration::from_secs(600));
    browser.kill().unwrap();
    let said = browser.wait_with_output().unwrap().stderr;
    let said = String::from_utf8_lossy(&said).into_owned();
    let console: Vec<_> = said.lines().filter(|line| line.contains("CONSOLE")).collect();
    assert!(console.is_empty(), "{console:#?}");
    seen.unwrap_or_else(|_| panic!("the script did not come to its end\n{said}"))
}

/// Answers one request: a file of the folder, or what the script has seen.
fn answer(stream: &TcpStream, root: &Path, answers: &Sender<Value>) {
    let mut reader = BufReader::new(stream);
    let mut head = Vec::new();
    for line in reader.by_ref().lines().map_while(Result::ok).take_while(|line| !line.is_empty()) {
        head.push(line);
    }
    let Some(request) = head.first() else { return };
    let path = request.split(' ').nth(1).unwrap_or("/").trim_start_matches('/');
    let mut stream = stream;
    if request.starts_with("POST") {
        let lengths = head.iter().filter_map(|line| line.split_once(": "));
        let length = lengths.filter(|(name, _)| name.eq_ignore_ascii_case("content-length"));
        let length = length.map(|(_, value)| value.parse().unwrap()).next().unwrap_or(0);
        let mut body = vec![0; length];
        reader.read_exact(&mut body).unwrap();
        let _ = stream.write_all(b"HTTP/1.1 204 No Content\r\nConnection: close\r\n\r\n");
        let _ = answers.send(serde_json::from_slice(&body).unwrap());
        return;
    }
    let kind = match path.rsplit('.').next() {
        Some("html") => "text/html",
        Some("js" | "mjs") => "text/javascript",
        Some("wasm") => "application/wasm",
        _ => "application/octet-stream",
    };
    let (status, body) = match fs::read(root.join(path)) {
        Ok(body) => ("200 OK", body),
        Err(_) => ("404 Not Found", Vec::new()),
    };
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
        body.len()
    );
    let _ = stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(&body));
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
