//! The recorded comparison with other engines as one table, and the goals that it misses.

use std::fmt::Write;

use lcplab::error::{Error, Result};
use lcplab::number::readable;
use serde::Deserialize;

use crate::recording::{Machine, Problem, Recording, Scene};

/// A goal compared with another engine, set before anything was measured.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    /// The problem, or the scene of which a step counts.
    pub problem: String,
    /// Our method; the fastest of ours without one.
    pub ours: Option<String>,
    /// How the names of its contenders begin, of which the fastest counts; any without one.
    pub peer: Option<String>,
    /// The required ratio of speeds.
    pub faster: f64,
}

/// The goals of `goals.toml` that a recording decides.
#[derive(Deserialize)]
struct Goals {
    peers: Vec<Goal>,
}

/// The recorded run.
///
/// # Errors
/// If it was not written by this version.
pub fn recorded() -> Result<Recording> {
    let text = include_str!("../peers.json");
    serde_json::from_str(text)
        .map_err(|cause| Error::invalid("benches/peers.json", "recording", cause.to_string()))
}

/// The goals compared with other engines.
///
/// # Errors
/// If the file of goals has defects.
pub fn goals() -> Result<Vec<Goal>> {
    let goals: Goals = toml::from_str(include_str!("../goals.toml"))
        .map_err(|cause| Error::invalid("benches/goals.toml", "peers", cause.to_string()))?;
    Ok(goals.peers)
}

/// Libraries as the names of contenders and engines begin, ours first.
const LIBRARIES: [&str; 7] = ["lcplab", "ODE", "DART", "Bullet", "Siconos", "clarabel", "Rapier"];

/// The table in Markdown: the least time in ms of each library's methods, a dash where none
/// answered.
pub fn markdown(recording: &Recording) -> String {
    let mut text = String::from("| problem | rows |");
    LIBRARIES.iter().for_each(|library| _ = write!(text, " {library} |"));
    text += "\n|---|---:|";
    LIBRARIES.iter().for_each(|_| text += "---:|");
    for problem in &recording.problems {
        let times =
            LIBRARIES.map(|library| problem.best(|name, ours| owner(name, ours) == library));
        text += &row(&problem.name, &problem.rows.to_string(), times);
    }
    for scene in &recording.scenes {
        let times = LIBRARIES.map(|library| scene.best(|name, ours| owner(name, ours) == library));
        text += &row(&format!("{}, a step", scene.name), "", times);
    }
    text + "\n"
}

/// The library of a contender.
fn owner(name: &str, ours: bool) -> &str {
    if ours { LIBRARIES[0] } else { name.split([' ', ',']).next().unwrap_or(name) }
}

/// A line of the table, the least time in bold.
fn row(name: &str, rows: &str, times: [Option<f64>; LIBRARIES.len()]) -> String {
    let least = times.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    let cell = |time: Option<f64>| match time.map(|time| (time == least, readable(1e3 * time, 3))) {
        None => " – |".to_string(),
        Some((true, text)) => format!(" **{text}** |"),
        Some((false, text)) => format!(" {text} |"),
    };
    format!("\n| {name} | {rows} |") + &times.map(cell).concat()
}

/// The page of the recorded run: where it was made, the table, and the goals it misses.
pub fn page(recording: &Recording, goals: &[Goal]) -> String {
    let Machine { processor, threads, system, compiler } = &recording.machine;
    let libraries = recording.libraries.iter().filter_map(|library| {
        library.version.as_ref().map(|version| format!("{} {version}", library.name))
    });
    let missed: Vec<String> = goals.iter().filter_map(|goal| recording.missed(goal)).collect();
    let missed = if missed.is_empty() { "- none\n".into() } else { missed.concat() };
    format!(
        "# Other engines\n\n\
         Recorded on {}, on {processor} ({threads} threads, one used), {system}, {compiler}, with {}.\n\n\
         Milliseconds, the best of all rounds, of the fastest method of each library whose answer was \
         accepted. All were\ngiven the same numbers, in turns, in one process; scenes use the smallest \
         number of iterations that keeps the cubes in place.\n`cargo run -p lcplab-benches` writes this page from \
         `peers.json`, which has every method, answer and median.\n\n\
         {}\nGoals of [goals.toml](goals.toml) that this run misses:\n\n{missed}",
        recording.date,
        libraries.collect::<Vec<_>>().join(", "),
        markdown(recording),
    )
}

impl Recording {
    /// The ratio of the speeds by the best of all rounds; none if either has no answer.
    pub fn faster(&self, goal: &Goal) -> Option<f64> {
        let method = |name: &str| goal.ours.as_deref().is_none_or(|ours| ours == name);
        let peer = |name: &str| goal.peer.as_deref().is_none_or(|peer| name.starts_with(peer));
        let ours = self.best(&goal.problem, |name, ours| ours && method(name))?;
        Some(self.best(&goal.problem, |name, ours| !ours && peer(name))? / ours)
    }

    /// The least time (s) for a problem, or for a step of a scene.
    fn best(&self, name: &str, who: impl Fn(&str, bool) -> bool) -> Option<f64> {
        match self.problems.iter().find(|problem| problem.name == name) {
            Some(problem) => problem.best(who),
            None => self.scenes.iter().find(|scene| scene.name == name)?.best(who),
        }
    }

    /// A line on a goal that is missed.
    fn missed(&self, goal: &Goal) -> Option<String> {
        let measured = self.faster(goal);
        if measured.is_some_and(|faster| faster >= goal.faster) {
            return None;
        }
        Some(format!(
            "- {}: {} is {} times as fast as {}, not {}\n",
            goal.problem,
            goal.ours.as_deref().unwrap_or("our fastest"),
            measured.map_or("–".into(), |faster| readable(faster, 3)),
            goal.peer.as_deref().unwrap_or("the fastest of the others"),
            readable(goal.faster, 3),
        ))
    }
}

impl Problem {
    /// The least time (s) of the contenders that have an answer, selected by their name and whether
    /// they are ours.
    fn best(&self, who: impl Fn(&str, bool) -> bool) -> Option<f64> {
        let times = self.answers.iter().filter(|answer| who(&answer.contender, answer.ours));
        times.filter_map(|answer| answer.time).map(|time| time.best).reduce(f64::min)
    }
}

impl Scene {
    /// The least time (s) of a step of the engines, selected likewise.
    fn best(&self, who: impl Fn(&str, bool) -> bool) -> Option<f64> {
        let engines = self.engines.iter().filter(|engine| who(&engine.engine, engine.ours));
        engines.filter_map(|engine| engine.step).map(|time| time.best).reduce(f64::min)
    }
}
