//! The constraints of a QPS file.

use std::collections::HashMap;

use super::program::Checked;
use crate::multipliers::Row;
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

    /// The rows, in the order of the file.
    pub fn rows(&self) -> Vec<Row> {
        let row = |constraint: &Constraint| {
            let mut entries: Vec<(usize, f64)> =
                constraint.entries.iter().map(|(j, a)| (*j, *a)).collect();
            entries.sort_by_key(|(column, _)| *column);
            Row { name: constraint.name.clone(), entries, limits: constraint.limits() }
        };
        self.all.iter().map(row).collect()
    }
}

fn once(place: &mut Option<f64>, value: f64, what: &str, row: &str) -> Checked {
    match place.replace(value) {
        None => Ok(()),
        Some(_) => Err(format!("a second {what} of row {:?}", brief(row))),
    }
}
