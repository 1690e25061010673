//! A dictionary: linear equations solved for some of their variables.
//!
//! ```text
//! v_B = c + T v_N        B basic, N nonbasic
//! ```
//!
//! A *pivot* lets one basic and one nonbasic variable change places. Pivoting methods start from
//! w = b + A x, where w is basic, and exchange until c says what they want to hear: with all
//! nonbasic variables at 0, c is the value of the basic ones.

use super::elimination::difference;

/// v_B = c + T v_N.
#[derive(Debug, Clone)]
pub(super) struct Dictionary<V> {
    /// The basic variables, one a row.
    pub(super) basic: Vec<V>,
    /// The nonbasic variables, one a column.
    pub(super) nonbasic: Vec<V>,
    /// c.
    pub(super) constant: Vec<f64>,
    /// T, by rows.
    pub(super) rows: Vec<Vec<f64>>,
}

impl<V: Copy + PartialEq> Dictionary<V> {
    /// Exchanges the basic variable of row r and the nonbasic one of column c; T_rc must not be 0.
    ///
    /// ```text
    /// v_c = (v_r − c_r − Σ_{j≠c} T_rj v_j) / T_rc,   put into all other rows
    /// ```
    pub(super) fn pivot(&mut self, r: usize, c: usize) {
        std::mem::swap(&mut self.basic[r], &mut self.nonbasic[c]);
        let mut row = std::mem::take(&mut self.rows[r]);
        let pivot = std::mem::replace(&mut row[c], -1.0);
        row.iter_mut().for_each(|entry| *entry /= -pivot);
        let constant = -self.constant[r] / pivot;
        for (other, other_constant) in self.rows.iter_mut().zip(&mut self.constant) {
            if other.is_empty() || other[c] == 0.0 {
                continue;
            }
            let factor = std::mem::take(&mut other[c]);
            for (entry, &new) in other.iter_mut().zip(&row) {
                *entry = difference(*entry, -factor * new);
            }
            *other_constant = difference(*other_constant, -factor * constant);
        }
        (self.rows[r], self.constant[r]) = (row, constant);
    }

    /// The value of a variable while all nonbasic ones are 0.
    pub(super) fn value(&self, variable: V) -> f64 {
        self.row_of(variable).map_or(0.0, |r| self.constant[r])
    }

    /// How fast a variable changes while the nonbasic one of column c grows at rate 1.
    pub(super) fn rate(&self, variable: V, c: usize) -> f64 {
        match self.row_of(variable) {
            Some(r) => self.rows[r][c],
            None if self.nonbasic[c] == variable => 1.0,
            None => 0.0,
        }
    }

    /// The row of a basic variable.
    pub(super) fn row_of(&self, variable: V) -> Option<usize> {
        self.basic.iter().position(|&v| v == variable)
    }

    /// The column of a nonbasic variable.
    pub(super) fn column_of(&self, variable: V) -> Option<usize> {
        self.nonbasic.iter().position(|&v| v == variable)
    }

    /// Adds a nonbasic variable with these entries in its column.
    pub(super) fn add_column(&mut self, variable: V, entry: impl Fn(usize) -> f64) {
        self.nonbasic.push(variable);
        for (r, row) in self.rows.iter_mut().enumerate() {
            row.push(entry(r));
        }
    }

    /// Adds an equation for a basic variable.
    pub(super) fn add_row(&mut self, variable: V, constant: f64, row: Vec<f64>) {
        self.basic.push(variable);
        self.constant.push(constant);
        self.rows.push(row);
    }

    /// Fixes a nonbasic variable at 0 for good.
    pub(super) fn drop_column(&mut self, c: usize) {
        self.nonbasic.remove(c);
        for row in &mut self.rows {
            row.remove(c);
        }
    }
}
