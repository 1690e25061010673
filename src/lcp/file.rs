//! Problem files: an LCP as JSON.
//!
//! ```json
//! {"name": "two contacts",
//!  "A": {"dense": [[2, -1], [-1, 2]]},
//!  "b": [-1, 2], "lo": [0, 0], "hi": ["inf", "inf"]}
//! ```
//!
//! | key | meaning |
//! | --- | --- |
//! | `A` | `{"dense": [[…], …]}` or `{"rows": n, "cols": n, "triplets": [[i, j, value], …]}`; indices from 0, triplets at the same place add up |
//! | `b` | n numbers |
//! | `lo`, `hi` | n numbers or `"inf"`, `"-inf"`; 0 and ∞ where the key is absent |
//! | `friction_index`, `mu` | row i is bounded by ±mu\[i\]·max(x\[k\], 0) with k = friction_index\[i\]; −1 for none. Its lo and hi are absent or infinite |
//! | `model` | under which model of friction x is a solution, such as `"coulomb-cone"`: see [`friction`](super::friction); `"coupled-box"` where the key is absent |
//! | `frozen_at` | n numbers, of which the box of model 1, `"frozen-box"`, takes the normal impulses x\[k\] |
//! | `name`, `source`, `dt`, `rows`, `expected` | optional, kept as they are |
//!
//! A *friction problem* is a file with friction rows in pairs: the tangents t1, t2 of a contact have the
//! same μ and are bounded by the same row n. The exported steps of scenes are such files. A unit mass
//! on the floor, pressed with 2 N s and pushed with 3 N s, under Coulomb's law:
//!
//! ```json
//! {"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, 0],
//!  "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5], "model": "coulomb-cone"}
//! ```
//!
//! Other keys are ignored with a warning. Memory is bounded by the size of the file: n is checked
//! against the length of b before anything of that size is made.

use std::io::Read;
use std::path::Path;

use serde_json::{Map, Value, json};

use super::friction::{FrictionProblem, Model};
use super::{Coupling, Lcp, Matrix};
use crate::error::{Defects, Error, Result};

/// A problem as it stands in a file.
#[derive(Debug, Clone)]
pub struct Problem {
    /// What it is called; empty without a name.
    pub name: String,
    /// The numbers.
    pub lcp: Lcp,
    /// Under which model of friction it is to be solved, if the file says so.
    pub model: Option<Model>,
    /// The x at which model 1 freezes its boxes, n entries.
    pub frozen_at: Option<Vec<f64>>,
    /// Keys that are kept but not interpreted: `source`, `dt`, `rows`, `expected`.
    pub extra: Map<String, Value>,
    /// What was ignored while reading.
    pub warnings: Vec<String>,
}

const KEPT: [&str; 4] = ["source", "dt", "rows", "expected"];
const READ: [&str; 9] =
    ["name", "A", "b", "lo", "hi", "friction_index", "mu", "model", "frozen_at"];

impl Problem {
    /// A problem with a name and nothing else.
    pub fn new(name: impl Into<String>, lcp: Lcp) -> Self {
        let (extra, warnings) = (Map::new(), Vec::new());
        Problem { name: name.into(), lcp, model: None, frozen_at: None, extra, warnings }
    }

    /// The contacts with friction, if there are any friction rows.
    ///
    /// # Errors
    /// If the friction rows are not the two tangents of contacts each.
    pub fn friction(&self) -> Option<Result<FrictionProblem>> {
        let coupling = self.lcp.coupling()?;
        (!coupling.is_empty()).then(|| FrictionProblem::of(&self.lcp))
    }

    /// Reads a file, or standard input for the path `-`.
    ///
    /// # Errors
    /// If the file cannot be read, is not JSON, or has defects; all of them are listed.
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&read_text(path)?, &path.display().to_string())
    }

    /// Reads a problem from the text of a file called `input`.
    ///
    /// ```
    /// use lcplab::lcp::file::Problem;
    ///
    /// let text = r#"{"A": {"rows": 1, "cols": 1, "triplets": [[0, 0, 2]]}, "b": [-1]}"#;
    /// let problem = Problem::parse(text, "one.json")?;
    /// assert_eq!(problem.lcp.w(&[0.5]), [0.0]);
    /// # Ok::<(), lcplab::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the text is not JSON or has defects; all of them are listed.
    pub fn parse(text: &str, input: &str) -> Result<Self> {
        let object = parse_object(text, input)?;
        let mut defects = Defects::default();
        for key in ["A", "b"].into_iter().filter(|key| !object.contains_key(*key)) {
            defects.add(key, "is missing");
        }
        defects.result(input)?; // without both there are no sizes to check by
        let parts = Parts::read(&object, &mut defects);
        let model = model(&object, &mut defects);
        let frozen_at = frozen_at(&object, parts.b.len(), &mut defects);
        defects.into_result(input)?;
        let lcp = parts.into_lcp().map_err(|error| error.within(input))?;
        let (mut extra, mut warnings) = (Map::new(), Vec::new());
        for (key, value) in &object {
            if KEPT.contains(&key.as_str()) {
                extra.insert(key.clone(), value.clone());
            } else if !READ.contains(&key.as_str()) {
                warnings.push(format!("{input}: unknown key {key:?} ignored"));
            }
        }
        let name = object.get("name").and_then(Value::as_str).unwrap_or_default().to_string();
        Ok(Problem { name, lcp, model, frozen_at, extra, warnings })
    }

    /// The problem as JSON, sparse if its matrix is stored sparsely. Reading it back gives the same
    /// bits.
    pub fn to_json(&self) -> Value {
        let lcp = &self.lcp;
        let n = lcp.len();
        let row = |i| lcp.matrix().row(i).iter();
        let matrix = match lcp.matrix() {
            Matrix::Dense(_) => {
                let dense: Vec<Vec<f64>> =
                    (0..n).map(|i| row(i).map(|(_, a)| a).collect()).collect();
                json!({ "dense": dense })
            }
            Matrix::Sparse(_) => {
                let triplets: Vec<Value> =
                    (0..n).flat_map(|i| row(i).map(move |(j, a)| json!([i, j, a]))).collect();
                json!({ "rows": n, "cols": n, "triplets": triplets })
            }
        };
        let mut object = Map::new();
        object.insert("name".into(), json!(self.name));
        object.insert("A".into(), matrix);
        object.insert("b".into(), json!(lcp.b()));
        object.insert("lo".into(), lcp.lo().iter().map(|&v| number(v)).collect());
        object.insert("hi".into(), lcp.hi().iter().map(|&v| number(v)).collect());
        if let Some(coupling) = lcp.coupling() {
            let index = |i| coupling.index(i).map_or(json!(-1), |k| json!(k));
            object.insert("friction_index".into(), (0..n).map(index).collect());
            object.insert("mu".into(), (0..n).map(|i| json!(coupling.mu(i))).collect());
        }
        if let Some(model) = self.model {
            object.insert("model".into(), json!(model.to_string()));
        }
        if let Some(x) = &self.frozen_at {
            object.insert("frozen_at".into(), json!(x));
        }
        object.extend(self.extra.clone());
        Value::Object(object)
    }
}

/// The vector under the key `x` of an answer file, any JSON object that has one.
///
/// # Errors
/// If the file cannot be read or has no such vector of `n` numbers.
pub fn read_answer(path: &Path, n: usize) -> Result<Vec<f64>> {
    let input = path.display().to_string();
    let object = parse_object(&read_text(path)?, &input)?;
    let mut defects = Defects::default();
    let x = numbers(&object, "x", &mut defects).unwrap_or_default();
    if defects.is_empty() && !object.contains_key("x") {
        defects.add("x", "is missing");
    } else if defects.is_empty() && x.len() != n {
        defects.add("x", format!("has {} entries, the problem has {n} rows", x.len()));
    }
    defects.into_result(input)?;
    Ok(x)
}

/// A number as JSON: infinities and NaN become the words "inf", "-inf" and "nan".
pub fn number(value: f64) -> Value {
    if value.is_finite() {
        json!(value)
    } else if value.is_nan() {
        json!("nan")
    } else {
        json!(if value > 0.0 { "inf" } else { "-inf" })
    }
}

fn read_text(path: &Path) -> Result<String> {
    let mut text = String::new();
    let read = if path == Path::new("-") {
        std::io::stdin().read_to_string(&mut text).map(|_| ())
    } else {
        std::fs::read_to_string(path).map(|file| text = file)
    };
    read.map_err(|cause| Error::file(path, &cause))?;
    Ok(text)
}

fn parse_object(text: &str, input: &str) -> Result<Map<String, Value>> {
    match serde_json::from_str(text) {
        Ok(Value::Object(object)) => Ok(object),
        Ok(_) => Err(Error::invalid(input, "file", "must be a JSON object")),
        Err(cause) => {
            let place = format!("line {}, column {}", cause.line(), cause.column());
            Err(Error::invalid(input, place, format!("not valid JSON: {cause}")))
        }
    }
}

/// The keys of a problem file, each well-formed in itself.
struct Parts {
    entries: Entries,
    b: Vec<f64>,
    lo: Option<Vec<f64>>,
    hi: Option<Vec<f64>>,
    index: Option<Vec<Option<usize>>>,
    mu: Option<Vec<f64>>,
}

enum Entries {
    Dense(Vec<f64>),
    Sparse(Vec<(usize, usize, f64)>),
}

impl Parts {
    fn read(object: &Map<String, Value>, defects: &mut Defects) -> Self {
        let b = numbers(object, "b", defects).unwrap_or_default();
        let entries = match &object["A"] {
            Value::Object(a) if a.contains_key("dense") => {
                Entries::Dense(dense(&a["dense"], b.len(), defects))
            }
            Value::Object(a) if a.contains_key("triplets") => {
                Entries::Sparse(triplets(a, b.len(), defects))
            }
            _ => {
                defects.add("A", "must be an object with \"dense\" or \"triplets\"");
                Entries::Dense(Vec::new())
            }
        };
        Parts {
            entries,
            lo: numbers(object, "lo", defects),
            hi: numbers(object, "hi", defects),
            index: object.get("friction_index").map(|value| indices(value, defects)),
            mu: numbers(object, "mu", defects),
            b,
        }
    }

    fn into_lcp(self) -> Result<Lcp> {
        let n = self.b.len();
        let matrix = match self.entries {
            Entries::Dense(entries) => Matrix::dense(n, &entries),
            Entries::Sparse(entries) => Matrix::sparse(n, &entries),
        };
        let coupled = |i: usize| {
            self.index.as_ref().is_some_and(|index| matches!(index.get(i), Some(Some(_))))
        };
        let lo = self.lo.unwrap_or_else(|| {
            (0..n).map(|i| if coupled(i) { f64::NEG_INFINITY } else { 0.0 }).collect()
        });
        let hi = self.hi.unwrap_or_else(|| vec![f64::INFINITY; n]);
        let lcp = Lcp::new(matrix, self.b, lo, hi)?;
        match (self.index, self.mu) {
            (None, None) => Ok(lcp),
            (Some(index), Some(mu)) => lcp.with_coupling(Coupling::new(index, mu)?),
            (Some(_), None) => Err(Error::invalid("problem", "mu", "is missing")),
            (None, Some(_)) => Err(Error::invalid("problem", "friction_index", "is missing")),
        }
    }
}

/// The number that a JSON value stands for: a number, or one of the words "inf", "-inf" and "nan".
pub fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => number.as_f64(),
        Value::String(word) => match word.as_str() {
            "inf" | "+inf" => Some(f64::INFINITY),
            "-inf" => Some(f64::NEG_INFINITY),
            "nan" => Some(f64::NAN),
            _ => None,
        },
        _ => None,
    }
}

fn numbers(object: &Map<String, Value>, key: &str, defects: &mut Defects) -> Option<Vec<f64>> {
    let Value::Array(values) = object.get(key)? else {
        defects.add(key, "must be a list of numbers");
        return None;
    };
    let number = |(i, value): (usize, &Value)| {
        as_number(value).unwrap_or_else(|| {
            defects.add(format!("{key}[{i}]"), format!("must be a number, is {}", brief(value)));
            0.0
        })
    };
    Some(values.iter().enumerate().map(number).collect())
}

/// The model of friction under the key `model`.
fn model(object: &Map<String, Value>, defects: &mut Defects) -> Option<Model> {
    let value = object.get("model")?;
    let model = value.as_str().map(str::parse::<Model>);
    match model {
        Some(Ok(model)) if object.contains_key("friction_index") => return Some(model),
        Some(Ok(_)) => defects.add("model", "is given, but there is no friction_index"),
        Some(Err(error)) => defects.add("model", error.to_string()),
        None => defects.add("model", format!("must be a name, is {}", brief(value))),
    }
    None
}

fn frozen_at(object: &Map<String, Value>, n: usize, defects: &mut Defects) -> Option<Vec<f64>> {
    let x = numbers(object, "frozen_at", defects)?;
    if x.len() != n {
        defects.add("frozen_at", format!("has {} entries, b has {n}", x.len()));
    }
    for (i, x) in x.iter().enumerate().filter(|(_, x)| !x.is_finite()) {
        defects.add(format!("frozen_at[{i}]"), format!("must be finite, is {x}"));
    }
    Some(x)
}

fn dense(value: &Value, n: usize, defects: &mut Defects) -> Vec<f64> {
    let Value::Array(rows) = value else {
        defects.add("A.dense", "must be a list of rows");
        return Vec::new();
    };
    if rows.len() != n {
        defects.add("A.dense", format!("has {} rows, b has {n}", rows.len()));
    }
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let Value::Array(row) = row else {
            defects.add(format!("A.dense[{i}]"), "must be a list of numbers");
            continue;
        };
        if row.len() != n {
            defects.add(format!("A.dense[{i}]"), format!("has {} entries, b has {n}", row.len()));
        }
        for (j, value) in row.iter().enumerate() {
            entries.push(as_number(value).unwrap_or_else(|| {
                let reason = format!("must be a number, is {}", brief(value));
                defects.add(format!("A.dense[{i}][{j}]"), reason);
                0.0
            }));
        }
    }
    entries
}

fn triplets(a: &Map<String, Value>, n: usize, defects: &mut Defects) -> Vec<(usize, usize, f64)> {
    for key in ["rows", "cols"] {
        match a.get(key).map(|value| (value, value.as_u64())) {
            None => defects.add(format!("A.{key}"), "is missing"),
            Some((_, Some(count))) if count == n as u64 => {}
            Some((value, _)) => {
                defects.add(format!("A.{key}"), format!("is {}, b has {n} rows", brief(value)));
            }
        }
    }
    let Value::Array(list) = &a["triplets"] else {
        defects.add("A.triplets", "must be a list of [row, column, value]");
        return Vec::new();
    };
    let mut entries = Vec::new();
    for (k, triplet) in list.iter().enumerate() {
        let place = || format!("A.triplets[{k}]");
        let parts = triplet.as_array().map(Vec::as_slice);
        let Some([i, j, value]) = parts else {
            defects.add(place(), "must be [row, column, value]");
            continue;
        };
        let index = |value: &Value| value.as_u64().filter(|&i| i < n as u64).map(|i| i as usize);
        match (index(i), index(j), as_number(value)) {
            (Some(i), Some(j), Some(value)) => entries.push((i, j, value)),
            (_, _, None) => {
                defects.add(place(), format!("value must be a number, is {}", brief(value)));
            }
            _ => {
                let reason =
                    format!("row {} and column {} must be indices below {n}", brief(i), brief(j));
                defects.add(place(), reason);
            }
        }
    }
    entries
}

fn indices(value: &Value, defects: &mut Defects) -> Vec<Option<usize>> {
    let Value::Array(values) = value else {
        defects.add("friction_index", "must be a list of row indices, -1 for none");
        return Vec::new();
    };
    let index = |(i, value): (usize, &Value)| match value.as_i64() {
        Some(-1) => None,
        Some(k) if k >= 0 => Some(k as usize),
        _ => {
            let reason = format!("must be a row index or -1, is {}", brief(value));
            defects.add(format!("friction_index[{i}]"), reason);
            None
        }
    };
    values.iter().enumerate().map(index).collect()
}

/// A value for an error message, cut short.
fn brief(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() <= 40 {
        return text;
    }
    text.chars().take(37).chain("...".chars()).collect()
}
