//! The messages of the plug-in protocol: requests and answers.

use std::time::Duration;

use serde_json::{Map, Value, json};

use lcplab_lcp::file::{Problem, as_number};
use lcplab_lcp::friction::{Form, Law, Model};
use lcplab_lcp::{Lcp, json as strict};
use lcplab_solver::{Settings, Start, Status};

/// Up to this number of rows A is written row by row; above, as a list of its nonzero entries.
const DENSE_ROWS: usize = 1000;
/// Upper bound on the characters of a number, including separators.
const NUMBER: usize = 32;
/// Limit on the number of iterates in an answer.
const ITERATES: usize = 10_000;
/// A line of this length (bytes) is always allowed.
const SHORT: usize = 1 << 16;
/// Limit on the length of any line (bytes).
const LONG: usize = 1 << 30;

/// The request: a problem file in one line, with the requirements on the answer and the plug-in's
/// settings. The `model` gives the meaning of `friction_index` and `mu`.
pub(super) fn request(
    lcp: &Lcp,
    model: Option<Model>,
    start: &Start<'_>,
    settings: &Settings,
    own: &Map<String, Value>,
    time_limit: Duration,
) -> String {
    let problem = Problem { model, ..Problem::new("", lcp.clone()) };
    let mut object = match problem.to_json() {
        Value::Object(object) => object,
        _ => Map::new(),
    };
    object.shift_remove("name");
    if lcp.len() <= DENSE_ROWS {
        let n = lcp.len();
        let row = |i| (0..n).map(|j| lcp.matrix().entry(i, j)).collect::<Vec<f64>>();
        object["A"] = json!({ "dense": (0..n).map(row).collect::<Vec<_>>() });
    }
    object.insert("tolerance".into(), json!(settings.tolerance));
    object.insert("max_iterations".into(), json!(settings.max_iterations));
    object.insert("time_limit".into(), json!(time_limit.as_secs_f64()));
    if !own.is_empty() {
        object.insert("settings".into(), Value::Object(own.clone()));
    }
    if let Some(x) = start.x {
        object.insert("start".into(), json!(x));
    }
    Value::Object(object).to_string() + "\n"
}

/// Limit on the length (bytes) of an answer to a problem of n rows.
pub(super) fn longest(n: usize) -> usize {
    NUMBER.saturating_mul(n).saturating_mul(ITERATES).clamp(SHORT, LONG)
}

/// A plug-in's answer.
#[derive(Debug)]
pub(super) struct Answer {
    /// `None` if the plug-in gives no answer.
    pub x: Option<Vec<f64>>,
    pub status: Status,
    /// Whether the answer has x but no status.
    pub is_claim_implied: bool,
    pub iterates: Vec<Vec<f64>>,
    pub iterations: usize,
    /// The friction cone laws that the plug-in says it supports.
    pub laws: Vec<Law>,
}

impl Answer {
    /// Parses the answer in a line, for a problem of n rows.
    pub fn read(line: &[u8], n: usize) -> Result<Answer, String> {
        let text = str::from_utf8(line).map_err(|_| "its answer is not UTF-8")?;
        let object = match strict::parse(text) {
            Ok(Value::Object(object)) => object,
            Ok(_) => return Err(format!("its answer is not a JSON object: {}", brief(text))),
            Err(cause) => return Err(format!("its answer is not JSON ({cause}): {}", brief(text))),
        };
        let x = object.get("x").map(|x| numbers(x, "x", n)).transpose()?;
        let stated = object.get("status").filter(|status| !status.is_null());
        let word = match stated {
            None => "solved",
            Some(Value::String(word)) => word,
            Some(other) => {
                return Err(format!("its status is not a string: {}", brief(&other.to_string())));
            }
        };
        let status = match word {
            "solved" if x.is_none() => return Err("its answer has no \"x\"".into()),
            "iteration_limit" if x.is_none() => {
                Status::NoAnswer { reason: "it reached its iteration limit and gives no x".into() }
            }
            "solved" => Status::Solved,
            "iteration_limit" => Status::IterationLimit,
            "outside_class" => {
                Status::OutsideClass { reason: "the plug-in does not support this problem" }
            }
            "infeasible" => {
                let vector = object.get("vector").ok_or("\"infeasible\" needs a \"vector\"")?;
                let direction = numbers(vector, "vector", n)?;
                let size = |i: &usize| direction[*i].abs();
                let row = (0..n).max_by(|i, j| size(i).total_cmp(&size(j))).unwrap_or(0);
                Status::Ray { row, direction }
            }
            other => Status::NoAnswer { reason: format!("it says {:?}", brief(other)) },
        };
        let iterates = match object.get("iterates") {
            None | Some(Value::Null) => Vec::new(),
            Some(Value::Array(list)) if list.len() <= ITERATES => {
                list.iter().map(|x| numbers(x, "an iterate", n)).collect::<Result<_, _>>()?
            }
            Some(_) => return Err(format!("its iterates are not a list of at most {ITERATES}")),
        };
        let iterates = match (iterates.is_empty(), &x) {
            // A single iterate: the answer.
            (true, Some(x)) => vec![x.clone()],
            _ => iterates,
        };
        let iterations = match object.get("iterations") {
            None | Some(Value::Null) => iterates.len(),
            Some(count) => whole(count).ok_or_else(|| {
                let shown = brief(&count.to_string());
                format!("its iterations are {shown}, not an integer of at most 2⁵³")
            })?,
        };
        let laws = object.get("models").map_or(Ok(Vec::new()), laws)?;
        let is_claim_implied = stated.is_none();
        Ok(Answer { x, status, is_claim_implied, iterates, iterations, laws })
    }
}

/// The cone laws among these friction models. A plug-in receives boxes whatever it lists.
fn laws(models: &Value) -> Result<Vec<Law>, String> {
    let list = models.as_array().ok_or("\"models\" is not a list of strings")?;
    let mut laws = Vec::new();
    for word in list {
        let model = word.as_str().ok_or("\"models\" is not a list of strings")?;
        let model: Model = model.parse().map_err(|error| format!("its \"models\": {error}"))?;
        match model.form() {
            Form::Box => {}
            Form::Cone(law) => laws.push(law),
            Form::Polygon { .. } => {
                return Err(format!(
                    "its \"models\" name {model}, but plug-ins are sent only boxes, associated-cone and \
                     coulomb-cone"
                ));
            }
        }
    }
    Ok(laws)
}

/// A nonnegative integer: a number of iterations.
fn whole(value: &Value) -> Option<usize> {
    // 2⁵³
    const MOST: f64 = 9_007_199_254_740_992.0;
    let count = as_number(value)?;
    (count.fract() == 0.0 && (0.0..=MOST).contains(&count)).then_some(count as usize)
}

/// n finite numbers.
fn numbers(value: &Value, what: &str, n: usize) -> Result<Vec<f64>, String> {
    let list = value.as_array().ok_or(format!("{what} is not a list of numbers"))?;
    if list.len() != n {
        return Err(format!("{what} has length {}, the problem has {n} rows", list.len()));
    }
    let number = |(i, value): (usize, &Value)| {
        as_number(value).filter(|number| number.is_finite()).ok_or_else(|| {
            format!("{what}[{i}] is {}, not a finite number", brief(&value.to_string()))
        })
    };
    list.iter().enumerate().map(number).collect()
}

/// Maximum number of characters of a text that a message quotes.
const SHOWN: usize = 80;

/// The start of a text in one line, without control characters.
pub(super) fn brief(text: &str) -> String {
    let shown = on_one_line(text.chars().take(SHOWN));
    if text.chars().nth(SHOWN).is_some() { shown + "…" } else { shown }
}

/// The same for the end of a text, which says what was wrong.
pub(super) fn brief_end(text: &str) -> String {
    const END: usize = 300;
    let surplus = text.chars().count().saturating_sub(END);
    let shown = on_one_line(text.chars().skip(surplus));
    if surplus > 0 { format!("…{shown}") } else { shown }
}

fn on_one_line(text: impl Iterator<Item = char>) -> String {
    text.map(|c| if c.is_control() { ' ' } else { c }).collect()
}
