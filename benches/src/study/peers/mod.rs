//! Other engines: a recorded run of `benches/peers`, beside what was asked for.
//!
//! The libraries are not part of lcplab, so a report cannot run them; it shows the last run that was
//! recorded, and says so.

mod recording;

pub use recording::{Answer, Bounds, Engine, Library, Machine, Problem, Recording, Scene};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use lcplab::error::{Error, Result};
use lcplab::report::study::Study;

/// The recorded run.
const RECORDED: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/peers.json"));

/// Nothing can be chosen about a recording.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {}

impl Study for Plan {
    const NAME: &'static str = "peers";
    type Finding = Recording;
    type Times = ();

    fn alone(&self) -> bool {
        true
    }

    fn tasks(&self) -> Vec<String> {
        vec!["recorded run".into()]
    }

    fn run(&self, _: usize) -> Result<(Recording, ())> {
        Ok((recorded()?, ()))
    }
}

/// The recorded run.
///
/// # Errors
/// If it was not written by this version.
pub fn recorded() -> Result<Recording> {
    serde_json::from_str(RECORDED)
        .map_err(|cause| Error::invalid("benches/peers.json", Plan::NAME, cause.to_string()))
}

/// What is asked of one of ours beside a peer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// The problem.
    pub problem: &'static str,
    /// Our method; the fastest of ours without one.
    pub ours: Option<&'static str>,
    /// The peer, or how the names of several begin, of which the fastest counts; the fastest of all if it is empty.
    pub peer: &'static str,
    /// At least so many times as fast.
    pub faster: f64,
}

/// All that is asked.
pub const GOALS: &[Goal] = &[
    goal("one-sided, n = 50", Some("dantzig"), "ODE Dantzig", 1.0),
    goal("one-sided, n = 200", Some("dantzig"), "ODE Dantzig", 1.2),
    goal("one-sided, n = 500", Some("dantzig"), "ODE Dantzig", 1.5),
    goal("one-sided, n = 1000", Some("dantzig"), "ODE Dantzig", 1.5),
    goal("two-sided, n = 500", Some("dantzig"), "ODE Dantzig", 1.5),
    goal("stack 5, regularised", Some("dantzig"), "ODE Dantzig", 1.0),
    goal("stack 10, regularised", Some("dantzig"), "ODE Dantzig", 1.0),
    goal("stack 20, regularised", Some("dantzig"), "ODE Dantzig", 1.0),
    goal("friction 5, regularised", Some("dantzig"), "ODE Dantzig", 1.0),
    goal("friction 10, regularised", Some("dantzig"), "ODE Dantzig", 1.0),
    goal("one-sided, n = 50", None, "", 1.0),
    goal("stack 5", None, "", 1.0),
    goal("stack 5, regularised", None, "", 1.0),
    goal("stack 10, regularised", None, "", 1.0),
    goal("friction 50, regularised", Some("lemke"), "", 1.0),
    goal("one-sided, n = 500", Some("block-pivoting"), "ODE Dantzig", 5.0),
    goal("one-sided, n = 1000", Some("block-pivoting"), "ODE Dantzig", 10.0),
    goal("two-sided, n = 500", Some("block-pivoting"), "ODE Dantzig", 10.0),
    goal("one-sided, n = 500", Some("block-pivoting"), "clarabel", 20.0),
    goal("one-sided, n = 1000", Some("block-pivoting"), "clarabel", 20.0),
    goal("one-sided, n = 500", Some("lemke"), "Siconos Lemke", 7.0),
    goal("two-sided, n = 500", Some("newton"), "Siconos Newton min-FB", 20.0),
    goal("net", None, "ODE Dantzig", 20.0),
    goal("net", None, "clarabel", 1.0),
];

const fn goal(
    problem: &'static str,
    ours: Option<&'static str>,
    peer: &'static str,
    faster: f64,
) -> Goal {
    Goal { problem, ours, peer, faster }
}

impl Recording {
    /// How many times as fast ours is, by the best of all rounds; none if either has no answer.
    pub fn faster(&self, goal: &Goal) -> Option<f64> {
        let problem = self.problems.iter().find(|problem| problem.name == goal.problem)?;
        let ours = problem
            .best(|answer| answer.ours && goal.ours.is_none_or(|name| answer.contender == name));
        let peer = problem.best(|answer| !answer.ours && answer.contender.starts_with(goal.peer));
        Some(peer? / ours?)
    }
}

impl Problem {
    /// The least time (s) of those contenders that have an answer.
    fn best(&self, who: impl Fn(&Answer) -> bool) -> Option<f64> {
        let times = self.answers.iter().filter(|answer| who(answer)).filter_map(|a| a.time);
        times.map(|time| time.best).reduce(f64::min)
    }
}
