//! A dictionary: linear equations solved for some of their variables.
//!
//! ```text
//! v_B = c + T v_N        B basic, N nonbasic
//! ```
//!
//! A *pivot* exchanges one basic and one nonbasic variable. Pivoting methods start from w = b + A
//! x, where w is basic, and exchange until c satisfies their conditions: with all nonbasic
//! variables at 0, c contains the values of the basic ones. A variable v of limited range can be
//! *mirrored*: it is replaced by its distance from the other end, v' = range − v.

mod exchange;

use crate::kernel::{Width, table::Table};
use crate::linalg::elimination::difference;
use crate::pivot::variable::{Place, Places, Variable};

/// v_B = c + T v_N.
#[derive(Debug, Clone)]
pub(crate) struct Dictionary {
    basic: Vec<Variable>,
    nonbasic: Vec<Variable>,
    places: Places,
    /// c.
    constant: Vec<f64>,
    /// The largest terms in all sums of each constant, to which its rounding errors are
    /// proportional.
    terms: Vec<f64>,
    /// A constant below this fraction of those terms counts as zero, even if it did not cancel in a
    /// single sum.
    pub(crate) cancellation_tolerance: f64,
    /// T.
    table: Table,
}

impl Dictionary {
    /// The dictionary with T = 0.
    pub(crate) fn new(
        basic: Vec<Variable>,
        nonbasic: Vec<Variable>,
        constant: Vec<f64>,
        terms: Vec<f64>,
    ) -> Self {
        let places = Places::of(&basic, &nonbasic);
        let table = Table::zeros(basic.len(), nonbasic.len(), Width::widest());
        Dictionary { basic, nonbasic, places, constant, terms, cancellation_tolerance: 0.0, table }
    }

    /// Sets an entry.
    pub(crate) fn set(&mut self, r: usize, c: usize, value: f64) {
        self.table.set(r, c, value);
    }

    /// The basic variables, one per row.
    pub(crate) fn basic(&self) -> &[Variable] {
        &self.basic
    }

    /// The nonbasic variables, one per column.
    pub(crate) fn nonbasic(&self) -> &[Variable] {
        &self.nonbasic
    }

    /// A hash of the basis: which variables are basic and nonbasic, with their mirrored or original
    /// names. Different bases have different hashes except by coincidence.
    pub(crate) fn basis(&self) -> u64 {
        let basic = self.basic.iter().map(|v| mixed(2 * v.number() as u64));
        let nonbasic = self.nonbasic.iter().map(|v| mixed(2 * v.number() as u64 + 1));
        basic.chain(nonbasic).fold(0, u64::wrapping_add)
    }

    /// c.
    pub(crate) fn constant(&self) -> &[f64] {
        &self.constant
    }

    /// T_rc.
    pub(crate) fn entry(&self, r: usize, c: usize) -> f64 {
        self.table.entry(r, c)
    }

    /// Column c of T: the rate of change of the basic variables while that of column c grows at
    /// rate 1.
    pub(crate) fn column(&self, c: usize) -> Vec<f64> {
        self.table.column(c)
    }

    /// T, row by row.
    pub(crate) fn rows(&self) -> Vec<Vec<f64>> {
        let entry = |r| move |c| self.table.entry(r, c);
        (0..self.basic.len()).map(|r| (0..self.nonbasic.len()).map(entry(r)).collect()).collect()
    }

    /// An entry relative to the largest of its row.
    pub(crate) fn part_of_row(&self, r: usize, c: usize) -> f64 {
        let row = (0..self.nonbasic.len()).map(|c| self.table.entry(r, c).abs());
        let largest = row.fold(0.0, f64::max);
        self.table.entry(r, c).abs() / largest
    }

    /// Exchanges the basic variable of row r and the nonbasic one of column c; T_rc must not be 0.
    ///
    /// ```text
    /// v_c = (v_r − c_r − Σ_{j≠c} T_rj v_j) / T_rc,   put into all other rows
    /// ```
    pub(crate) fn pivot(&mut self, r: usize, c: usize) {
        std::mem::swap(&mut self.basic[r], &mut self.nonbasic[c]);
        self.places.put(self.basic[r], Place::Row(r));
        self.places.put(self.nonbasic[c], Place::Column(c));
        let column = self.table.pivot(r, c);
        let pivot = column[r];
        (self.constant[r], self.terms[r]) =
            (-self.constant[r] / pivot, self.terms[r] / pivot.abs());
        let (constant, terms) = (self.constant[r], self.terms[r]);
        for i in (0..column.len()).filter(|&i| i != r && column[i] != 0.0) {
            self.add(i, column[i] * constant, column[i].abs() * terms);
        }
    }

    /// c_i ← c_i + change, where the change was summed from terms of this size.
    fn add(&mut self, i: usize, change: f64, terms: f64) {
        self.constant[i] = difference(self.constant[i], -change);
        self.terms[i] = self.terms[i].max(terms);
        if self.constant[i].abs() <= self.cancellation_tolerance * self.terms[i] {
            self.constant[i] = 0.0;
        }
    }

    /// Replaces the nonbasic variable v of column c by range − v'; v' is then 0.
    pub(crate) fn mirror_column(&mut self, c: usize, range: f64) {
        let column = self.table.column(c);
        for i in (0..column.len()).filter(|&i| column[i] * range != 0.0) {
            let change = column[i] * range;
            self.add(i, change, change.abs());
        }
        self.table.negate_column(c);
        self.rename(self.nonbasic[c], Place::Column(c));
    }

    /// Replaces the basic variable v of row r by range − v'.
    pub(crate) fn mirror_row(&mut self, r: usize, range: f64) {
        self.constant[r] = -self.constant[r];
        self.add(r, range, range.abs());
        self.table.negate_row(r);
        self.rename(self.basic[r], Place::Row(r));
    }

    /// Replaces a variable by its mirror image, in the same place.
    fn rename(&mut self, variable: Variable, place: Place) {
        let mirrored = variable.mirrored();
        match place {
            Place::Row(r) => self.basic[r] = mirrored,
            Place::Column(c) => self.nonbasic[c] = mirrored,
            Place::Nowhere => {}
        }
        self.places.put(variable, Place::Nowhere);
        self.places.put(mirrored, place);
    }

    /// The dictionary of some of these equations and variables, or their negatives, in this order.
    pub(crate) fn selection(&self, rows: &[RenamedLine], columns: &[RenamedLine]) -> Self {
        let name = |taken: &RenamedLine| taken.name;
        let mut selection = Dictionary::new(
            rows.iter().map(name).collect(),
            columns.iter().map(name).collect(),
            rows.iter().map(|row| row.sign * self.constant[row.index]).collect(),
            rows.iter().map(|row| self.terms[row.index]).collect(),
        );
        for (r, row) in rows.iter().enumerate() {
            for (c, column) in columns.iter().enumerate() {
                let entry = self.table.entry(row.index, column.index);
                selection.set(r, c, row.sign * column.sign * entry);
            }
        }
        selection
    }

    /// The value of a variable while all nonbasic ones are 0.
    pub(crate) fn value(&self, variable: Variable) -> f64 {
        self.row_of(variable).map_or(0.0, |r| self.constant[r])
    }

    /// The rate of change of a variable while the nonbasic one of column c grows at rate 1.
    pub(crate) fn rate(&self, variable: Variable, c: usize) -> f64 {
        match self.places.get(variable) {
            Place::Row(r) => self.table.entry(r, c),
            Place::Column(column) => f64::from(column == c),
            Place::Nowhere => 0.0,
        }
    }

    /// Whether the dictionary contains this variable.
    pub(crate) fn has(&self, variable: Variable) -> bool {
        self.places.get(variable) != Place::Nowhere
    }

    /// The row of a basic variable.
    pub(crate) fn row_of(&self, variable: Variable) -> Option<usize> {
        match self.places.get(variable) {
            Place::Row(r) => Some(r),
            _ => None,
        }
    }

    /// The column of a nonbasic variable.
    pub(crate) fn column_of(&self, variable: Variable) -> Option<usize> {
        match self.places.get(variable) {
            Place::Column(c) => Some(c),
            _ => None,
        }
    }
}

/// A row or column of another dictionary, or its negative, with a new name.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RenamedLine {
    pub(crate) name: Variable,
    pub(crate) index: usize,
    /// 1, or −1 for the negative.
    pub(crate) sign: f64,
}

/// A hash of a number (SplitMix64: Steele, Lea & Flood 2014).
fn mixed(number: u64) -> u64 {
    let mut z = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
