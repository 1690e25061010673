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
//! free in aᵀx − s = 0 and w_s = y. A row without limits is left out.

use serde_json::{Value, json};

/// Limits of at least this size are infinite, as in HiGHS, CPLEX and OSQP.
pub(super) const INFINITE: f64 = 1e20;

/// A limit or bound, infinite from [`INFINITE`] on.
pub(super) fn limit(value: f64) -> f64 {
    match value {
        v if v >= INFINITE => f64::INFINITY,
        v if v <= -INFINITE => f64::NEG_INFINITY,
        v => v,
    }
}

/// A constraint.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Its name in labels.
    pub name: String,
    /// The column and the value of each entry of a, by columns.
    pub entries: Vec<(usize, f64)>,
    /// The least and the largest aᵀx.
    pub limits: [f64; 2],
}

/// The part of a problem that constraints add after the columns.
pub(super) struct Multipliers {
    pub entries: Vec<(usize, usize, f64)>,
    pub b: Vec<f64>,
    pub lo: Vec<f64>,
    pub hi: Vec<f64>,
    /// The labels of the added rows.
    pub labels: Vec<Value>,
}

impl Multipliers {
    /// The multipliers of these rows, then the unknowns s of rows with two limits.
    pub fn of(rows: &[Row], columns: usize) -> Self {
        let is_limited = |row: &&Row| row.limits.iter().any(|limit| limit.is_finite());
        let rows: Vec<&Row> = rows.iter().filter(is_limited).collect();
        let count = rows.len();
        let (mut entries, mut b, mut labels) = (Vec::new(), Vec::new(), Vec::new());
        let (mut lo, mut hi) = (Vec::new(), Vec::new());
        let mut between = Vec::new();
        for (k, row) in rows.iter().enumerate() {
            let y = columns + k;
            for &(column, value) in &row.entries {
                entries.extend([(y, column, value), (column, y, -value)]);
            }
            let [least, most] = row.limits;
            let (rhs, low, high) = match (least.is_finite(), most.is_finite()) {
                (true, false) => (least, 0.0, f64::INFINITY),
                (false, true) => (most, f64::NEG_INFINITY, 0.0),
                _ if least == most => (least, f64::NEG_INFINITY, f64::INFINITY),
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
            labels.push(label(&format!("value of {}", rows[k].name), "row"));
        }
        Multipliers { entries, b, lo, hi, labels }
    }
}

/// The label of a row of the problem.
pub(super) fn label(name: &str, kind: &str) -> Value {
    json!({ "label": name, "kind": kind })
}
