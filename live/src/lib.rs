//! What the live pages ask, as JSON in and out: the same solvers and the same judge as everywhere
//! else.
//!
//! A page sends a question as text and gets the answer as text, natively by [`answer`], in a
//! browser through the three functions of [`abi`]. Numbers keep all their bits on the way.

#![deny(missing_docs)]

pub mod abi;
mod column;
mod friction;
mod problem;
mod rod;
mod solutions;
mod trace;

use serde::Deserialize;
use serde_json::{Value, json};

/// What a page wants to know.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
enum Question {
    /// The steps of a solver on a problem.
    Trace(trace::Question),
    /// All solutions of a small problem.
    Solutions(solutions::Question),
    /// The problem of a column of bodies.
    Column(column::Column),
    /// How a column moves.
    Motion(column::Motion),
    /// A block that is pushed, under several friction models.
    Friction(friction::PushedBlock),
    /// Its way over the floor.
    Slide(friction::Slide),
    /// A rod that slides, and what holds it.
    Rod(rod::Rod),
    /// How it goes on.
    Run(rod::Run),
    /// A problem that somebody brings, by any method.
    Solve(problem::Solve),
    /// The judge's word on an x.
    Judge(problem::Judge),
    /// The strongest proof.
    Prove(problem::Prove),
}

/// Answers a question: an object, which has the key `error` if the question makes no sense.
///
/// ```
/// let question = r#"{"ask": "trace", "solver": "pgs", "sweeps": 2,
///     "problem": {"A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, -1]}}"#;
/// let answer: serde_json::Value = serde_json::from_str(&lcplab_live::answer(question)).unwrap();
/// assert_eq!(answer["steps"][2]["x"], serde_json::json!([0.875, 0.9375]));
/// ```
pub fn answer(question: &str) -> String {
    let answered = match serde_json::from_str(question) {
        Ok(Question::Trace(question)) => question.answer(),
        Ok(Question::Solutions(question)) => question.answer(),
        Ok(Question::Column(column)) => column.answer(),
        Ok(Question::Motion(motion)) => motion.answer(),
        Ok(Question::Friction(push)) => push.answer(),
        Ok(Question::Slide(slide)) => slide.answer(),
        Ok(Question::Rod(rod)) => rod.answer(),
        Ok(Question::Run(run)) => run.answer(),
        Ok(Question::Solve(question)) => question.answer(),
        Ok(Question::Judge(question)) => question.answer(),
        Ok(Question::Prove(question)) => question.answer(),
        Err(cause) => Err(cause.to_string()),
    };
    answered.unwrap_or_else(|reason| json!({ "error": reason })).to_string()
}

/// What came of a question.
type Answer = Result<Value, String>;
