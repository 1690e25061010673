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

/// An entry below this part of the largest that it was is zero.
const RELATIVE_ZERO: f64 = 1e-12;

/// v_B = c + T v_N.
#[derive(Debug, Clone)]
pub(super) struct Dictionary<V> {
    /// The basic variables, one a row.
    pub(super) basic: Vec<V>,
    /// The nonbasic variables, one a column.
    pub(super) nonbasic: Vec<V>,
    /// c.
    pub(super) constant: Vec<f64>,
    /// The largest terms that each constant was ever summed from, which is what its rounding errors
    /// are proportional to.
    pub(super) terms: Vec<f64>,
    /// A constant below this part of those terms is zero, not only one that cancels in a single sum.
    pub(super) forgives: f64,
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
        let (constant, terms) = (-self.constant[r] / pivot, self.terms[r] / pivot.abs());
        for i in 0..self.rows.len() {
            if i == r || self.rows[i][c] == 0.0 {
                continue;
            }
            let factor = std::mem::take(&mut self.rows[i][c]);
            for (entry, &new) in self.rows[i].iter_mut().zip(&row) {
                *entry = difference(*entry, -factor * new);
            }
            self.constant[i] = difference(self.constant[i], -factor * constant);
            self.terms[i] = self.terms[i].max(factor.abs() * terms);
            if self.constant[i].abs() <= self.forgives * self.terms[i] {
                self.constant[i] = 0.0;
            }
        }
        (self.rows[r], self.constant[r], self.terms[r]) = (row, constant, terms);
    }

    /// Exchanges these basic variables for these nonbasic ones, the largest entry first, until all
    /// are exchanged or only zeros are left. Zero is an entry that has lost all its digits, compared
    /// with the largest that it was on the way.
    pub(super) fn exchange(
        &mut self,
        is_leaving: impl Fn(V) -> bool,
        is_entering: impl Fn(V) -> bool,
    ) {
        let mut largest = self.rows.clone();
        loop {
            for (seen, now) in largest.iter_mut().flatten().zip(self.rows.iter().flatten()) {
                *seen = seen.abs().max(now.abs());
            }
            let rows = (0..self.basic.len()).filter(|&r| is_leaving(self.basic[r]));
            let columns: Vec<usize> =
                (0..self.nonbasic.len()).filter(|&c| is_entering(self.nonbasic[c])).collect();
            let size = |&(r, c): &(usize, usize)| self.rows[r][c].abs();
            let pivot = rows
                .flat_map(|r| columns.iter().map(move |&c| (r, c)))
                .filter(|at| size(at) > RELATIVE_ZERO * largest[at.0][at.1])
                .max_by(|a, b| size(a).total_cmp(&size(b)));
            match pivot {
                Some((r, c)) => self.pivot(r, c),
                None => break,
            }
        }
        for r in 0..self.basic.len() {
            for c in 0..self.nonbasic.len() {
                if is_leaving(self.basic[r]) && is_entering(self.nonbasic[c]) {
                    self.rows[r][c] = 0.0;
                }
            }
        }
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
        self.terms.push(constant.abs());
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
