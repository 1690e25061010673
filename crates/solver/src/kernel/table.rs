//! The entries T of a dictionary v_B = c + T v_N, with deferred pivots.
//!
//! A pivot at row r and column c solves row r for the variable of column c and substitutes it into
//! all other rows. With f the old column and ρ the new row,
//!
//! ```text
//! ρ_j = −T_rj / T_rc,   ρ_c = 1 / T_rc
//! T_ij ← T_ij + f_i ρ_j,   T_ic ← 0 + f_i ρ_c        i ≠ r
//! ```
//!
//! There are only two operations per entry, so a pivot of a large table is limited by memory
//! bandwidth. f and ρ are therefore kept until eight pivots can be applied in one pass. A row or
//! column that is needed meanwhile is updated alone. Each entry sees the same operations in the
//! same order as without deferral, so the results are bitwise identical. A sum of which only
//! rounding is left becomes 0, as in [`difference`].

use super::lanes::{Lanes, Width, Work};
use super::rank_one::{Block, add_all, get, put, zeros};
use crate::linalg::elimination::difference;

/// Number of pivots applied in one pass.
const TOGETHER: usize = 8;

/// T, by rows.
#[derive(Debug, Clone)]
pub struct Table {
    rows: usize,
    /// Blocks per row: an odd number, so that the entries of a column map to different cache sets.
    blocks: usize,
    entries: Vec<Block>,
    waiting: Vec<Pivot>,
    width: Width,
}

/// A deferred pivot, which adds f_i ρ_j.
#[derive(Debug, Clone)]
struct Pivot {
    /// f_i, 0 where nothing is left to add.
    factors: Vec<Block>,
    /// ρ_j.
    row: Vec<Block>,
}

impl Table {
    /// A table of zeros.
    pub fn zeros(rows: usize, columns: usize, width: Width) -> Self {
        let blocks = columns.div_ceil(8) | 1;
        let entries = zeros(rows * blocks);
        Table { rows, blocks, entries, waiting: Vec::new(), width }
    }

    /// Sets an entry, regardless of deferred pivots.
    pub fn set(&mut self, r: usize, c: usize, value: f64) {
        self.flush_row(r);
        put(self.row_mut(r), c, value);
    }

    /// T_rc.
    pub fn entry(&self, r: usize, c: usize) -> f64 {
        let waiting = self.waiting.iter().map(|pivot| (get(&pivot.factors, r), get(&pivot.row, c)));
        let due = waiting.filter(|&(factor, _)| factor != 0.0);
        due.fold(self.stored(r, c), |entry, (factor, new)| difference(entry, -factor * new))
    }

    /// Column c.
    pub fn column(&self, c: usize) -> Vec<f64> {
        let mut column = zeros(self.rows.div_ceil(8));
        for r in 0..self.rows {
            put(&mut column, r, self.stored(r, c));
        }
        for pivot in &self.waiting {
            let new = get(&pivot.row, c);
            if new != 0.0 {
                self.width.run(Add { factor: new, x: &pivot.factors, y: &mut column });
            }
        }
        column.iter().flat_map(|block| block.0).take(self.rows).collect()
    }

    /// The pivot at row r and column c, where T must not be 0; returns the old column.
    pub fn pivot(&mut self, r: usize, c: usize) -> Vec<f64> {
        let column = self.column(c);
        self.clear_column(c);
        self.flush_row(r);
        let row = self.row_mut(r);
        put(row, c, -1.0);
        row.iter_mut().flat_map(|block| &mut block.0).for_each(|entry| *entry /= -column[r]);
        let row = row.to_vec();
        let mut factors = zeros(self.rows.div_ceil(8));
        for i in (0..self.rows).filter(|&i| i != r) {
            put(&mut factors, i, column[i]);
        }
        self.waiting.push(Pivot { factors, row });
        if self.waiting.len() == TOGETHER {
            self.flush();
        }
        column
    }

    /// Applies the deferred pivots.
    pub fn flush(&mut self) {
        self.flush_rows(0..self.rows);
        self.waiting.clear();
    }

    /// T_rj ← −T_rj.
    pub fn negate_row(&mut self, r: usize) {
        self.flush_row(r);
        let row = self.row_mut(r);
        row.iter_mut().flat_map(|block| &mut block.0).for_each(|entry| *entry = -*entry);
    }

    /// T_ic ← −T_ic.
    pub fn negate_column(&mut self, c: usize) {
        for r in 0..self.rows {
            let entry = -self.stored(r, c);
            put(self.row_mut(r), c, entry);
        }
        for pivot in &mut self.waiting {
            let entry = -get(&pivot.row, c);
            put(&mut pivot.row, c, entry);
        }
    }

    /// T_ic ← 0, regardless of deferred pivots.
    fn clear_column(&mut self, c: usize) {
        for r in 0..self.rows {
            put(self.row_mut(r), c, 0.0);
        }
        for pivot in &mut self.waiting {
            put(&mut pivot.row, c, 0.0);
        }
    }

    /// T_rc without the deferred pivots.
    fn stored(&self, r: usize, c: usize) -> f64 {
        get(&self.entries[r * self.blocks..], c)
    }

    fn row_mut(&mut self, r: usize) -> &mut [Block] {
        &mut self.entries[r * self.blocks..(r + 1) * self.blocks]
    }

    fn flush_row(&mut self, r: usize) {
        self.flush_rows(r..r + 1);
    }

    fn flush_rows(&mut self, rows: std::ops::Range<usize>) {
        if self.waiting.is_empty() {
            return;
        }
        let (blocks, width) = (self.blocks, self.width);
        let entries = &mut self.entries[rows.start * blocks..rows.end * blocks];
        width.run(Flush { rows, entries, blocks, waiting: &mut self.waiting });
    }
}

/// Applies the deferred pivots to these rows.
struct Flush<'a> {
    rows: std::ops::Range<usize>,
    entries: &'a mut [Block],
    blocks: usize,
    waiting: &'a mut [Pivot],
}

impl Work for Flush<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        for (r, row) in self.rows.zip(self.entries.chunks_exact_mut(self.blocks)) {
            let (mut due, mut count) = ([(0.0, &[][..]); TOGETHER], 0);
            for Pivot { factors, row } in self.waiting.iter_mut() {
                let factor = get(factors, r);
                if factor != 0.0 {
                    put(factors, r, 0.0);
                    due[count] = (factor, row);
                    count += 1;
                }
            }
            add_all::<V>(&due[..count], row);
        }
    }
}

/// y ← y + f x.
struct Add<'a> {
    factor: f64,
    x: &'a [Block],
    y: &'a mut [Block],
}

impl Work for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        add_all::<V>(&[(self.factor, self.x)], self.y);
    }
}
