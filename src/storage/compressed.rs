//! Compressed sparse rows: columns and values of all entries in two arrays, row by row, and the
//! start of each row in a third.
//!
//! It takes 12 bytes per entry and 4 per row, in three arrays that are read sequentially. Inserting
//! a new entry would be expensive, because all later entries move.

use super::{Entry, Storage, nonzero};

/// Compressed sparse rows.
///
/// ```
/// use lcplab::storage::{CompressedRows, Storage};
///
/// let a = CompressedRows::of(100, 100, &(0..100).map(|i| (i, i, 1.0)).collect::<Vec<_>>());
/// assert_eq!(a.bytes(), 100 * 12 + 101 * 4);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct CompressedRows {
    starts: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl CompressedRows {
    /// The matrix with these entries, row by row, columns ascending.
    ///
    /// # Panics
    /// If an entry is outside the matrix, out of order, or not finite.
    pub fn of(rows: usize, columns: usize, entries: &[Entry]) -> Self {
        let (count, entries) = nonzero(rows, columns, entries);
        let mut starts = vec![0; rows + 1];
        let (mut columns, mut values) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for (i, j, value) in entries {
            columns.push(j as u32);
            values.push(value);
            starts[i + 1] = columns.len() as u32;
        }
        // A row without entries begins where the row before it ends.
        (1..=rows).for_each(|i| starts[i] = starts[i].max(starts[i - 1]));
        CompressedRows { starts, columns, values }
    }
}

impl Storage for CompressedRows {
    fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) {
        let range = self.starts[row] as usize..self.starts[row + 1] as usize;
        let entries = self.columns[range.clone()].iter().zip(&self.values[range]);
        entries.for_each(|(&column, &value)| visit(column as usize, value));
    }

    fn bytes(&self) -> usize {
        (self.starts.capacity() + self.columns.capacity()) * size_of::<u32>()
            + self.values.capacity() * size_of::<f64>()
    }
}
