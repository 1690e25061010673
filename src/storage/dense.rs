//! A dense matrix, row by row: Codes 8-10.
//!
//! ```text
//! index = column + columns · row
//! ```
//!
//! It takes rows · columns · 8 bytes (4 in the chapter, which uses `float`), whatever the entries
//! are. There is no limit of 500 rows (E50). A matrix without rows is valid: it occurs in a step
//! without constraints (E59).

use super::{Entry, Storage, nonzero};

/// A dense matrix, row by row.
///
/// ```
/// use lcplab::storage::{Dense, Storage};
///
/// let a = Dense::of(100, 100, &[]);
/// assert_eq!(a.bytes(), 80_000); // f64; the chapter's float: 40,000
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Dense {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
}

impl Dense {
    /// The matrix with these entries, row by row, columns ascending.
    ///
    /// # Panics
    /// If an entry is outside the matrix, out of order, or not finite.
    pub fn of(rows: usize, columns: usize, entries: &[Entry]) -> Self {
        let mut values = vec![0.0; rows * columns];
        for (i, j, value) in nonzero(rows, columns, entries).1 {
            values[j + columns * i] = value;
        }
        Dense { rows, columns, values }
    }
}

impl Storage for Dense {
    fn rows(&self) -> usize {
        self.rows
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) {
        let values = &self.values[row * self.columns..(row + 1) * self.columns];
        let entries = values.iter().enumerate().filter(|(_, value)| **value != 0.0);
        entries.for_each(|(column, &value)| visit(column, value));
    }

    fn bytes(&self) -> usize {
        self.values.capacity() * size_of::<f64>()
    }
}
