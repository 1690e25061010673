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
//! | `A` | `{"dense": [[…], …]}` or `{"rows": n, "cols": n, "triplets": [[i, j, value], …]}`; indices from 0, triplets at the same place add up exactly, rounded once |
//! | `b` | n numbers |
//! | `lo`, `hi` | n numbers or `"inf"`, `"-inf"`; 0 and ∞ where the key is absent |
//! | `friction_index`, `mu` | row i is bounded by ±mu\[i\]·max(x\[k\], 0) with k = friction_index\[i\]; −1 for none. Its lo and hi are absent or infinite |
//! | `model` | the friction model under which x is a solution, such as `"coulomb-cone"`: see [`friction`](super::friction); `"coupled-box"` if the key is absent. If each normal row bounds one friction row, contacts in the plane, Coulomb's cone and polygons are the coupled box, and the key is dropped |
//! | `frozen_at` | n numbers x; their normal impulses x\[k\] give the size of the boxes of model 1, `"frozen-box"` |
//! | `scale` | the smallest significant size of x: a row whose terms are below s_i times this is measured by s_i times this; see [`Lcp::with_scale`] |
//! | `motion` | the bodies and rows that A and b were made from, `{"mass": triplets of M's upper triangle (k × k), "jacobian": triplets of J (n × k), "bias": n numbers, "compliance": n numbers γ, "target": k numbers u*, "level": optionally "velocity" (m/s) or "acceleration" (m/s²), the meaning of u}`; see [`Gauss`] |
//! | `rows` | optional, one object for each row: its `label`, `kind`, `unit` and the names of its two `bodies` |
//! | `bodies`, `gravity` | optional, with `motion`: for each movable body its `name`, its `first` column of M and their `count`; the contribution of gravity to each velocity in `target` |
//! | `objective` | optional, `true` if the problem states the optimality conditions of min ½ xᵀA x + bᵀx over the box, or of a quadratic program with a row for each multiplier: lcplab then says so if an answer is no minimum |
//! | `name`, `source`, `dt`, `expected` | optional, kept as they are |
//! | `answer` | optional, kept: the answer of the engine that posed the problem, an object as in an answer file: `x`, and the engine's new `motion` |
//! | `hunt` | optional, kept: the result of a search for a wrong answer: the `solver`, its `x` and the `right_x` |
//!
//! A *friction problem* is a file whose friction rows come in pairs: the tangents t1, t2 of a
//! contact have the same μ and are bounded by the same row n. Exported steps of scenes are such
//! files. Example: a unit mass on the floor under a normal impulse of 2 N s and a tangential one of
//! 3 N s, with Coulomb's law:
//!
//! ```json
//! {"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, 0],
//!  "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5], "model": "coulomb-cone"}
//! ```
//!
//! With serde, an [`Lcp`] and a [`Problem`] are written and read as such objects.
//!
//! The crate `lcplab-files` reads and writes the files of other programs. Unknown keys are ignored
//! with a warning that suggests the most similar known key; in `A` they are an error, and so is a
//! duplicate key or a key that states rolling friction. Memory is bounded: n is compared with the
//! length of b before anything of size n is allocated, and a file that would exceed the limit
//! ([`Problem::read_within`]) is rejected before it is parsed.

mod expected;
mod matrix;
mod motion;
mod parts;
mod similar;
mod value;

pub use expected::Expected;
pub use matrix::Entries;
pub use parts::Parts;
pub use value::{as_number, number};

use std::path::Path;

use serde::de::{Deserialize, Deserializer, Error as _};
use serde::ser::{Serialize, Serializer};
use serde_json::{Map, Value, json};

use parts::{descriptions, frozen_at, model, scale};
use similar::similar;
use value::numbers;

use super::friction::{FrictionProblem, Model};
use super::{Gauss, Lcp, Matrix};
use crate::disk;
use crate::error::{Defects, Error, Result};
use crate::json;
use crate::memory::Memory;
use crate::question::is_box_in_plane;
use crate::rolling::rolling_friction;

/// A problem as stored in a file.
#[derive(Debug, Clone)]
pub struct Problem {
    /// Its name; empty without a name.
    pub name: String,
    /// A, b and the bounds.
    pub lcp: Lcp,
    /// The friction model under which to solve it, if the file states one.
    pub model: Option<Model>,
    /// The x at which model 1 freezes its boxes, n entries.
    pub frozen_at: Option<Vec<f64>>,
    /// The bodies and rows that A and b were made from, if the file has them; the bounds are those
    /// of the problem.
    pub motion: Option<Gauss>,
    /// Keys that are kept but not interpreted: `source`, `dt`, `rows`, `bodies`, `gravity`,
    /// `objective`, `expected`, `hunt`, `answer`.
    pub extra: Map<String, Value>,
    /// Warnings about ignored keys.
    pub warnings: Vec<String>,
}

/// The JSON schema of the format.
///
/// ```
/// let schema: serde_json::Value = serde_json::from_str(lcplab_lcp::file::SCHEMA).unwrap();
/// assert_eq!(schema["required"], serde_json::json!(["A", "b"]));
/// ```
pub const SCHEMA: &str = include_str!("schema.json");

const KEPT: [&str; 9] =
    ["source", "dt", "rows", "bodies", "gravity", "objective", "expected", "hunt", "answer"];
const READ: [&str; 11] =
    ["name", "A", "b", "lo", "hi", "friction_index", "mu", "model", "frozen_at", "scale", "motion"];

/// Whether a key of the object is read or kept.
fn is_known(key: &str) -> bool {
    KEPT.contains(&key) || READ.contains(&key)
}

impl Problem {
    /// A problem with a name and an LCP only.
    ///
    /// ```
    /// use lcplab_lcp::file::Problem;
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
    /// let problem = Problem::new("one contact", lcp);
    /// assert_eq!(problem.to_json()["name"], "one contact");
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn new(name: impl Into<String>, lcp: Lcp) -> Self {
        let (model, frozen_at, motion) = (None, None, None);
        let (extra, warnings) = (Map::new(), Vec::new());
        Problem { name: name.into(), lcp, model, frozen_at, motion, extra, warnings }
    }

    /// The contacts with friction, if there are any friction rows.
    ///
    /// # Errors
    /// If the friction rows are not the two tangents of contacts.
    pub fn friction(&self) -> Option<Result<FrictionProblem>> {
        let coupling = self.lcp.coupling()?;
        (!coupling.is_empty()).then(|| FrictionProblem::of(&self.lcp))
    }

    /// Reads a file, or standard input for the path `-`.
    ///
    /// ```
    /// use lcplab_lcp::file::Problem;
    ///
    /// let folder = tempfile::tempdir().unwrap();
    /// let path = folder.path().join("contact.json");
    /// std::fs::write(&path, r#"{"name": "contact", "A": {"dense": [[2]]}, "b": [-1]}"#).unwrap();
    /// let problem = Problem::read(&path)?;
    /// assert_eq!((problem.name.as_str(), problem.lcp.len()), ("contact", 1));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the file cannot be read, is not JSON, or has defects; all of them are listed.
    pub fn read(path: &Path) -> Result<Self> {
        Self::read_within(path, Memory::default())
    }

    /// Like [`read`](Problem::read), with another limit on the memory for reading.
    ///
    /// ```
    /// use lcplab_lcp::file::Problem;
    /// use lcplab_lcp::memory::Memory;
    ///
    /// let folder = tempfile::tempdir().unwrap();
    /// let path = folder.path().join("contact.json");
    /// std::fs::write(&path, r#"{"A": {"dense": [[2]]}, "b": [-1]}"#).unwrap();
    /// assert_eq!(Problem::read_within(&path, Memory::bytes(1000))?.lcp.b(), [-1.0]);
    /// assert!(Problem::read_within(&path, Memory::bytes(10)).is_err()); // the file is longer
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`read`](Problem::read), or if it needs more memory.
    pub fn read_within(path: &Path, most: Memory) -> Result<Self> {
        Self::parse(&read_text(path, most)?, &path.display().to_string())
    }

    /// Reads a problem from the text of a file called `input`.
    ///
    /// ```
    /// use lcplab_lcp::file::Problem;
    ///
    /// let text = r#"{"A": {"rows": 1, "cols": 1, "triplets": [[0, 0, 2]]}, "b": [-1]}"#;
    /// let problem = Problem::parse(text, "one.json")?;
    /// assert_eq!(problem.lcp.w(&[0.5]), [0.0]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the text is not JSON or has defects; all of them are listed.
    pub fn parse(text: &str, input: &str) -> Result<Self> {
        Self::from_object(parse_object(text, input)?, input)
    }

    /// The problem that an object called `input` describes.
    fn from_object(object: Map<String, Value>, input: &str) -> Result<Self> {
        let mut defects = Defects::default();
        for key in ["A", "b"].into_iter().filter(|key| !object.contains_key(*key)) {
            defects.add(key, "is missing");
        }
        // A and b give the sizes for all later checks.
        defects.result(input)?;
        let parts = Parts::read(&object, &mut defects);
        let model = model(&object, &mut defects);
        let frozen_at = frozen_at(&object, parts.b.len(), &mut defects);
        let scale = scale(&object, &mut defects);
        let motion = motion::read(&object, parts.b.len(), &mut defects);
        descriptions(&object, parts.b.len(), &mut defects);
        for key in object.keys().filter(|key| !is_known(key)) {
            if let Some(reason) = rolling_friction(key) {
                defects.add(key, reason);
            }
        }
        defects.into_result(input)?;
        let lcp = parts.into_lcp().and_then(|lcp| lcp.with_scale(scale));
        let lcp = lcp.map_err(|error| error.within(input))?;
        let motion = motion.map(|motion| motion::within_bounds(motion, &lcp));
        let model = model.filter(|model| !is_box_in_plane(*model, &lcp));
        let (mut extra, mut warnings) = (Map::new(), Vec::new());
        let name = object.get("name").and_then(Value::as_str).unwrap_or_default().to_string();
        for (key, value) in object {
            if KEPT.contains(&key.as_str()) {
                extra.insert(key, value);
            } else if !is_known(&key) {
                let meant = similar(&key).map(|known| format!("; did you mean {known:?}?"));
                let meant = meant.unwrap_or_default();
                warnings.push(format!("{input}: unknown key {key:?} ignored{meant}"));
            }
        }
        Ok(Problem { name, lcp, model, frozen_at, motion, extra, warnings })
    }

    /// The problem as JSON, sparse if its matrix is stored sparsely. Reading it back gives bitwise
    /// the same problem.
    ///
    /// ```
    /// use lcplab_lcp::file::Problem;
    ///
    /// let text = r#"{"A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, 2]}"#;
    /// let problem = Problem::parse(text, "column.json")?;
    /// let again = Problem::parse(&problem.to_json().to_string(), "again.json")?;
    /// assert_eq!(again.lcp.w(&[0.5, 0.0]), [0.0, 1.5]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn to_json(&self) -> Value {
        let mut object = Map::new();
        object.insert("name".into(), json!(self.name));
        object.extend(lcp_to_json(&self.lcp));
        if let Some(model) = self.model {
            object.insert("model".into(), json!(model.to_string()));
        }
        if let Some(x) = &self.frozen_at {
            object.insert("frozen_at".into(), json!(x));
        }
        // After the model, the same order of keys as in earlier files.
        if let Some(scale) = object.shift_remove("scale") {
            object.insert("scale".into(), scale);
        }
        if let Some(motion) = &self.motion {
            object.insert("motion".into(), motion::to_json(motion));
        }
        object.extend(self.extra.clone());
        Value::Object(object)
    }
}

/// The keys of an LCP.
fn lcp_to_json(lcp: &Lcp) -> Map<String, Value> {
    let n = lcp.len();
    let row = |i| lcp.matrix().row(i).iter();
    let matrix = match lcp.matrix() {
        Matrix::Dense(_) => {
            let dense: Vec<Vec<f64>> = (0..n).map(|i| row(i).map(|(_, a)| a).collect()).collect();
            json!({ "dense": dense })
        }
        Matrix::Sparse(_) => {
            let triplets: Vec<Value> =
                (0..n).flat_map(|i| row(i).map(move |(j, a)| json!([i, j, a]))).collect();
            json!({ "rows": n, "cols": n, "triplets": triplets })
        }
    };
    let mut object = Map::new();
    object.insert("A".into(), matrix);
    object.insert("b".into(), json!(lcp.b()));
    object.insert("lo".into(), lcp.lo().iter().map(|&v| number(v)).collect());
    object.insert("hi".into(), lcp.hi().iter().map(|&v| number(v)).collect());
    if let Some(coupling) = lcp.coupling() {
        let index = |i| coupling.index(i).map_or(json!(-1), |k| json!(k));
        object.insert("friction_index".into(), (0..n).map(index).collect());
        object.insert("mu".into(), (0..n).map(|i| json!(coupling.mu(i))).collect());
    }
    if lcp.scale() > 0.0 {
        object.insert("scale".into(), json!(lcp.scale()));
    }
    object
}

/// The object of a problem file.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let text = serde_json::to_string(&lcp).unwrap();
/// assert!(text.starts_with(r#"{"A":{"dense":[[2.0,-1.0],[-1.0,2.0]]},"b":[-1.0,2.0],"lo""#));
/// let back: Lcp = serde_json::from_str(&text).unwrap();
/// assert_eq!(serde_json::to_string(&back).unwrap(), text);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
impl Serialize for Lcp {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        lcp_to_json(self).serialize(serializer)
    }
}

/// Reads the object of a problem file. If the file states a friction model, this is an error: x
/// then solves more than the LCP, and a [`Problem`] is what to read.
impl<'de> Deserialize<'de> for Lcp {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        let problem = Problem::deserialize(deserializer)?;
        match problem.model {
            Some(model) => Err(D::Error::custom(format!(
                "the problem has the friction model {model}, which an LCP alone does not contain"
            ))),
            None => Ok(problem.lcp),
        }
    }
}

/// The object of a problem file.
impl Serialize for Problem {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        self.to_json().serialize(serializer)
    }
}

/// Reads the object of a problem file; an error lists all defects.
impl<'de> Deserialize<'de> for Problem {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        match json::Unique::deserialize(deserializer)?.0 {
            Value::Object(object) => {
                Problem::from_object(object, "problem").map_err(D::Error::custom)
            }
            _ => Err(D::Error::custom("a problem must be an object")),
        }
    }
}

/// The contents of an answer file.
///
/// ```
/// use lcplab_lcp::file::read_answers;
/// use lcplab_lcp::memory::Memory;
///
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("answer.json");
/// std::fs::write(&path, r#"{"x": [0.5, 0], "iterates": [[0.5, 0.25]]}"#).unwrap();
/// let answers = read_answers(&path, 2, Memory::default())?;
/// assert_eq!((answers.x, answers.iterates), (vec![0.5, 0.0], vec![vec![0.5, 0.25]]));
/// assert!(read_answers(&path, 3, Memory::default()).is_err()); // the problem has 3 rows
/// std::fs::write(&path, "[0.5, 0]").unwrap(); // the list alone
/// assert_eq!(read_answers(&path, 2, Memory::default())?.x, [0.5, 0.0]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    /// The answer.
    pub x: Vec<f64>,
    /// The iterates before the answer, under the key `iterates`; empty without the key.
    pub iterates: Vec<Vec<f64>>,
}

/// The vectors under the keys `x` and `iterates` of an answer file, which is any JSON object with
/// the key `x`, or the list x alone.
///
/// # Errors
/// If the file cannot be read within this memory, or x or an iterate is not a vector of `n`
/// numbers.
pub fn read_answers(path: &Path, n: usize, most: Memory) -> Result<Answers> {
    let input = path.display().to_string();
    let text = read_text(path, most)?;
    if !text.trim_start().starts_with(['{', '[']) && !text.trim().is_empty() {
        let reason = "is no answer file, which is JSON: {\"x\": [0.5, 0]}";
        return Err(Error::invalid(input, "file", reason));
    }
    let mut object = match json::read(&text, &input)? {
        Value::Object(object) => object,
        list => Map::from_iter([("x".to_string(), list)]),
    };
    let mut defects = Defects::default();
    let mut vector = |object: &Map<String, Value>, key: &str| {
        let before = defects.len();
        let x = numbers(object, key, &mut defects).unwrap_or_default();
        if defects.len() == before && !object.contains_key(key) {
            defects.add(key, "is missing");
        } else if defects.len() == before && x.len() != n {
            defects.add(key, format!("has length {}, the problem has {n} rows", x.len()));
        }
        x
    };
    let iterates = match object.remove("iterates") {
        None | Some(Value::Null) => Vec::new(),
        Some(Value::Array(list)) => list,
        Some(_) => return Err(Error::invalid(input, "iterates", "must be a list of vectors")),
    };
    let x = vector(&object, "x");
    let iterate = |(k, value): (usize, Value)| {
        let key = format!("iterates[{k}]");
        vector(&Map::from_iter([(key.clone(), value)]), &key)
    };
    let iterates = iterates.into_iter().enumerate().map(iterate).collect();
    defects.into_result(input)?;
    Ok(Answers { x, iterates })
}

/// Memory of one JSON value during reading, including its entry in a list and in the matrix
/// (bytes).
const VALUE: usize = 64;

/// The text of a file, if reading it stays within this memory limit.
fn read_text(path: &Path, most: Memory) -> Result<String> {
    let text = disk::read(path, most)?;
    let values = 1 + text.bytes().filter(|byte| b",[{".contains(byte)).count();
    let needs = Memory::bytes((text.len() + VALUE * values) as u64);
    most.check(format!("{}: reading {values} JSON values", path.display()), needs)?;
    Ok(text)
}

fn parse_object(text: &str, input: &str) -> Result<Map<String, Value>> {
    match json::read(text, input)? {
        Value::Object(object) => Ok(object),
        _ => Err(Error::invalid(input, "file", "must be a JSON object")),
    }
}
