//! The units of x, w and A, row by row.

use std::ops::Range;

use serde_json::Value;

use lcplab_lcp::file;

/// The text instead of a unit if rows have different units.
const DIFFERENT: &str = "units row by row";

/// The units of x and w, one entry per row; empty if unknown.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Units {
    pub x: Vec<String>,
    pub w: Vec<String>,
}

/// Units of x with the corresponding units of w and the quotient.
const KNOWN: [[&str; 3]; 6] = [
    ["N s", "m/s", "1/kg"],
    ["N m s", "rad/s", "1/(kg m²)"],
    ["N", "m/s²", "1/kg"],
    ["N m", "rad/s²", "1/(kg m²)"],
    ["kg m", "m", "1/kg"],
    ["kg m²", "rad", "1/(kg m²)"],
];

impl Units {
    /// The units stated in a problem file, if there are any.
    pub fn stated(problem: &file::Problem) -> Self {
        let unit = |i: usize| {
            let row = problem.extra.get("rows").and_then(|rows| rows.get(i));
            let unit = row.and_then(|row| row.get("unit")).and_then(Value::as_str);
            unit.unwrap_or_default().to_string()
        };
        Units::from_x((0..problem.lcp.len()).map(unit).collect())
    }

    /// These units of x, with the corresponding units of w.
    pub(crate) fn from_x(x: Vec<String>) -> Self {
        let w = x.iter().map(|x| known(x)[1].to_string()).collect();
        Units { x, w }
    }

    /// The units in the LCP of friction polygons: those of the row that each unknown belongs to,
    /// except that `speeds` are the γ, whose w are impulses.
    pub fn of_polygons(&self, rows: &[usize], speeds: Range<usize>) -> Self {
        let of = |unknown: usize| {
            let [x, w] = [&self.x, &self.w].map(|units| units[rows[unknown]].clone());
            if speeds.contains(&unknown) { (w, x) } else { (x, w) }
        };
        let (x, w) = (0..rows.len()).map(of).unzip();
        Units { x, w }
    }

    /// The common unit of all x, or a text that they differ.
    pub fn of_x(&self) -> String {
        common(&self.x)
    }

    /// The common unit of all w, or a text that they differ.
    pub fn of_w(&self) -> String {
        common(&self.w)
    }

    /// The common unit of A's entries, or a text that they differ.
    pub(crate) fn of_matrix(&self) -> String {
        match self.x.first() {
            Some(first) if self.x.iter().all(|x| x == first) => known(first)[2].into(),
            _ => common(&self.x),
        }
    }
}

/// The corresponding units of x, w and A.
pub(super) fn known(x: &str) -> [&'static str; 3] {
    KNOWN.into_iter().find(|[unit, ..]| *unit == x).unwrap_or_default()
}

fn common(units: &[String]) -> String {
    match units.first() {
        Some(first) if units.iter().all(|unit| unit == first) => first.clone(),
        Some(_) => DIFFERENT.into(),
        None => String::new(),
    }
}

/// A heading with the unit in brackets, if all rows have the same.
pub(super) fn headed(words: &str, unit: &str) -> String {
    if matches!(unit, "" | DIFFERENT) { words.to_string() } else { format!("{words} ({unit})") }
}

/// A number with its unit; without one if the rows differ.
pub(super) fn with_unit(number: &str, unit: &str) -> String {
    match unit {
        "" | DIFFERENT => number.to_string(),
        unit => format!("{number} {unit}"),
    }
}
