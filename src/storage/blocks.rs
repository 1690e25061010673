//! Compressed rows of blocks: 1 × 6, the columns of a body.
//!
//! A row of J belongs to one constraint and touches whole bodies, six columns each, so the natural
//! block is one row high and six wide; a block of 6 × 6 would hold the rows of six constraints, which
//! share a body by chance only. (6 × 6 is the natural block of M⁻¹, whose rows are as wide.) One
//! column number serves six values: 52 bytes a block, 8.7 a value, where compressed rows take 12. Zeros
//! inside a block are kept, so a block with four entries or fewer is dearer than they are.

use super::{
    Entry, Result, Storage, check_entry, check_order, check_place, check_product, check_row,
};

/// Columns of a block: the degrees of freedom of a rigid body.
pub const WIDTH: usize = 6;

/// Block-compressed rows.
///
/// ```
/// use lcplab::storage::{BlockRows, Storage};
///
/// let mut j = BlockRows::new(1, 12); // one constraint, two bodies
/// j.set(0, 1, 1.0)?;
/// j.set(0, 7, -1.0)?;
/// assert_eq!(j.row(0)?, [(1, 1.0), (7, -1.0)]);
/// assert_eq!(j.stored(), 12); // two blocks
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct BlockRows {
    rows: usize,
    columns: usize,
    /// The first block of each row, and the number of all.
    starts: Vec<u32>,
    bodies: Vec<u32>,
    values: Vec<[f64; WIDTH]>,
    allocations: usize,
}

impl BlockRows {
    /// A zero matrix.
    pub fn new(rows: usize, columns: usize) -> Self {
        let (bodies, values) = (Vec::new(), Vec::new());
        BlockRows { rows, columns, starts: vec![0; rows + 1], bodies, values, allocations: 1 }
    }

    /// The blocks (body, values) of a row that the matrix has, bodies ascending.
    pub(super) fn blocks(&self, row: usize) -> impl Iterator<Item = (usize, &[f64; WIDTH])> {
        self.range(row).map(|k| (self.bodies[k] as usize, &self.values[k]))
    }

    /// The numbers of a row's blocks.
    pub(super) fn range(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    /// A block by its number.
    pub(super) fn block(&self, k: usize) -> (usize, &[f64; WIDTH]) {
        (self.bodies[k] as usize, &self.values[k])
    }

    /// Where a row's block is, or where it would go.
    fn position(&self, row: usize, body: u32) -> std::result::Result<usize, usize> {
        let range = self.range(row);
        let found = self.bodies[range.clone()].binary_search(&body);
        found.map(|k| range.start + k).map_err(|k| range.start + k)
    }

    fn capacities(&self) -> [usize; 3] {
        [self.starts.capacity(), self.bodies.capacity(), self.values.capacity()]
    }

    /// Counts the arrays that grew.
    fn count_growth(&mut self, before: [usize; 3]) {
        let after = self.capacities();
        self.allocations += (0..3).filter(|&k| before[k] != after[k]).count();
    }

    /// Ends rows until so many are complete.
    fn end_rows(&mut self, rows: usize) {
        self.starts.resize(rows + 1, self.bodies.len() as u32);
    }
}

/// The body of a column, and the place in its block.
fn split(column: u32) -> (u32, usize) {
    (column / WIDTH as u32, column as usize % WIDTH)
}

impl Storage for BlockRows {
    fn name(&self) -> &'static str {
        "block rows"
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn columns(&self) -> usize {
        self.columns
    }

    fn get(&self, row: usize, column: usize) -> Result<f64> {
        let (body, place) = split(check_place(self, row, column)?.1);
        Ok(self.position(row, body).map_or(0.0, |k| self.values[k][place]))
    }

    fn set(&mut self, row: usize, column: usize, value: f64) -> Result<()> {
        let (body, place) = split(check_entry(self, row, column, value)?.1);
        let before = self.capacities();
        match self.position(row, body) {
            Ok(k) => {
                self.values[k][place] = value;
                if self.values[k].iter().all(|value| *value == 0.0) {
                    self.bodies.remove(k);
                    self.values.remove(k);
                    self.starts[row + 1..].iter_mut().for_each(|start| *start -= 1);
                }
            }
            Err(k) if value != 0.0 => {
                let mut block = [0.0; WIDTH];
                block[place] = value;
                self.bodies.insert(k, body);
                self.values.insert(k, block);
                self.starts[row + 1..].iter_mut().for_each(|start| *start += 1);
            }
            Err(_) => {}
        }
        self.count_growth(before);
        Ok(())
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()> {
        check_row(self, row)?;
        for (body, block) in self.blocks(row) {
            for (place, &value) in block.iter().enumerate().filter(|(_, value)| **value != 0.0) {
                visit(WIDTH * body + place, value);
            }
        }
        Ok(())
    }

    fn reset(&mut self, rows: usize, columns: usize) -> Result<()> {
        let before = self.capacities();
        (self.rows, self.columns) = (rows, columns);
        self.starts.clear();
        self.bodies.clear();
        self.values.clear();
        self.starts.reserve_exact(rows + 1);
        self.end_rows(rows);
        self.count_growth(before);
        Ok(())
    }

    fn stored(&self) -> usize {
        WIDTH * self.values.len()
    }

    fn bytes(&self) -> usize {
        let [starts, bodies, values] = self.capacities();
        (starts + bodies) * size_of::<u32>() + values * size_of::<[f64; WIDTH]>()
    }

    fn allocations(&self) -> usize {
        self.allocations
    }

    fn load(&mut self, entries: &[Entry]) -> Result<()> {
        check_order(entries)?;
        for &(row, column, value) in entries {
            check_entry(self, row, column, value)?;
        }
        let entries = || entries.iter().filter(|(.., value)| *value != 0.0);
        let block_of = |&&(row, column, _): &&Entry| (row, column / WIDTH);
        let first = entries().zip(entries().skip(1)).filter(|(a, b)| block_of(a) != block_of(b));
        let blocks = first.count() + entries().count().min(1);
        let before = self.capacities();
        self.starts.clear();
        self.bodies.clear();
        self.values.clear();
        self.bodies.reserve_exact(blocks);
        self.values.reserve_exact(blocks);
        let mut last = None;
        for entry in entries() {
            let (row, body) = block_of(&entry);
            if last != Some((row, body)) {
                self.end_rows(row);
                self.bodies.push(body as u32);
                self.values.push([0.0; WIDTH]);
                last = Some((row, body));
            }
            if let Some(block) = self.values.last_mut() {
                block[entry.1 % WIDTH] = entry.2;
            }
        }
        self.end_rows(self.rows);
        self.count_growth(before);
        Ok(())
    }

    /// Block by block.
    fn multiply(&self, x: &[f64], y: &mut [f64]) -> Result<()> {
        check_product(self.rows, self.columns, x, y)?;
        for (row, y) in y.iter_mut().enumerate() {
            *y = 0.0;
            for (body, block) in self.blocks(row) {
                *y = block.iter().zip(&x[WIDTH * body..]).fold(*y, |sum, (a, x)| sum + a * x);
            }
        }
        Ok(())
    }
}
