//! A dense matrix, row by row: Codes 8-10.
//!
//! ```text
//! index = column + columns · row
//! ```
//!
//! It takes rows · columns · 8 bytes (4 in the chapter, which uses `float`), whatever the entries
//! are. Code 10's assertions are errors here, and there is no limit of 500 rows (E50). A matrix
//! without rows is valid: it occurs in a step without constraints (E59). Copies are independent
//! (E51).

use super::{Result, Storage, check_entry, check_place, check_row};

/// A dense matrix, row by row.
///
/// ```
/// use lcplab::storage::{Dense, Storage};
///
/// let a = Dense::new(100, 100);
/// assert_eq!(a.bytes(), 80_000); // f64; the chapter's float: 40,000
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Dense {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
    allocations: usize,
}

impl Dense {
    /// A zero matrix.
    pub fn new(rows: usize, columns: usize) -> Self {
        let values = vec![0.0; rows * columns];
        let allocations = usize::from(!values.is_empty());
        Dense { rows, columns, values, allocations }
    }

    fn index(&self, row: usize, column: usize) -> usize {
        column + self.columns * row
    }

    /// The numbers of an existing row.
    fn slice(&self, row: usize) -> &[f64] {
        &self.values[row * self.columns..(row + 1) * self.columns]
    }
}

impl Storage for Dense {
    fn name(&self) -> &'static str {
        "dense"
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn columns(&self) -> usize {
        self.columns
    }

    fn get(&self, row: usize, column: usize) -> Result<f64> {
        check_place(self, row, column)?;
        Ok(self.values[self.index(row, column)])
    }

    fn set(&mut self, row: usize, column: usize, value: f64) -> Result<()> {
        check_entry(self, row, column, value)?;
        let index = self.index(row, column);
        self.values[index] = value;
        Ok(())
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()> {
        check_row(self, row)?;
        for (column, &value) in self.slice(row).iter().enumerate() {
            if value != 0.0 {
                visit(column, value);
            }
        }
        Ok(())
    }

    fn reset(&mut self, rows: usize, columns: usize) -> Result<()> {
        (self.rows, self.columns) = (rows, columns);
        self.allocations += usize::from(rows * columns > self.values.capacity());
        self.values.clear();
        self.values.resize(rows * columns, 0.0);
        Ok(())
    }

    fn stored(&self) -> usize {
        self.values.len()
    }

    fn bytes(&self) -> usize {
        self.values.capacity() * size_of::<f64>()
    }

    fn allocations(&self) -> usize {
        self.allocations
    }
}
