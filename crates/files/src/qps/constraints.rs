//! The constraint rows of a quadratic program, and the conditions of its minimum as a problem.
//!
//! A row r₁ ≤ aᵀx ≤ r₂ gets a multiplier y, the force that holds it:
//!
//! ```text
//! w_x = Q x + c − Aᵀ y,    lo ≤ x ≤ hi
//! w_y = A x − r            y ≥ 0 for aᵀx ≥ r,  y ≤ 0 for aᵀx ≤ r,  y free for aᵀx = r
//! ```
//!
//! A row with two different finite limits also gets an unknown s = aᵀx between them, so that y is
//! free in aᵀx − s = 0 and w_s = y.

use std::collections::HashMap;

use serde_json::{Value, json};

use super::program::Checked;
use crate::words::brief;

/// A kind of row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sense {
    AtMost,
    AtLeast,
    Equal,
}

/// A constraint.
#[derive(Debug, Clone)]
struct Constraint {
    name: String,
    sense: Sense,
    /// The column and the value of each entry.
    entries: HashMap<usize, f64>,
    rhs: Option<f64>,
    range: Option<f64>,
}

impl Constraint {
    /// The limits of aᵀx. A range R makes the second limit: rhs − |R| for ≤, rhs + |R| for ≥, and
    /// rhs + R for =.
    fn limits(&self) -> [f64; 2] {
        let rhs = self.rhs.unwrap_or(0.0);
        match (self.sense, self.range) {
            (Sense::AtMost, None) => [f64::NEG_INFINITY, rhs],
            (Sense::AtMost, Some(range)) => [rhs - range.abs(), rhs],
            (Sense::AtLeast, None) => [rhs, f64::INFINITY],
            (Sense::AtLeast, Some(range)) => [rhs, rhs + range.abs()],
            (Sense::Equal, None) => [rhs, rhs],
            (Sense::Equal, Some(range)) => [rhs.min(rhs + range), rhs.max(rhs + range)],
        }
    }
}

/// The constraints of a program, in the order of the file.
#[derive(Debug, Default)]
pub(super) struct Constraints {
    all: Vec<Constraint>,
    index: HashMap<String, usize>,
}

/// The part of a problem that the constraints add after n columns.
pub(super) struct Multipliers {
    pub entries: Vec<(usize, usize, f64)>,
    pub b: Vec<f64>,
    pub lo: Vec<f64>,
    pub hi: Vec<f64>,
    /// The labels of the added rows.
    pub labels: Vec<Value>,
}

impl Constraints {
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// A row of this kind: L, G or E.
    pub fn add(&mut self, kind: &str, name: &str) -> Checked {
        let sense = match kind.to_ascii_uppercase().as_str() {
            "L" => Sense::AtMost,
            "G" => Sense::AtLeast,
            "E" => Sense::Equal,
            _ => return Err(format!("there is no kind of row {:?}", brief(kind))),
        };
        if self.index.insert(name.to_string(), self.all.len()).is_some() {
            return Err(format!("a second row {:?}", brief(name)));
        }
        let (name, entries) = (name.to_string(), HashMap::new());
        self.all.push(Constraint { name, sense, entries, rhs: None, range: None });
        Ok(())
    }

    pub fn entry(&mut self, row: &str, column: usize, value: f64) -> Checked {
        match self.known(row)?.entries.insert(column, value) {
            None => Ok(()),
            Some(_) => Err(format!("a second entry of this column in row {:?}", brief(row))),
        }
    }

    pub fn rhs(&mut self, row: &str, value: f64) -> Checked {
        once(&mut self.known(row)?.rhs, value, "right-hand side", row)
    }

    pub fn range(&mut self, row: &str, value: f64) -> Checked {
        once(&mut self.known(row)?.range, value, "range", row)
    }

    fn known(&mut self, row: &str) -> Checked<&mut Constraint> {
        let index = self.index.get(row).copied();
        let index = index.ok_or_else(|| format!("there is no row {:?}", brief(row)))?;
        Ok(&mut self.all[index])
    }

    /// The multipliers, then the unknowns s of rows with two limits.
    pub fn multipliers(&self, columns: usize) -> Multipliers {
        let count = self.all.len();
        let (mut entries, mut b, mut labels) = (Vec::new(), Vec::new(), Vec::new());
        let (mut lo, mut hi) = (Vec::new(), Vec::new());
        let label = |name: &str, kind: &str| json!({ "label": name, "kind": kind });
        let mut between = Vec::new();
        for (k, row) in self.all.iter().enumerate() {
            let y = columns + k;
            let mut own: Vec<(usize, f64)> = row.entries.iter().map(|(j, a)| (*j, *a)).collect();
            own.sort_by_key(|(column, _)| *column);
            for (column, value) in own {
                entries.extend([(y, column, value), (column, y, -value)]);
            }
            let [least, most] = row.limits();
            let (rhs, low, high) = match (least.is_finite(), most.is_finite()) {
                (true, false) => (least, 0.0, f64::INFINITY),
                (false, true) => (most, f64::NEG_INFINITY, 0.0),
                (true, true) if least == most => (least, f64::NEG_INFINITY, f64::INFINITY),
                _ => {
                    between.push((k, least, most));
                    (0.0, f64::NEG_INFINITY, f64::INFINITY)
                }
            };
            b.push(-rhs);
            lo.push(low);
            hi.push(high);
            labels.push(label(&format!("multiplier of {}", row.name), "multiplier"));
        }
        for (place, (k, least, most)) in between.into_iter().enumerate() {
            let (y, s) = (columns + k, columns + count + place);
            entries.extend([(y, s, -1.0), (s, y, 1.0)]);
            b.push(0.0);
            lo.push(least);
            hi.push(most);
            labels.push(label(&format!("value of {}", self.all[k].name), "row"));
        }
        Multipliers { entries, b, lo, hi, labels }
    }
}

fn once(place: &mut Option<f64>, value: f64, what: &str, row: &str) -> Checked {
    match place.replace(value) {
        None => Ok(()),
        Some(_) => Err(format!("a second {what} of row {:?}", brief(row))),
    }
}
