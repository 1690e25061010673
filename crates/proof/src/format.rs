//! Reads and writes proofs as JSON, strictly by the rules of `docs/proofs.md`.

use dashu_int::IBig;
use serde_json::{Map, Value, json};

use lcplab_judge::cases::Tree;
use lcplab_judge::{Dependence, RowState};
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::friction::Model;
use lcplab_lcp::json::read as read_json;

use crate::claim::{Bounded, Claim, Entry, Fraction, Motion, Near, Proof, Reason, Region, Vector};

/// The value of the key `format`.
const FORMAT: &str = "lcplab-proof-1";
/// The keys of every kind; `model` is optional.
const COMMON: [&str; 4] = ["format", "problem", "model", "kind"];
/// Limit on the branches of a path through a tree.
const MOST_BRANCHES: usize = 100;

impl Proof {
    /// The proof as JSON.
    pub fn to_json(&self) -> Value {
        let mut object = Map::new();
        object.insert("format".into(), json!(FORMAT));
        object.insert("problem".into(), json!(self.problem));
        let model = self.model.map(|model| json!(model.to_string()));
        object.extend(model.map(|model| ("model".to_string(), model)));
        object.insert("kind".into(), json!(self.claim.kind().name()));
        let own = match &self.claim {
            Claim::Solution { x, near: None } => vec![("x", point(x))],
            Claim::Solution { x, near: Some(near) } => vec![
                ("x", point(x)),
                ("answer", json!(near.answer)),
                ("distance", json!(near.distance)),
            ],
            Claim::ConeSolution { region, near } | Claim::BodySolution { region, near } => {
                let near = near.iter().flat_map(|near| {
                    [("answer", json!(near.answer)), ("distance", json!(near.distance))]
                });
                region_parts(region).into_iter().chain(near).collect()
            }
            Claim::Unique { x, by } => vec![("x", point(x)), ("by", json!(word(*by)))],
            Claim::NotUnique { x, y } => vec![("x", point(x)), ("y", point(y))],
            Claim::NoSolution { tree } => vec![("tree", branches(tree))],
            Claim::Motion(bounded) | Claim::FrozenMotion(bounded) => {
                let mut parts = vec![
                    ("answer", json!(bounded.answer)),
                    ("motion", motion(&bounded.motion)),
                    ("bound", json!(bounded.bound)),
                ];
                parts.extend(bounded.force.as_ref().map(|force| ("force", point(force))));
                parts
            }
            Claim::Within { answer, residual } => vec![
                ("answer", json!(answer)),
                (
                    "residual",
                    json!({
                        "numerator": hex(&residual.numerator),
                        "denominator": hex(&residual.denominator),
                    }),
                ),
            ],
        };
        object.extend(own.into_iter().map(|(key, value)| (key.to_string(), value)));
        Value::Object(object)
    }

    /// Reads a proof from the text of a file called `input`.
    ///
    /// # Errors
    /// If the text violates the format.
    pub fn parse(text: &str, input: &str) -> Result<Proof> {
        let wrong = |(key, reason): (String, String)| Error::invalid(input, key, reason);
        let value = read_json(text, input)?;
        read(&value).map_err(wrong)
    }
}

fn word(by: Reason) -> &'static str {
    match by {
        Reason::Definite => "definite",
        Reason::PMatrix => "p-matrix",
    }
}

fn hex(integer: &IBig) -> String {
    integer.in_radix(16).to_string()
}

fn point(x: &Vector) -> Value {
    let entry = |entry: &Entry| match entry {
        Entry::Numerator(numerator) => hex(numerator),
        Entry::Lo => "lo".into(),
        Entry::Hi => "hi".into(),
    };
    let numerators: Vec<String> = x.entries.iter().map(entry).collect();
    json!({ "denominator": hex(&x.denominator), "numerators": numerators })
}

fn region_parts(region: &Region) -> Vec<(&'static str, Value)> {
    let name = |state: &RowState| {
        RowState::NAMES.iter().find(|(own, _)| own == state).map(|(_, name)| *name)
    };
    let states: Vec<_> = region.states.iter().filter_map(name).collect();
    let radius: Vec<String> = region.radius.iter().map(hex).collect();
    let mut parts = vec![
        ("states", json!(states)),
        ("center", point(&region.center)),
        ("radius", json!(radius)),
        ("inverse", json!(region.inverse)),
    ];
    if !region.redundant.is_empty() {
        let dependence = |own: &Dependence| (own.row.to_string(), integers(&own.factors));
        parts.push(("redundant", Map::from_iter(region.redundant.iter().map(dependence)).into()));
    }
    if region.bias_change > 0.0 {
        parts.push(("bias_change", json!(region.bias_change)));
    }
    parts
}

/// Integers with their rows.
fn integers(entries: &[(usize, IBig)]) -> Value {
    Map::from_iter(entries.iter().map(|(i, value)| (i.to_string(), json!(hex(value))))).into()
}

fn motion(motion: &Motion) -> Value {
    let numerators: Vec<String> = motion.numerators.iter().map(hex).collect();
    json!({ "denominator": hex(&motion.denominator), "numerators": numerators })
}

fn branches(tree: &Tree) -> Value {
    match tree {
        Tree::Leaf(d) => json!({ "d": integers(d) }),
        Tree::Branch { row, lo, free, hi } => {
            let mut object = Map::new();
            object.insert("row".into(), json!(row));
            let sides = [("lo", lo.as_ref()), ("free", Some(free)), ("hi", hi.as_ref())];
            for (side, tree) in sides {
                object.extend(tree.map(|tree| (side.to_string(), branches(tree))));
            }
            Value::Object(object)
        }
    }
}

/// The value, or the invalid key and the reason.
type Read<T> = std::result::Result<T, (String, String)>;

fn wrong<T>(key: &str, reason: impl Into<String>) -> Read<T> {
    Err((key.to_string(), reason.into()))
}

fn read(value: &Value) -> Read<Proof> {
    let Value::Object(object) = value else { return wrong("file", "must be a JSON object") };
    let text = |key: &str| match object.get(key) {
        Some(Value::String(text)) => Ok(text.as_str()),
        Some(_) => wrong(key, "must be a string"),
        None => wrong(key, "is missing: this is no proof file"),
    };
    if text("format")? != FORMAT {
        return wrong("format", format!("must be {FORMAT:?}"));
    }
    let problem = text("problem")?;
    if problem.len() != 64 || !problem.bytes().all(|b| b"0123456789abcdef".contains(&b)) {
        return wrong("problem", "must be 64 hexadecimal digits");
    }
    let model = match object.get("model") {
        None => None,
        Some(_) => Some(text("model")?.parse().map_err(|_| unknown_model())?),
    };
    let own = |keys: &[&str]| only(object, &[&COMMON, keys].concat(), "file");
    let claim = match text("kind")? {
        "solution" if object.contains_key("answer") || object.contains_key("distance") => {
            own(&["x", "answer", "distance"])?;
            Claim::Solution { x: read_point(object, "x")?, near: Some(read_near(object)?) }
        }
        "solution" => {
            own(&["x"])?;
            Claim::Solution { x: read_point(object, "x")?, near: None }
        }
        kind @ ("cone-solution" | "body-solution") => {
            let region = read_region(object)?;
            let is_near = object.contains_key("answer") || object.contains_key("distance");
            let most = if kind == "body-solution" { &REGION[..] } else { &REGION[..5] };
            own(&[most, if is_near { &["answer", "distance"] } else { &[] }].concat())?;
            let near = if is_near { Some(read_near(object)?) } else { None };
            match kind {
                "cone-solution" => Claim::ConeSolution { region, near },
                _ => Claim::BodySolution { region, near },
            }
        }
        "unique" => {
            own(&["x", "by"])?;
            let by = match text("by")? {
                "definite" => Reason::Definite,
                "p-matrix" => Reason::PMatrix,
                _ => return wrong("by", "must be \"definite\" or \"p-matrix\""),
            };
            Claim::Unique { x: read_point(object, "x")?, by }
        }
        "not-unique" => {
            own(&["x", "y"])?;
            Claim::NotUnique { x: read_point(object, "x")?, y: read_point(object, "y")? }
        }
        "no-solution" => {
            own(&["tree"])?;
            Claim::NoSolution { tree: read_tree(object.get("tree"), MOST_BRANCHES)? }
        }
        "motion" if object.contains_key("force") => {
            let force = Some(read_point(object, "force")?);
            let rest = read_bounded(object, &["answer", "motion", "bound", "force"])?;
            Claim::Motion(Bounded { force, ..rest })
        }
        "motion" => Claim::Motion(read_bounded(object, &["answer", "motion", "bound"])?),
        "frozen-motion" => {
            Claim::FrozenMotion(read_bounded(object, &["answer", "motion", "bound"])?)
        }
        "within" => {
            own(&["answer", "residual"])?;
            let residual = part(object, "residual")?;
            only(residual, &["numerator", "denominator"], "residual")?;
            let residual = Fraction {
                numerator: not_negative(residual.get("numerator"), "residual")?,
                denominator: positive(residual.get("denominator"), "residual")?,
            };
            Claim::Within { answer: numbers(object, "answer")?, residual }
        }
        kind => return wrong("kind", format!("is {kind:?}, which is unknown")),
    };
    Ok(Proof { problem: problem.to_string(), model, claim })
}

fn read_near(object: &Map<String, Value>) -> Read<Near> {
    Ok(Near { answer: numbers(object, "answer")?, distance: size(object, "distance")? })
}

/// The keys of a box; the last two are optional, and the last one belongs to `body-solution` only.
const REGION: [&str; 6] = ["states", "center", "radius", "inverse", "redundant", "bias_change"];

fn read_region(object: &Map<String, Value>) -> Read<Region> {
    let list = |key: &str| match object.get(key) {
        Some(Value::Array(list)) => Ok(list),
        _ => wrong(key, "must be a list"),
    };
    let state = |value: &Value| {
        let name = value.as_str();
        let own = RowState::NAMES.iter().find(|(_, own)| Some(*own) == name);
        own.map_or_else(|| wrong("states", "has an unknown state"), |(state, _)| Ok(*state))
    };
    let redundant = match object.get("redundant") {
        None => Vec::new(),
        Some(_) => part(object, "redundant")?
            .iter()
            .map(|(row, factors)| {
                let Value::Object(factors) = factors else {
                    return wrong("redundant", "must consist of objects");
                };
                Ok(Dependence {
                    row: index(row, "redundant")?,
                    factors: read_integers(factors, "redundant")?,
                })
            })
            .collect::<Read<_>>()?,
    };
    let has_change = object.contains_key("bias_change");
    Ok(Region {
        redundant,
        bias_change: if has_change { size(object, "bias_change")? } else { 0.0 },
        states: list("states")?.iter().map(state).collect::<Read<_>>()?,
        center: read_point(object, "center")?,
        radius: list("radius")?
            .iter()
            .map(|value| not_negative(Some(value), "radius"))
            .collect::<Read<_>>()?,
        inverse: list("inverse")?
            .iter()
            .map(|row| finite(row).map_or_else(|| wrong("inverse", "must be lists of numbers"), Ok))
            .collect::<Read<_>>()?,
    })
}

fn unknown_model() -> (String, String) {
    let names = Model::ALL.map(|model| model.to_string()).join(", ");
    ("model".into(), format!("must be one of {names}, or another polygon"))
}

fn read_bounded(object: &Map<String, Value>, keys: &[&str]) -> Read<Bounded> {
    only(object, &[&COMMON[..], keys].concat(), "file")?;
    let motion = part(object, "motion")?;
    only(motion, &["denominator", "numerators"], "motion")?;
    let Some(Value::Array(numerators)) = motion.get("numerators") else {
        return wrong("motion", "must have a list of numerators");
    };
    let numerators = numerators.iter().map(|value| integer(Some(value), "motion"));
    let motion = Motion {
        denominator: positive(motion.get("denominator"), "motion")?,
        numerators: numerators.collect::<Read<_>>()?,
    };
    let answer = numbers(object, "answer")?;
    Ok(Bounded { answer, force: None, motion, bound: size(object, "bound")? })
}

/// Checks that an object has no other keys.
fn only(object: &Map<String, Value>, keys: &[&str], name: &str) -> Read<()> {
    match object.keys().find(|key| !keys.contains(&key.as_str())) {
        Some(key) => wrong(name, format!("has the key {key:?}, which is unknown")),
        None => Ok(()),
    }
}

fn part<'a>(object: &'a Map<String, Value>, key: &str) -> Read<&'a Map<String, Value>> {
    match object.get(key) {
        Some(Value::Object(part)) => Ok(part),
        _ => wrong(key, "must be an object"),
    }
}

fn read_point(object: &Map<String, Value>, key: &str) -> Read<Vector> {
    let point = part(object, key)?;
    only(point, &["denominator", "numerators"], key)?;
    let Some(Value::Array(entries)) = point.get("numerators") else {
        return wrong(key, "must have a list of numerators");
    };
    let entry = |value: &Value| match value.as_str() {
        Some("lo") => Ok(Entry::Lo),
        Some("hi") => Ok(Entry::Hi),
        _ => integer(Some(value), key).map(Entry::Numerator),
    };
    Ok(Vector {
        denominator: positive(point.get("denominator"), key)?,
        entries: entries.iter().map(entry).collect::<Read<_>>()?,
    })
}

/// A tree with at most `left` branches on a path.
fn read_tree(value: Option<&Value>, left: usize) -> Read<Tree> {
    let Some(Value::Object(object)) = value else { return wrong("tree", "must be an object") };
    if object.contains_key("d") {
        only(object, &["d"], "tree")?;
        return Ok(Tree::Leaf(read_integers(part(object, "d")?, "tree")?));
    }
    only(object, &["row", "lo", "free", "hi"], "tree")?;
    let row = object.get("row").and_then(Value::as_u64);
    let Some(row) = row.and_then(|row| usize::try_from(row).ok()) else {
        return wrong("tree", "must have a row or a d");
    };
    let Some(left) = left.checked_sub(1) else {
        return wrong("tree", format!("has more than {MOST_BRANCHES} branches on a path"));
    };
    let side = |key: &str| -> Read<Option<Box<Tree>>> {
        let tree = object.get(key).map(|tree| read_tree(Some(tree), left));
        Ok(tree.transpose()?.map(Box::new))
    };
    let free = Box::new(read_tree(object.get("free"), left)?);
    Ok(Tree::Branch { row, lo: side("lo")?, free, hi: side("hi")? })
}

/// Integers with their rows, of an object whose keys are row numbers.
fn read_integers(object: &Map<String, Value>, key: &str) -> Read<Vec<(usize, IBig)>> {
    object.iter().map(|(row, value)| Ok((index(row, key)?, integer(Some(value), key)?))).collect()
}

/// Parses a key that is a row number.
fn index(text: &str, key: &str) -> Read<usize> {
    match text.parse::<usize>() {
        Ok(row) if row.to_string() == text => Ok(row),
        _ => wrong(key, format!("has the row {text:?}")),
    }
}

fn integer(value: Option<&Value>, key: &str) -> Read<IBig> {
    let text = value.and_then(Value::as_str);
    let parsed = text.and_then(|text| Some((text, IBig::from_str_radix(text, 16).ok()?)));
    match parsed {
        Some((text, integer)) if hex(&integer) == text => Ok(integer),
        _ => wrong(key, "must be integers in lower-case hexadecimal digits"),
    }
}

fn positive(value: Option<&Value>, key: &str) -> Read<IBig> {
    match integer(value, key)? {
        integer if integer > IBig::ZERO => Ok(integer),
        _ => wrong(key, "must have a positive denominator"),
    }
}

fn not_negative(value: Option<&Value>, key: &str) -> Read<IBig> {
    match integer(value, key)? {
        integer if integer >= IBig::ZERO => Ok(integer),
        _ => wrong(key, "must not be negative"),
    }
}

/// A nonnegative number; −0 is read as 0.
fn size(object: &Map<String, Value>, key: &str) -> Read<f64> {
    match object.get(key).and_then(Value::as_f64) {
        Some(number) if number.is_finite() && number >= 0.0 => Ok(number + 0.0),
        _ => wrong(key, "must be a finite number that is not negative"),
    }
}

fn numbers(object: &Map<String, Value>, key: &str) -> Read<Vec<f64>> {
    let numbers = object.get(key).and_then(finite);
    numbers.map_or_else(|| wrong(key, "must be a list of finite numbers"), Ok)
}

/// A list of finite numbers.
fn finite(value: &Value) -> Option<Vec<f64>> {
    let number = |value: &Value| value.as_f64().filter(|number| number.is_finite());
    value.as_array()?.iter().map(number).collect()
}
