//! The lines that go to and fro.

use std::time::Duration;

use serde_json::{Map, Value, json};

use lcplab_problem::file::{Problem, as_number};
use lcplab_problem::friction::{Law, Model};
use lcplab_problem::{Lcp, json as strict};
use lcplab_solver::{Settings, Start, Status};

/// Up to so many rows A is written row by row; above, its entries other than 0.
const DENSE_ROWS: usize = 1000;
/// A number takes at most so many characters, with what is beside it.
const NUMBER: usize = 32;
/// So many iterates may be told at most.
const ITERATES: usize = 10_000;
/// A line may be this long (bytes) whatever the problem.
const SHORT: usize = 1 << 16;
/// And never longer than this.
const LONG: usize = 1 << 30;

/// A problem file in one line, with what is demanded of an answer, and the plug-in's own settings.
/// The `model` says what `friction_index` and `mu` mean.
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

/// How long (bytes) an answer to a problem of n rows may be.
pub(super) fn longest(n: usize) -> usize {
    NUMBER.saturating_mul(n).saturating_mul(ITERATES).clamp(SHORT, LONG)
}

/// What a plug-in says.
#[derive(Debug)]
pub(super) struct Answer {
    /// `None` where it claims nothing and gives none.
    pub x: Option<Vec<f64>>,
    pub status: Status,
    /// Whether it gives x and no status.
    pub is_claim_implied: bool,
    pub iterates: Vec<Vec<f64>>,
    pub iterations: usize,
    /// The laws of friction cones that it says it takes.
    pub laws: Vec<Law>,
}

impl Answer {
    /// The answer in a line, for a problem of n rows.
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
            (true, Some(x)) => vec![x.clone()], // one step to the answer
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

/// The laws of the cones among these models of friction. A plug-in gets boxes whatever it says.
fn laws(models: &Value) -> Result<Vec<Law>, String> {
    let list = models.as_array().ok_or("\"models\" is not a list of strings")?;
    let mut laws = Vec::new();
    for word in list {
        let model = word.as_str().ok_or("\"models\" is not a list of strings")?;
        match model.parse().map_err(|error| format!("its \"models\": {error}"))? {
            Model::FrozenBox | Model::CoupledBox => {}
            Model::AssociatedCone => laws.push(Law::Associated),
            Model::CoulombCone => laws.push(Law::Coulomb),
            Model::Polyhedral { .. } => {
                return Err(format!(
                    "its \"models\" name {model}, but plug-ins are sent only boxes, associated-cone and \
                     coulomb-cone"
                ));
            }
        }
    }
    Ok(laws)
}

/// A number of iterations.
fn whole(value: &Value) -> Option<usize> {
    const MOST: f64 = 9_007_199_254_740_992.0; // 2⁵³
    let count = as_number(value)?;
    (count.fract() == 0.0 && (0.0..=MOST).contains(&count)).then_some(count as usize)
}

/// n finite numbers.
fn numbers(value: &Value, what: &str, n: usize) -> Result<Vec<f64>, String> {
    let list = value.as_array().ok_or(format!("{what} is not a list of numbers"))?;
    if list.len() != n {
        return Err(format!("{what} has {} entries, the problem has {n} rows", list.len()));
    }
    let number = |(i, value): (usize, &Value)| {
        as_number(value).filter(|number| number.is_finite()).ok_or_else(|| {
            format!("{what}[{i}] is {}, not a finite number", brief(&value.to_string()))
        })
    };
    list.iter().enumerate().map(number).collect()
}

/// The beginning of a text in one line, without controls.
pub(super) fn brief(text: &str) -> String {
    const SHOWN: usize = 80;
    let shown: String =
        text.chars().take(SHOWN).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if text.chars().nth(SHOWN).is_some() { shown + "…" } else { shown }
}
