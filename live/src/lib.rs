//! Answers the questions of the live pages, as JSON in and out, with the solvers and the judge of
//! lcplab.
//!
//! A page sends a question as text and gets the answer as text, natively by [`answer`], in a
//! browser through the three functions of [`abi`]. All bits of the numbers are preserved.

#![deny(missing_docs)]

pub mod abi;
mod column;
mod enclosure;
mod friction;
mod problem;
mod rod;
mod solutions;
mod trace;

use serde::Deserialize;
use serde_json::{Value, json};

/// A question of a page.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
enum Question {
    /// The steps of a solver on a problem.
    Trace(trace::Question),
    /// All solutions of a small problem.
    Solutions(solutions::Question),
    /// The problem of a column of bodies.
    Column(column::Column),
    /// The motion of a column.
    Motion(column::Motion),
    /// A block that is pushed, under several friction models.
    Friction(friction::PushedBlock),
    /// Its path over the floor.
    Slide(friction::Slide),
    /// A box around the impulses of a contact, and its images.
    Enclose(enclosure::Enclose),
    /// The forces on a rod that slides.
    Rod(rod::Rod),
    /// Its further motion.
    Run(rod::Run),
    /// A problem of the user, by any method.
    Solve(problem::Solve),
    /// The judge's verdict on an x.
    Judge(problem::Judge),
    /// The strongest proof.
    Prove(problem::Prove),
}

/// Answers a question with an object, which has the key `error` if the question is invalid.
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
        Ok(Question::Enclose(question)) => question.answer(),
        Ok(Question::Rod(rod)) => rod.answer(),
        Ok(Question::Run(run)) => run.answer(),
        Ok(Question::Solve(question)) => question.answer(),
        Ok(Question::Judge(question)) => question.answer(),
        Ok(Question::Prove(question)) => question.answer(),
        Err(cause) => Err(cause.to_string()),
    };
    answered.unwrap_or_else(|reason| json!({ "error": reason })).to_string()
}

/// The answer to a question, or its error.
type Answer = Result<Value, String>;
