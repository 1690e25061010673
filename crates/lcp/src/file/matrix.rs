//! The two notations of a matrix: dense, or as a list of entries.

use serde_json::{Map, Value};

use super::value::{as_number, brief};
use crate::Matrix;
use crate::error::Defects;

/// The keys of a matrix object.
const KEYS: [&str; 4] = ["dense", "rows", "cols", "triplets"];

/// The entries of a matrix as given in a file.
pub enum Entries {
    /// All n² entries, row by row.
    Dense(Vec<f64>),
    /// Row, column and value.
    Sparse(Vec<(usize, usize, f64)>),
}

impl Entries {
    /// The entries under the key `A` of an n × n matrix.
    pub(crate) fn read(a: &Value, n: usize, defects: &mut Defects) -> Self {
        let keys = a.as_object().into_iter().flat_map(Map::keys);
        for key in keys.filter(|key| !KEYS.contains(&key.as_str())) {
            defects.add(format!("A.{key}"), "is unknown");
        }
        match a {
            Value::Object(a) if a.contains_key("dense") && a.contains_key("triplets") => {
                defects.add("A", "has both \"dense\" and \"triplets\"");
                Entries::Dense(Vec::new())
            }
            Value::Object(a) if a.contains_key("dense") => {
                check_sizes(a, n, defects);
                Entries::Dense(dense(&a["dense"], n, defects))
            }
            Value::Object(a) if a.contains_key("triplets") => {
                Entries::Sparse(sparse(a, n, defects))
            }
            _ => {
                defects.add("A", "must be an object with \"dense\" or \"triplets\"");
                Entries::Dense(Vec::new())
            }
        }
    }

    /// The n × n matrix.
    pub fn matrix(&self, n: usize) -> Matrix {
        match self {
            Entries::Dense(entries) => Matrix::dense(n, entries),
            Entries::Sparse(entries) => Matrix::sparse(n, entries),
        }
    }
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

fn sparse(a: &Map<String, Value>, n: usize, defects: &mut Defects) -> Vec<(usize, usize, f64)> {
    for key in ["rows", "cols"].into_iter().filter(|key| !a.contains_key(*key)) {
        defects.add(format!("A.{key}"), "is missing");
    }
    check_sizes(a, n, defects);
    triplets(&a["triplets"], "A.triplets", (n, n), defects)
}

/// Checks the numbers of rows and columns, if given.
fn check_sizes(a: &Map<String, Value>, n: usize, defects: &mut Defects) {
    for key in ["rows", "cols"] {
        if let Some(value) = a.get(key).filter(|value| value.as_u64() != Some(n as u64)) {
            defects.add(format!("A.{key}"), format!("is {}, b has {n} rows", brief(value)));
        }
    }
}

/// The triplets under a key, for a matrix with this number of rows and columns.
pub(super) fn triplets(
    list: &Value,
    key: &str,
    (rows, columns): (usize, usize),
    defects: &mut Defects,
) -> Vec<(usize, usize, f64)> {
    let Value::Array(list) = list else {
        defects.add(key, "must be a list of [row, column, value]");
        return Vec::new();
    };
    let mut entries = Vec::new();
    for (k, triplet) in list.iter().enumerate() {
        let place = || format!("{key}[{k}]");
        let parts = triplet.as_array().map(Vec::as_slice);
        let Some([i, j, value]) = parts else {
            defects.add(place(), "must be [row, column, value]");
            continue;
        };
        let index =
            |value: &Value, n: usize| value.as_u64().filter(|&i| i < n as u64).map(|i| i as usize);
        match (index(i, rows), index(j, columns), as_number(value)) {
            (Some(i), Some(j), Some(value)) => entries.push((i, j, value)),
            (_, _, None) => {
                defects.add(place(), format!("value must be a number, is {}", brief(value)));
            }
            _ => {
                let (i, j) = (brief(i), brief(j));
                let reason = match rows == columns {
                    true => format!("row {i} and column {j} must be indices below {rows}"),
                    false => {
                        format!("row {i} must be an index below {rows}, column {j} below {columns}")
                    }
                };
                defects.add(place(), reason);
            }
        }
    }
    entries
}
