//! Problems with parameters: their numbers are formulas, so that each student can have different
//! ones.
//!
//! A problem's file lists the values of each parameter; the first of each list is the one that the
//! lesson prints. Everything else follows by formulas, which lcplab reads with the crate `exmex`
//! (`+ - * / ^`, `sqrt`, `sin`, `ceil`, `min(a, b)`, `PI` …; a sign binds before a power, so write
//! `0 - v^2`):
//!
//! ```toml
//! parameters.m = [2, 1, 3, 4]
//! parameters.v = [0.5, 0.2, 0.4, 0.8]
//! values.x = "m*v"              # in the order of the file
//! positive = ["x - 0.1"]        # what the text assumes; other combinations are not used
//! text = "A ball of {{m}} kg comes down at {{v}} m/s. Which impulse stops it, in N s?"
//! answer = "x"
//! ```
//!
//! A text contains a formula as `{{v}}`, `{{v/3:2}}` with two significant digits, or `{{v/3:/}}` as
//! a fraction.

use std::collections::BTreeMap;

use serde::Deserialize;
use sha2::{Digest, Sha256};

use super::problem::{Also, Kind, Problem, Trap};
use crate::error::{Error, Result};

/// Significant digits of a number in a text that does not state them.
const DIGITS: usize = 6;
/// Draws that may be tried until one is admissible.
const DRAWS: u32 = 10_000;
/// The largest denominator of a number that is written as a fraction.
const MAX_DENOMINATOR: u32 = 100;

/// A problem as its file states it.
///
/// ```
/// use lcplab::lesson::template::{Seed, Template};
///
/// let template: Template = toml::from_str(r#"
///     id = "1.p1"
///     kind = "pencil"
///     title = "A ball"
///     minutes = 3
///     level = 1
///     parameters.m = [2, 1, 3, 4]
///     text = "Which impulse stops a ball of {{m}} kg at 0.5 m/s?"
///     unit = "N s"
///     answer = "m*0.5"
///     within = 0.01
///     because = "{{m}} times 0.5 is {{m*0.5}} N s."
/// "#).unwrap();
/// assert_eq!(template.printed()?.answer, 1.0);
/// assert_ne!(template.drawn(&Seed { secret: "", student: "Ada" })?.answer, 1.0);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Template {
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
    /// The values of each parameter, the printed one first.
    #[serde(default)]
    pub parameters: BTreeMap<String, Vec<f64>>,
    /// Numbers that follow from the parameters, each a formula of those before it.
    #[serde(default)]
    values: toml::Table,
    /// Formulas that must be positive.
    #[serde(default)]
    positive: Vec<String>,
    text: String,
    unit: String,
    answer: Formula,
    within: f64,
    #[serde(default)]
    also: Vec<Also<Formula>>,
    #[serde(default)]
    traps: Vec<Trap<Formula>>,
    because: String,
}

/// A number, or the formula of one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
enum Formula {
    Number(f64),
    Text(String),
}

/// Selects the numbers of a student.
#[derive(Debug, Clone, Copy)]
pub struct Seed<'a> {
    /// Known to the lecturer alone; empty for numbers that every student can look up.
    pub secret: &'a str,
    /// The student's name. Spaces and capitals make no difference.
    pub student: &'a str,
}

/// The form of a name in which equal students are equal.
pub(crate) fn normal(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase()
}

impl Template {
    /// Whether students have different numbers.
    pub fn has_parameters(&self) -> bool {
        self.combinations() > 1
    }

    /// The number of combinations of parameters, admissible or not.
    pub fn combinations(&self) -> u64 {
        self.parameters.values().map(|list| list.len() as u64).product()
    }

    /// The problem with the numbers that the lesson prints.
    ///
    /// # Errors
    /// If a formula cannot be evaluated, or the printed parameters are not admissible.
    pub fn printed(&self) -> Result<Problem> {
        let error = || self.error("parameters", "the first of each list are not admissible");
        self.at(0)?.ok_or_else(error)
    }

    /// The problem with the numbers of a student. The printed answer is never theirs.
    ///
    /// # Errors
    /// If a formula cannot be evaluated, or no combination of parameters is admissible.
    pub fn drawn(&self, seed: &Seed) -> Result<Problem> {
        let printed = self.printed()?;
        if !self.has_parameters() {
            return Ok(printed);
        }
        for draw in 0..DRAWS {
            let index = self.hash(seed, draw) % self.combinations();
            match self.at(index)? {
                Some(problem) if !printed.is_near(problem.answer, printed.answer) => {
                    return Ok(problem);
                }
                _ => {}
            }
        }
        Err(self.error("parameters", "no combination of them is admissible"))
    }

    /// The problem with one combination of parameters, of which 0 is the printed one; `None` if it
    /// is not admissible.
    ///
    /// # Errors
    /// If a formula cannot be evaluated.
    pub fn at(&self, index: u64) -> Result<Option<Problem>> {
        let mut rest = index;
        let mut numbers = BTreeMap::new();
        for (name, list) in &self.parameters {
            if list.is_empty() {
                return Err(self.error(name, "needs at least one value"));
            }
            let at = usize::try_from(rest % list.len() as u64).unwrap_or(0);
            numbers.insert(name.clone(), list[at]);
            rest /= list.len() as u64;
        }
        let parameters = numbers.clone();
        for (name, formula) in &self.values {
            let formula = formula.as_str().ok_or_else(|| self.error(name, "must be a formula"))?;
            let value = evaluate(formula, &numbers).map_err(|why| self.error(name, &why))?;
            numbers.insert(name.clone(), value);
        }
        for formula in &self.positive {
            let value = evaluate(formula, &numbers).map_err(|why| self.error("positive", &why))?;
            if value <= 0.0 {
                return Ok(None);
            }
        }
        self.with(parameters, &numbers).map(Some).map_err(|why| self.error("formula", &why))
    }

    fn with(
        &self,
        parameters: BTreeMap<String, f64>,
        numbers: &BTreeMap<String, f64>,
    ) -> std::result::Result<Problem, String> {
        let number = |formula: &Formula| match formula {
            Formula::Number(number) => Ok(*number),
            Formula::Text(text) => evaluate(text, numbers),
        };
        let also = |also: &Also<Formula>| {
            let (answer, remark) = (number(&also.answer)?, filled(&also.remark, numbers)?);
            Ok(Also { answer, remark })
        };
        let trap = |trap: &Trap<Formula>| {
            let (answer, hint) = (number(&trap.answer)?, filled(&trap.hint, numbers)?);
            Ok(Trap { answer, hint })
        };
        Ok(Problem {
            id: self.id.clone(),
            kind: self.kind,
            title: self.title.clone(),
            minutes: self.minutes,
            level: self.level,
            parameters,
            text: filled(&self.text, numbers)?,
            unit: self.unit.clone(),
            answer: number(&self.answer)?,
            within: self.within,
            also: self.also.iter().map(also).collect::<std::result::Result<_, String>>()?,
            traps: self.traps.iter().map(trap).collect::<std::result::Result<_, String>>()?,
            because: filled(&self.because, numbers)?,
        })
    }

    /// A number that only those who know the secret can compute, the same on every machine.
    fn hash(&self, seed: &Seed, draw: u32) -> u64 {
        let student = normal(seed.student);
        let draw = draw.to_string();
        let mut hasher = Sha256::new();
        for part in ["lcplab", seed.secret, &student, &self.id, &draw] {
            hasher.update((part.len() as u64).to_be_bytes());
            hasher.update(part);
        }
        let hash = hasher.finalize();
        hash.iter().take(8).fold(0, |number, byte| (number << 8) | u64::from(*byte))
    }

    fn error(&self, place: &str, reason: &str) -> Error {
        Error::invalid(format!("problem {}", self.id), place, reason)
    }
}

/// The value of a formula.
fn evaluate(text: &str, numbers: &BTreeMap<String, f64>) -> std::result::Result<f64, String> {
    use exmex::Express;
    let wrong = |why: exmex::ExError| format!("{text:?}: {why}");
    let formula = exmex::parse::<f64>(text).map_err(wrong)?;
    let named = |name: &String| {
        let number = numbers.get(name).copied();
        number.ok_or_else(|| format!("{text:?}: {name:?} is neither a parameter nor a value"))
    };
    let values = formula.var_names().iter().map(named);
    let value =
        formula.eval(&values.collect::<std::result::Result<Vec<_>, _>>()?).map_err(wrong)?;
    if value.is_finite() { Ok(value) } else { Err(format!("{text:?} is not finite")) }
}

/// A text with the values of its formulas.
fn filled(text: &str, numbers: &BTreeMap<String, f64>) -> std::result::Result<String, String> {
    let mut out = String::new();
    let mut rest = text;
    while let Some(mut at) = rest.find("{{") {
        // The first of three braces is LaTeX.
        at += usize::from(rest[at + 1..].starts_with("{{"));
        out += &rest[..at];
        let unclosed = || format!("{:?} has no end", &rest[at..]);
        let (formula, after) = rest[at + 2..].split_once("}}").ok_or_else(unclosed)?;
        let (formula, form) = formula.split_once(':').unwrap_or((formula, ""));
        let value = evaluate(formula, numbers)?;
        out += &match form {
            "" => decimal(value, DIGITS),
            "/" => fraction(value),
            digits => {
                let count = digits.parse().map_err(|_| format!("{digits:?} is not a number"))?;
                decimal(value, count)
            }
        };
        rest = after;
    }
    Ok(out + rest)
}

/// The value with this number of significant digits, without trailing zeros.
pub(super) fn decimal(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{:.*e}", digits.max(1) - 1, value).parse().unwrap_or(value);
    format!("{}", rounded + 0.0) // no -0
}

/// The value as a fraction in LaTeX, if its denominator is small.
fn fraction(value: f64) -> String {
    let is_whole = |value: f64| (value - value.round()).abs() < 1e-9;
    let found = (1..=MAX_DENOMINATOR).find(|d| is_whole(value * f64::from(*d)));
    match found {
        None => decimal(value, 4),
        Some(1) => decimal(value.round(), DIGITS),
        Some(d) => {
            let sign = if value < 0.0 { "-" } else { "" };
            format!("{sign}\\tfrac{{{}}}{{{d}}}", (value.abs() * f64::from(d)).round())
        }
    }
}
