//! Problem sets: questions with a numerical answer.
//!
//! Each lesson has a file `notebooks/problems/NN.toml`. A problem contains the question in
//! Markdown, the answer and its tolerance, and the answers that result from typical mistakes, each
//! with a hint. Its numbers may differ from student to student ([`super::template`]).

use std::collections::BTreeMap;

use serde::Deserialize;

use super::Program;
use super::template::Template;
use crate::error::{Error, Result};
use crate::number::readable;

/// A question with its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Lesson and number: `4.p1`.
    pub id: String,
    /// How it is solved.
    pub kind: Kind,
    /// What it is about, in a few words.
    pub title: String,
    /// The expected time in minutes.
    pub minutes: u32,
    /// 1 easy, 2 medium, 3 hard.
    pub level: u8,
    /// The numbers that may differ from student to student, by name.
    pub parameters: BTreeMap<String, f64>,
    /// The question, in Markdown.
    pub text: String,
    /// The unit of the answer; empty without one.
    pub unit: String,
    /// The answer.
    pub answer: f64,
    /// The relative tolerance; for an answer 0, the absolute tolerance.
    pub within: f64,
    /// Other correct answers, by another convention or a sharper argument.
    pub also: Vec<Also>,
    /// The results of typical mistakes.
    pub traps: Vec<Trap>,
    /// The derivation of the answer, in Markdown.
    pub because: String,
}

/// How a problem is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// With pencil and paper.
    Pencil,
    /// Predicted first, then run.
    Predict,
    /// On a live page.
    Live,
}

/// Another correct answer, and why it is correct.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Also<Number = f64> {
    /// The number.
    pub answer: Number,
    /// How it differs from the expected one.
    pub remark: String,
}

/// A wrong answer with a hint.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trap<Number = f64> {
    /// The number.
    pub answer: Number,
    /// A hint that does not give the answer away.
    pub hint: String,
}

/// The reply to a number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reply {
    /// It is right.
    Right,
    /// It is also right; the text says how it differs from the expected answer.
    AlsoRight(String),
    /// It is wrong; the text is a hint.
    Wrong(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Set {
    problem: Vec<Template>,
}

/// The problems of a lesson.
///
/// # Errors
/// If its file cannot be read.
pub fn set(lesson: &Program) -> Result<Vec<Template>> {
    let set: Set = toml::from_str(lesson.problems)
        .map_err(|cause| Error::invalid(lesson.name, "problem set", cause.to_string()))?;
    Ok(set.problem)
}

/// A number as students type or copy it: `0.2`, `1/5`, `−3`, `5e-5`, `5×10⁻⁵`.
///
/// # Errors
/// If the text is anything else, with what to write instead.
///
/// ```
/// use lcplab::lesson::problem::typed;
/// assert_eq!(typed("9/4"), Ok(2.25));
/// assert_eq!(typed("−5×10⁻⁵"), Ok(-5e-5));
/// let reason = typed("0.57 N s").unwrap_err();
/// assert!(reason.contains("without a unit"));
/// ```
pub fn typed(text: &str) -> std::result::Result<f64, String> {
    let plain: String = text.trim().replace("×10", "e").chars().map(ascii).collect();
    let number = match plain.split_once('/') {
        Some((above, below)) => number(above).zip(number(below)).map(|(a, b)| a / b),
        None => number(&plain),
    };
    number.filter(|number| number.is_finite()).ok_or_else(|| {
        let hint = match plain.contains(',') {
            true => "with a decimal point, as in 0.57",
            false => "the number alone, without a unit, as in 0.57, 5e-5 or 1/5",
        };
        format!("{text:?} is not a number: write {hint}")
    })
}

fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok()
}

/// The ASCII character for a minus sign or a raised digit.
fn ascii(c: char) -> char {
    let raised = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().zip('0'..='9').find(|(raised, _)| *raised == c);
    match c {
        '−' | '⁻' => '-',
        c => raised.map_or(c, |(_, digit)| digit),
    }
}

impl Problem {
    /// The reply to a number.
    pub fn reply(&self, number: f64) -> Reply {
        if self.is_near(number, self.answer) {
            return Reply::Right;
        }
        if let Some(also) = self.also.iter().find(|also| self.is_near(number, also.answer)) {
            return Reply::AlsoRight(also.remark.clone());
        }
        let off = |trap: &&Trap| (number - trap.answer).abs();
        let near = self.traps.iter().filter(|trap| self.is_near(number, trap.answer));
        if let Some(trap) = near.min_by(|a, b| off(a).total_cmp(&off(b))) {
            return Reply::Wrong(trap.hint.clone());
        }
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let reason = match number {
            number if !number.is_finite() => "enter a finite number".to_string(),
            number if self.answer != 0.0 && self.is_near(-number, self.answer) => {
                "the magnitude is right, the sign is not".to_string()
            }
            // A direction would turn a prediction into a search by bisection.
            number if self.kind != Kind::Pencil => {
                format!("{}{unit} is not the right number", readable(number, 4))
            }
            number if number > self.answer => format!("{}{unit} is too much", readable(number, 4)),
            number => format!("{}{unit} is too little", readable(number, 4)),
        };
        Reply::Wrong(reason)
    }

    pub(super) fn is_near(&self, number: f64, target: f64) -> bool {
        let size = if target == 0.0 { 1.0 } else { target.abs() };
        (number - target).abs() <= self.within * size
    }
}

impl Kind {
    fn words(self) -> &'static str {
        match self {
            Kind::Pencil => "pencil and paper",
            Kind::Predict => "predict, then run",
            Kind::Live => "on a live page",
        }
    }
}

/// All problems of a set, as a lesson shows them.
pub(super) fn markdown(problems: &[Problem]) -> String {
    let one = |problem: &Problem| {
        let Problem { id, kind, title, minutes, level, text, .. } = problem;
        let level = ["easy", "middle", "hard"][usize::from(*level).clamp(1, 3) - 1];
        let (kind, text) = (kind.words(), text.trim());
        format!(
            "**{id} {title}** ({kind}, {minutes} minutes, {level}). {text}\n\n\
             `lcplab exercise {id} NUMBER`\n"
        )
    };
    problems.iter().map(one).collect::<Vec<_>>().join("\n")
}
