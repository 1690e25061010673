//! Solvers in any language: external programs that read problems and write answers, line by line.
//!
//! ```text
//! lcplab  →  {"A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, 2], "lo": [0, 0], "hi": ["inf", "inf"],
//!             "tolerance": 1e-8, "max_iterations": 10000, "time_limit": 10}
//! plug-in →  {"x": [0.5, 0]}
//! ```
//!
//! Each input line is one problem in JSON, each output line its answer. The program keeps running
//! for the next problem, so that it starts only once. The judge checks the x of a plug-in as it
//! checks any solver's. A plug-in that hangs, crashes or writes invalid output is stopped; the
//! status is [`Status::NoAnswer`] with the reason, and the plug-in is restarted for the next
//! problem.
//!
//! A plug-in receives boxed problems. It receives friction cones only if its answer to the first
//! problem lists their models under the key `models`: then the key `model` of a problem gives the
//! friction law.
//!
//! `docs/plugins.md` describes the protocol key by key.

#[doc(hidden)] // for other programs that lcplab runs
pub mod group;
mod message;
mod process;

use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use lcplab_lcp::Lcp;
use lcplab_lcp::error::{Defects, Error, Result};
use lcplab_lcp::friction::{ConeProblem, Law, Model};
use lcplab_solver::{
    Class, ConeEntry, ConeSolver, Entry, Event, Iterate, MatrixClass, Method, Observer, Registry,
    Settings, Solution, Solver, Start, Status,
};

use self::message::Answer;
use self::process::{Process, Trouble};

/// An external program that solves problems. Dropping the value ends the program.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_plugin::{Declaration, Plugin};
/// use lcplab_solver::{Options, Registry, Start, Status};
///
/// // A program in Python for one row: x = max(−b/a, 0).
/// let code = r#"
/// import json, sys
/// for line in sys.stdin:
///     problem = json.loads(line)
///     a, b = problem["A"]["dense"][0][0], problem["b"][0]
///     print(json.dumps({"x": [max(-b / a, 0)]}), flush=True)
/// "#;
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("mine.py");
/// std::fs::write(&path, code).unwrap();
/// let plugin = Plugin::start(&format!("mine=python3 {}", path.display()), 10.0)?;
/// assert_eq!((plugin.name(), plugin.methods().len()), ("mine", 1)); // boxed problems only
/// let mut registry = Registry::default();
/// plugin.add_to(&mut registry)?;
/// let solver = registry.entry("mine")?.solver(&Options::default())?;
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![9.0])?;
/// let solution = solver.solve(&lcp, &Start::default(), &mut ());
/// assert_eq!((solution.status, solution.x), (Status::Solved, vec![0.5]));
///
/// // As a file declares it; here without a command.
/// let empty: Declaration = serde_json::from_str(r#"{"command": ""}"#).unwrap();
/// assert!(Plugin::declared("mine", &empty).is_err());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Plugin {
    name: String,
    program: Arc<Program>,
    methods: Vec<Method>,
}

/// A plug-in as declared in a file, under its name.
///
/// ```toml
/// [plugins.mine]
/// command = "python3 mine.py"
/// class = "semidefinite"
/// settings = { sweeps = 50 }
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Declaration {
    /// The command, split into words as a shell does; no shell runs it.
    pub command: String,
    /// The matrices it accepts, [`MatrixClass::word`]; any matrix if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub class: Option<String>,
    /// Sent with every problem under the key `settings`.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub settings: Map<String, Value>,
    /// Time limit for one answer (s).
    #[serde(default = "ten")]
    pub time_limit: f64,
}

fn ten() -> f64 {
    10.0
}

impl Declaration {
    /// A declaration of this command, with defaults for everything else.
    pub(crate) fn of(command: impl Into<String>) -> Self {
        let (class, settings, time_limit) = (None, Map::new(), ten());
        Declaration { command: command.into(), class, settings, time_limit }
    }
}

impl Plugin {
    /// Starts the plug-in that a command line names: a command, or `NAME=COMMAND`. Without a name
    /// it is named after its file. `time_limit` is the limit for one answer (s).
    ///
    /// # Errors
    /// As [`Plugin::declared`].
    pub fn start(spec: &str, time_limit: f64) -> Result<Plugin> {
        let (name, command) = named(spec);
        Plugin::declared(&name, &Declaration { time_limit, ..Declaration::of(command) })
    }

    /// Starts a program.
    ///
    /// # Errors
    /// If the command, the class, the limit or the name cannot be used, or the program does not
    /// answer a problem of one row.
    pub fn declared(name: &str, declaration: &Declaration) -> Result<Plugin> {
        let Declaration { command, class, settings, time_limit } = declaration;
        let mut defects = Defects::default();
        let words = shlex::split(command).unwrap_or_default();
        if words.is_empty() {
            defects.add("command", format!("{command:?} is not a command"));
        } else if !is_name(name) {
            let reason = "must have at least one character, only letters, digits, _ and -";
            defects.add("name", format!("{name:?} {reason}; write NAME=COMMAND"));
        }
        let limit = Duration::try_from_secs_f64(*time_limit).unwrap_or_default();
        if limit.is_zero() {
            defects.add("time_limit", format!("must be above 0, is {time_limit}"));
        }
        let matrix = class.as_deref().map_or(Ok(MatrixClass::General), MatrixClass::by_word);
        if let Err(cause) = &matrix {
            defects.add("class", cause.to_string());
        }
        defects.into_result(format!("plug-in {name}").trim_end())?;
        // Plug-ins do not say whether they divide by the diagonal; assume that they do.
        let class = Class { divides_by_diagonal: true, ..Class::of(matrix?) };
        let (settings, process) = (settings.clone(), Mutex::new(None));
        let program = Arc::new(Program { words, settings, time_limit: limit, process });
        let laws = program
            .greet()
            .map_err(|reason| Error::invalid(format!("plug-in {name}"), "start", reason))?;
        let (shared, outside) = (Arc::clone(&program), name.to_string());
        let outside = move |settings: &Settings| Outside {
            name: outside.clone(),
            program: Arc::clone(&shared),
            settings: settings.clone(),
        };
        let build = outside.clone();
        let mut entry =
            Entry::new(name.to_string(), move |options| Box::new(build(&options.settings)));
        (entry.method, entry.source, entry.class) = ("a plug-in", "a plug-in", class);
        let mut methods = vec![Method::Boxed(entry)];
        if !laws.is_empty() {
            let build =
                move |settings: &Settings| -> Box<dyn ConeSolver> { Box::new(outside(settings)) };
            let mut entry = ConeEntry::new(name.to_string(), laws, build);
            (entry.method, entry.source, entry.class) = ("a plug-in", "a plug-in", class);
            methods.push(Method::Cone(entry));
        }
        Ok(Plugin { name: name.to_string(), program, methods })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its methods: for boxes, and for friction cones if its first answer lists their models.
    pub fn methods(&self) -> &[Method] {
        &self.methods
    }

    /// Adds its methods to a registry. They give no answers once this value is dropped.
    ///
    /// # Errors
    /// If the registry has a solver of this name.
    pub fn add_to(&self, registry: &mut Registry) -> Result<()> {
        self.methods.iter().try_for_each(|method| registry.add(method.clone()))
    }
}

impl Drop for Plugin {
    fn drop(&mut self) {
        self.program.end();
    }
}

/// The name and the command. Without a name, that of the first file among the arguments of the
/// command, such as an interpreter's script; or else that of the program if it is given by its
/// path; or else its last argument that is no option.
fn named(spec: &str) -> (String, &str) {
    if let Some((name, command)) = spec.split_once('=').filter(|(name, _)| is_name(name)) {
        return (name.to_string(), command);
    }
    let words = shlex::split(spec).unwrap_or_default();
    let program = words.first().filter(|program| program.contains('/'));
    let script = || words.iter().skip(1).find(|word| Path::new(word).is_file());
    let last = || words.iter().rev().find(|word| !word.starts_with('-'));
    let file = script().or(program).or_else(last);
    let stem = || Path::new(file?).file_stem()?.to_str().map(str::to_string);
    (stem().unwrap_or_default(), spec)
}

fn is_name(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "_-".contains(c))
}

/// A command and the process that runs it.
#[derive(Debug)]
struct Program {
    words: Vec<String>,
    settings: Map<String, Value>,
    time_limit: Duration,
    /// `None` before the first problem, and after one that the process did not survive.
    process: Mutex<Option<Process>>,
}

impl Program {
    /// Sends a problem of one row, so that the program's start does not delay later answers. The
    /// answer lists the friction cone laws that the program supports.
    fn greet(&self) -> std::result::Result<Vec<Law>, String> {
        let one = [1.0];
        let lcp = Lcp::new(lcplab_lcp::Matrix::dense(1, &one), vec![-1.0], vec![0.0], vec![2.0])
            .map_err(|error| error.to_string())?;
        let answer = self.ask(&lcp, None, &Start::default(), &Settings::default())?;
        Ok(answer.laws)
    }

    /// The answer to a problem, or why there is none. A process that gives no answer is stopped.
    fn ask(
        &self,
        lcp: &Lcp,
        model: Option<Model>,
        start: &Start<'_>,
        settings: &Settings,
    ) -> std::result::Result<Answer, String> {
        let request =
            message::request(lcp, model, start, settings, &self.settings, self.time_limit);
        let mut process = self.process.lock().unwrap_or_else(PoisonError::into_inner);
        let longest = message::longest(lcp.len());
        let ask = |mut running: Process| match running.ask(&request, longest, self.time_limit) {
            Ok(line) => Ok((running, line)),
            Err(trouble) => Err(trouble),
        };
        let again = match process.take().map(ask) {
            Some(Err(Trouble::Ended(_))) | None => ask(Process::start(&self.words)?),
            Some(answered) => answered,
        };
        let (running, line) = again.map_err(Trouble::in_words)?;
        let answer = Answer::read(&line, lcp.len())?;
        *process = Some(running);
        Ok(answer)
    }

    fn end(&self) {
        self.process.lock().unwrap_or_else(PoisonError::into_inner).take();
    }
}

/// The plug-in as a solver.
struct Outside {
    name: String,
    program: Arc<Program>,
    settings: Settings,
}

impl Solver for Outside {
    fn name(&self) -> &str {
        &self.name
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let model = lcp.coupling().map(|_| Model::CoupledBox);
        self.answered(lcp, model, start.point(lcp), start, observer)
    }
}

impl ConeSolver for Outside {
    fn name(&self) -> &str {
        &self.name
    }

    fn solve(
        &self,
        problem: &ConeProblem,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        let model = match problem.law() {
            Law::Associated => Model::AssociatedCone,
            Law::Coulomb => Model::CoulombCone,
        };
        // As in a problem file, friction_index and mu list the contacts, and the model says what
        // they mean.
        let boxed = problem.friction().coupled_box();
        self.answered(&boxed, Some(model), start.point(problem), start, observer)
    }
}

impl Outside {
    /// The program's answer as a solution; `first` is the starting point.
    fn answered(
        &self,
        lcp: &Lcp,
        model: Option<Model>,
        first: Vec<f64>,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        let started = Iterate { iteration: 0, x: &first, event: Event::Start };
        if observer.observe(&started).is_break() {
            return Solution::new(lcp, first, Status::Stopped, 0);
        }
        let answer = match self.program.ask(lcp, model, start, &self.settings) {
            Ok(answer) => answer,
            Err(reason) => return Solution::new(lcp, first, Status::NoAnswer { reason }, 0),
        };
        for (k, x) in answer.iterates.iter().enumerate() {
            let iterate = Iterate { iteration: k + 1, x, event: Event::Step };
            if observer.observe(&iterate).is_break() {
                return Solution::new(lcp, x.clone(), Status::Stopped, k + 1);
            }
        }
        let x = answer.x.unwrap_or(first);
        Solution::new(lcp, x, answer.status, answer.iterations)
            .with_implied_claim(answer.is_claim_implied)
    }
}
