//! A dense matrix, row by row: Codes 8-10.
//!
//! ```text
//! index = column + columns · row
//! ```
//!
//! It takes rows · columns · 8 bytes (4 in the chapter, which uses `float`), whatever the entries
//! are. Code 10's assertions are errors here, and its limit of 500 rows is an option (E50). A
//! matrix without rows is valid: it occurs in a step without constraints (E59). Copies are
//! independent (E51).

use super::{
    Error, Result, Storage, check_entry, check_length, check_place, check_product, check_row,
};

/// A dense matrix, row by row.
///
/// ```
/// use lcplab::storage::{Dense, Storage};
///
/// let a = Dense::from_rows(2, 3, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])?;
/// assert_eq!((a.get(0, 1)?, a.get(1, 0)?), (2.0, 4.0)); // Code 11 reads them the other way round (E53)
/// assert_eq!(Dense::new(100, 100).bytes(), 80_000); // f64; the chapter's float: 40 000
/// let error = Dense::within(500, 4900, 4200).unwrap_err(); // 700 cubes, by Code 10's limit
/// assert_eq!(error.to_string(), "4900 × 4200 is more than the limit of 500 rows or columns");
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Dense {
    rows: usize,
    columns: usize,
    limit: usize,
    values: Vec<f64>,
    allocations: usize,
}

impl Dense {
    /// A zero matrix.
    pub fn new(rows: usize, columns: usize) -> Self {
        let values = vec![0.0; rows * columns];
        let allocations = usize::from(!values.is_empty());
        Dense { rows, columns, limit: usize::MAX, values, allocations }
    }

    /// A zero matrix that may never have more rows or columns than `limit`: an early warning of an
    /// unintended size.
    ///
    /// # Errors
    /// [`Error::TooLarge`], before any memory is allocated.
    pub fn within(limit: usize, rows: usize, columns: usize) -> Result<Self> {
        check_limit(limit, rows, columns)?;
        Ok(Dense { limit, ..Dense::new(rows, columns) })
    }

    /// The matrix with these entries, row by row.
    ///
    /// # Errors
    /// [`Error::Length`] unless there are rows · columns values; [`Error::NotFinite`].
    pub fn from_rows(rows: usize, columns: usize, values: &[f64]) -> Result<Self> {
        check_length("the matrix", values.len(), rows * columns)?;
        let mut dense = Dense::new(rows, columns);
        for (k, &value) in values.iter().enumerate() {
            dense.set(k / columns, k % columns, value)?;
        }
        Ok(dense)
    }

    fn index(&self, row: usize, column: usize) -> usize {
        column + self.columns * row
    }

    /// The numbers of an existing row.
    fn slice(&self, row: usize) -> &[f64] {
        &self.values[row * self.columns..(row + 1) * self.columns]
    }
}

fn check_limit(limit: usize, rows: usize, columns: usize) -> Result<()> {
    if rows.max(columns) > limit { Err(Error::TooLarge { rows, columns, limit }) } else { Ok(()) }
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
        check_limit(self.limit, rows, columns)?;
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

    /// Zeros are multiplied too: a zero term does not change a sum.
    fn multiply(&self, x: &[f64], y: &mut [f64]) -> Result<()> {
        check_product(self.rows, self.columns, x, y)?;
        for (row, y) in y.iter_mut().enumerate() {
            *y = self.slice(row).iter().zip(x).fold(0.0, |sum, (a, x)| sum + a * x);
        }
        Ok(())
    }
}
