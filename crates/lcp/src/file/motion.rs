//! The key `motion`: the bodies and rows that A and b were made from.

use serde_json::{Map, Value, json};

use super::matrix::triplets;
use super::value::{brief, numbers};
use crate::error::Defects;
use crate::{Gauss, Lcp, Level};

/// The required keys.
const KEYS: [&str; 5] = ["mass", "jacobian", "bias", "compliance", "target"];
/// The optional key.
const LEVEL: &str = "level";

/// The data of Gauss's principle under the key `motion`, if present; the bounds are those of the
/// problem.
pub(super) fn read(object: &Map<String, Value>, n: usize, defects: &mut Defects) -> Option<Gauss> {
    let Value::Object(motion) = object.get("motion")? else {
        defects.add("motion", "must be an object");
        return None;
    };
    let before = defects.len();
    for key in KEYS.into_iter().filter(|key| !motion.contains_key(*key)) {
        defects.add(format!("motion.{key}"), "is missing");
    }
    for key in motion.keys().filter(|key| !KEYS.contains(&key.as_str()) && *key != LEVEL) {
        defects.add(format!("motion.{key}"), "is unknown");
    }
    if defects.len() > before {
        return None;
    }
    let mut vector = |key: &str, rows: Option<usize>| {
        let values = numbers(motion, key, defects).unwrap_or_default();
        if let Some(rows) = rows.filter(|&rows| rows != values.len()) {
            defects.add(
                format!("motion.{key}"),
                format!("has {} entries, b has {rows}", values.len()),
            );
        }
        for (i, value) in values.iter().enumerate().filter(|(_, value)| !value.is_finite()) {
            defects.add(format!("motion.{key}[{i}]"), format!("must be finite, is {value}"));
        }
        values
    };
    let target = vector("target", None);
    let bias = vector("bias", Some(n));
    let compliance = vector("compliance", Some(n));
    let k = target.len();
    let mass = triplets(&motion["mass"], "motion.mass", (k, k), defects);
    let rows = triplets(&motion["jacobian"], "motion.jacobian", (n, k), defects);
    for (i, value) in compliance.iter().enumerate().filter(|(_, value)| **value < 0.0) {
        defects.add(format!("motion.compliance[{i}]"), format!("must not be negative, is {value}"));
    }
    for &(i, j, _) in mass.iter().filter(|(i, j, _)| i > j) {
        defects.add("motion.mass", format!("has an entry at ({i}, {j}), below the diagonal"));
    }
    for (key, list) in [("mass", &mass), ("jacobian", &rows)] {
        let mut places: Vec<(usize, usize)> = list.iter().map(|&(i, j, _)| (i, j)).collect();
        places.sort_unstable();
        for two in places.windows(2).filter(|two| two[0] == two[1]) {
            defects.add(format!("motion.{key}"), format!("has two entries at {:?}", two[0]));
        }
        for (i, j, value) in list.iter().filter(|(_, _, value)| !value.is_finite()) {
            let reason = format!("must be finite, is {} at ({i}, {j})", brief(&json!(value)));
            defects.add(format!("motion.{key}"), reason);
        }
    }
    let mut jacobian = vec![Vec::new(); n];
    rows.into_iter().for_each(|(i, j, value)| jacobian[i].push((j, value)));
    let (lo, hi) = (Vec::new(), Vec::new());
    let level = motion.get(LEVEL).and_then(|value| level(value, defects));
    Some(Gauss { mass, jacobian, bias, compliance, target, lo, hi, level })
}

/// The value of the key `level`.
fn level(value: &Value, defects: &mut Defects) -> Option<Level> {
    let known = Level::ALL.into_iter().find(|level| value.as_str() == Some(level.name()));
    if known.is_none() {
        let reason = format!("must be \"velocity\" or \"acceleration\", is {}", brief(value));
        defects.add("motion.level", reason);
    }
    known
}

/// The motion with the bounds of the problem.
pub(super) fn within_bounds(motion: Gauss, lcp: &Lcp) -> Gauss {
    Gauss { lo: lcp.lo().to_vec(), hi: lcp.hi().to_vec(), ..motion }
}

/// The motion as written in a file.
pub(super) fn to_json(motion: &Gauss) -> Value {
    let jacobian = motion.jacobian.iter().enumerate();
    let jacobian: Vec<(usize, usize, f64)> =
        jacobian.flat_map(|(i, row)| row.iter().map(move |&(j, v)| (i, j, v))).collect();
    let without_zeros = |mut entries: Vec<(usize, usize, f64)>| {
        entries.retain(|entry| entry.2 != 0.0);
        entries
    };
    let mut object = json!({
        "mass": without_zeros(motion.mass.clone()),
        "jacobian": without_zeros(jacobian),
        "bias": motion.bias,
        "compliance": motion.compliance,
        "target": motion.target,
    });
    if let Some(level) = motion.level {
        object[LEVEL] = json!(level.name());
    }
    object
}
