//! Plug-ins as programs of their own: what the protocol promises, and what hostile ones cannot do.

mod examples;
mod hostile;
mod protocol;

use std::path::{Path, PathBuf};
use std::time::Duration;

use lcplab_judge::{Certificate, Demand, judge};
use lcplab_lcp::Lcp;
use lcplab_plugin::Plugin;
use lcplab_solver::{ConeEntry, Entry, Method, Options, Solution, Start};
use lcplab_testing::contacts;

/// Long enough for any answer here, beside other work.
const LONG: Duration = Duration::from_secs(60);

/// 2x₀ − x₁ − 1, −x₀ + 2x₁ + 2 for two contacts: x = (½, 0).
fn pushed() -> Lcp {
    contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-1.0, 2.0])
}

/// A Python program of these lines, in a folder of its own.
struct Script {
    folder: tempfile::TempDir,
    file: PathBuf,
}

impl Script {
    fn new(name: &str, lines: &str) -> Script {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(format!("{name}.py"));
        std::fs::write(&file, lines).unwrap();
        Script { folder, file }
    }

    /// `answer` is the body of a loop over the problems p; the handshake with one row is answered
    /// beforehand.
    fn answering(name: &str, answer: &str) -> Script {
        let lines = format!(
            "import json, os, subprocess, sys, time\nfor line in sys.stdin:\n    p = json.loads(line)\n    n = len(p['b'])\n    \
             if n == 1:\n        print('{{\"x\": [1]}}', flush=True)\n        continue\n    {answer}\n"
        );
        Script::new(name, &lines)
    }

    fn start(&self, limit: Duration) -> Plugin {
        start(&self.file, limit)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }
}

fn start(file: &Path, limit: Duration) -> Plugin {
    Plugin::start(&format!("python3 '{}'", file.display()), limit.as_secs_f64()).unwrap()
}

/// Its methods for boxes and for cones.
fn entry(plugin: &Plugin) -> &Entry {
    plugin.methods().iter().find_map(Method::boxed).unwrap()
}

fn cone_entry(plugin: &Plugin) -> Option<&ConeEntry> {
    plugin.methods().iter().find_map(|method| match method {
        Method::Cone(entry) => Some(entry),
        Method::Boxed(_) => None,
    })
}

fn solve(plugin: &Plugin, lcp: &Lcp) -> (Solution, Certificate) {
    let solver = entry(plugin).build(&Options::default());
    let solution = solver.solve(lcp, &Start::default(), &mut ());
    let certificate = judge(lcp, &solution.x, &Demand::default());
    (solution, certificate)
}
