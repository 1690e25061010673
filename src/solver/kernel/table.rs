//! The entries T of a dictionary v_B = c + T v_N, and pivots that wait for each other.
//!
//! A pivot at row r and column c solves row r for the variable of column c and puts it into all other
//! rows. With f the column as it was, and ρ the new row,
//!
//! ```text
//! ρ_j = −T_rj / T_rc,       ρ_c = 1 / T_rc
//! T_ij ← T_ij + f_i ρ_j,   T_ic ← f_i ρ_c        i ≠ r
//! ```
//!
//! Two operations an entry: a large table spends the time of a pivot on its way through memory. So
//! f and ρ are put aside until eight pivots can be made on the way. A row or a column that is asked
//! for meanwhile is brought up to date alone. Each entry sees the same operations in the same order
//! as if no pivot waited, so the bits are the same; and a sum of which only rounding is left is 0, as in
//! [`difference`].

use super::lanes::{Lanes, Width, Work, sum};
use super::rank_one::{Block, add, add_all, add_multiple};
use crate::solver::elimination::difference;

/// Pivots that are made in one pass.
const TOGETHER: usize = 8;

/// T, by rows.
#[derive(Debug, Clone)]
pub struct Table {
    rows: usize,
    columns: usize,
    /// Blocks to a row: an odd number, so that the entries of a column share no set of the cache.
    blocks: usize,
    entries: Vec<Block>,
    waiting: Vec<Pivot>,
    width: Width,
}

/// What a pivot adds: f_i ρ_j.
#[derive(Debug, Clone)]
struct Pivot {
    /// f_i, 0 where nothing is to be added any more.
    factors: Vec<f64>,
    /// ρ_j, 0 where nothing is to be added any more.
    row: Vec<Block>,
}

impl Table {
    /// A table of zeros.
    pub fn zeros(rows: usize, columns: usize, width: Width) -> Self {
        let blocks = columns.div_ceil(8) | 1;
        let entries = zeros(rows * blocks);
        Table { rows, columns, blocks, entries, waiting: Vec::new(), width }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Gives some entries (column, value) of a row other values.
    pub fn set(&mut self, r: usize, entries: impl Iterator<Item = (usize, f64)>) {
        self.settle_row(r);
        let row = self.row_mut(r);
        entries.for_each(|(c, value)| put(row, c, value));
    }

    /// T_rc.
    pub fn entry(&self, r: usize, c: usize) -> f64 {
        let waiting = self.waiting.iter().map(|pivot| (pivot.factors[r], get(&pivot.row, c)));
        let due = waiting.filter(|&(factor, _)| factor != 0.0);
        due.fold(self.stored(r, c), |entry, (factor, new)| difference(entry, -factor * new))
    }

    /// Row r.
    pub fn row(&mut self, r: usize) -> impl Iterator<Item = f64> {
        self.settle_row(r);
        let row = &self.entries[r * self.blocks..(r + 1) * self.blocks];
        row.iter().flat_map(|block| block.0).take(self.columns)
    }

    /// Column c.
    pub fn column(&self, c: usize) -> Vec<f64> {
        let mut column: Vec<f64> = (0..self.rows).map(|r| self.stored(r, c)).collect();
        for pivot in &self.waiting {
            let new = get(&pivot.row, c);
            if new != 0.0 {
                add_multiple(new, &pivot.factors, &mut column, self.width);
            }
        }
        column
    }

    /// T v, for a v with an entry a column.
    pub fn product(&mut self, v: &[f64]) -> Vec<f64> {
        self.settle();
        let mut blocks = zeros(self.blocks);
        (0..self.columns).for_each(|c| put(&mut blocks, c, v[c]));
        self.width.run(Product { rows: self.entries.chunks_exact(self.blocks), v: &blocks })
    }

    /// The pivot at row r and column c, where T is not 0; returns the column as it was.
    pub fn pivot(&mut self, r: usize, c: usize) -> Vec<f64> {
        let column = self.column(c);
        let mut row = self.solved_row(r, c, column[r]);
        let last = get(&row, c);
        for i in (0..self.rows).filter(|&i| i != r) {
            put(self.row_mut(i), c, column[i] * last);
        }
        self.waiting.iter_mut().for_each(|pivot| put(&mut pivot.row, c, 0.0));
        put(&mut row, c, 0.0);
        let mut factors = column.clone();
        factors[r] = 0.0;
        self.waiting.push(Pivot { factors, row });
        if self.waiting.len() == TOGETHER {
            self.settle();
        }
        column
    }

    /// Makes row r what it is after a pivot in column c, and returns it.
    fn solved_row(&mut self, r: usize, c: usize, pivot: f64) -> Vec<Block> {
        self.settle_row(r);
        let row = self.row_mut(r);
        put(row, c, -1.0);
        for block in row.iter_mut() {
            block.0 = block.0.map(|entry| entry / -pivot);
        }
        row.to_vec()
    }

    /// Makes the pivots that wait.
    pub fn settle(&mut self) {
        self.settle_rows(0..self.rows);
        self.waiting.clear();
    }

    /// T_rj ← −T_rj.
    pub fn negate_row(&mut self, r: usize) {
        self.settle_row(r);
        for block in self.row_mut(r) {
            block.0 = block.0.map(|entry| -entry);
        }
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

    /// T_rc without the pivots that wait.
    fn stored(&self, r: usize, c: usize) -> f64 {
        get(&self.entries[r * self.blocks..], c)
    }

    fn row_mut(&mut self, r: usize) -> &mut [Block] {
        &mut self.entries[r * self.blocks..(r + 1) * self.blocks]
    }

    fn settle_row(&mut self, r: usize) {
        self.settle_rows(r..r + 1);
        self.waiting.iter_mut().for_each(|pivot| pivot.factors[r] = 0.0);
    }

    fn settle_rows(&mut self, rows: std::ops::Range<usize>) {
        if self.waiting.is_empty() {
            return;
        }
        let (blocks, width) = (self.blocks, self.width);
        let entries = &mut self.entries[rows.start * blocks..rows.end * blocks];
        width.run(Settle { rows, entries, blocks, waiting: &self.waiting });
    }
}

/// Makes the pivots that wait for these rows.
struct Settle<'a> {
    rows: std::ops::Range<usize>,
    entries: &'a mut [Block],
    blocks: usize,
    waiting: &'a [Pivot],
}

impl Work for Settle<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        for (r, row) in self.rows.zip(self.entries.chunks_exact_mut(self.blocks)) {
            let (pivots, rest) = self.waiting.as_chunks::<TOGETHER>();
            for pivots in pivots {
                let factors = pivots.each_ref().map(|pivot| pivot.factors[r]);
                if factors.contains(&0.0) {
                    each::<V>(pivots, r, row);
                } else {
                    let x = pivots.each_ref().map(|pivot| &pivot.row[..row.len()]);
                    add_all::<V, TOGETHER>(factors, x, row);
                }
            }
            each::<V>(rest, r, row);
        }
    }
}

/// Makes pivots for a row one by one, as far as they do anything.
#[inline(always)]
fn each<V: Lanes>(pivots: &[Pivot], r: usize, row: &mut [Block]) {
    for pivot in pivots {
        let factor = pivot.factors[r];
        if factor != 0.0 {
            add::<V>(factor, &pivot.row, row);
        }
    }
}

/// The product of each row with v.
struct Product<'a> {
    rows: std::slice::ChunksExact<'a, Block>,
    v: &'a [Block],
}

impl Work for Product<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn run<V: Lanes>(self) -> Vec<f64> {
        let mut products = Vec::with_capacity(self.rows.len());
        for row in self.rows {
            let mut lanes = V::splat(0.0);
            for (entry, v) in row.iter().zip(self.v) {
                lanes = lanes + V::load(&entry.0) * V::load(&v.0);
            }
            products.push(sum(lanes.to_array()));
        }
        products
    }
}

fn zeros(blocks: usize) -> Vec<Block> {
    vec![Block([0.0; 8]); blocks]
}

#[inline(always)]
fn get(blocks: &[Block], k: usize) -> f64 {
    blocks[k / 8].0[k % 8]
}

#[inline(always)]
fn put(blocks: &mut [Block], k: usize, value: f64) {
    blocks[k / 8].0[k % 8] = value;
}
