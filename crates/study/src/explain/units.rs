//! The units of x, w and A, row by row.

use std::ops::Range;

use serde_json::Value;

use lcplab_problem::file;

/// What is said in place of a unit that not all rows have.
const DIFFERENT: &str = "units row by row";

/// The units of x and w, one entry a row; empty where none is known.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Units {
    pub x: Vec<String>,
    pub w: Vec<String>,
}

/// Units of x with those of w that belong to them, and the quotient.
const KNOWN: [[&str; 3]; 6] = [
    ["N s", "m/s", "1/kg"],
    ["N m s", "rad/s", "1/(kg m²)"],
    ["N", "m/s²", "1/kg"],
    ["N m", "rad/s²", "1/(kg m²)"],
    ["kg m", "m", "1/kg"],
    ["kg m²", "rad", "1/(kg m²)"],
];

impl Units {
    /// Those that a problem file states, if it does.
    pub fn stated(problem: &file::Problem) -> Self {
        let unit = |i: usize| {
            let row = problem.extra.get("rows").and_then(|rows| rows.get(i));
            let unit = row.and_then(|row| row.get("unit")).and_then(Value::as_str);
            unit.unwrap_or_default().to_string()
        };
        Units::from_x((0..problem.lcp.len()).map(unit).collect())
    }

    /// Those of x, and of w as they belong to them.
    pub(crate) fn from_x(x: Vec<String>) -> Self {
        let w = x.iter().map(|x| known(x)[1].to_string()).collect();
        Units { x, w }
    }

    /// Those of the LCP of friction within polygons: of the row that each unknown belongs to, but
    /// `speeds` are the γ, whose w are impulses.
    pub fn of_polygons(&self, rows: &[usize], speeds: Range<usize>) -> Self {
        let of = |unknown: usize| {
            let [x, w] = [&self.x, &self.w].map(|units| units[rows[unknown]].clone());
            if speeds.contains(&unknown) { (w, x) } else { (x, w) }
        };
        let (x, w) = (0..rows.len()).map(of).unzip();
        Units { x, w }
    }

    /// The unit of all x, or a word that they differ.
    pub fn of_x(&self) -> String {
        common(&self.x)
    }

    /// The unit of all w, or a word that they differ.
    pub fn of_w(&self) -> String {
        common(&self.w)
    }

    /// The unit of A's entries, or a word that they differ.
    pub(crate) fn of_matrix(&self) -> String {
        match self.x.first() {
            Some(first) if self.x.iter().all(|x| x == first) => known(first)[2].into(),
            _ => common(&self.x),
        }
    }
}

/// The units of x, w and A that belong together.
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

/// A heading with the unit in brackets, if there is one for all rows.
pub(super) fn headed(words: &str, unit: &str) -> String {
    if matches!(unit, "" | DIFFERENT) { words.to_string() } else { format!("{words} ({unit})") }
}

/// A number with its unit; without one if the rows differ in theirs.
pub(super) fn with_unit(number: &str, unit: &str) -> String {
    match unit {
        "" | DIFFERENT => number.to_string(),
        unit => format!("{number} {unit}"),
    }
}
