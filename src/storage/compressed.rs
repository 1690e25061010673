//! Compressed sparse rows (with faer): columns and values of all entries in two arrays, row by row,
//! and the start of each row.
//!
//! It takes 12 bytes per entry and 4 per row, in three arrays that are read sequentially. Inserting
//! a new entry is expensive, because all later entries move. It is therefore loaded row by row when
//! the pattern is known, and [`set`](Storage::set) is for values.

use faer::sparse::{SparseRowMat, SymbolicSparseRowMat};

use super::{Entry, Result, Storage, check_entry, check_order, check_place, check_row};

/// Compressed sparse rows.
///
/// ```
/// use lcplab::storage::{CompressedRows, Storage};
///
/// let mut a = CompressedRows::new(100, 100);
/// a.load(&(0..100).map(|i| (i, i, 1.0)).collect::<Vec<_>>())?;
/// assert_eq!(a.bytes(), 100 * 12 + 101 * 4);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct CompressedRows {
    rows: usize,
    columns: usize,
    /// `None` only while its arrays are being modified.
    matrix: Option<SparseRowMat<u32, f64>>,
    bytes: usize,
    allocations: usize,
}

/// The three arrays.
#[derive(Default)]
struct Arrays {
    starts: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl CompressedRows {
    /// A zero matrix.
    pub fn new(rows: usize, columns: usize) -> Self {
        let (matrix, bytes, allocations) = (None, 0, 0);
        let mut new = CompressedRows { rows, columns, matrix, bytes, allocations };
        new.change(|arrays| arrays.clear(rows, 0));
        new
    }

    /// Modifies the arrays; counts those that grow.
    fn change(&mut self, change: impl FnOnce(&mut Arrays)) {
        let mut arrays = self.matrix.take().map_or_else(Arrays::default, Arrays::of);
        let before = arrays.capacities();
        change(&mut arrays);
        let grown = before.iter().zip(arrays.capacities()).filter(|(old, new)| *old != new);
        self.allocations += grown.count();
        self.bytes = arrays.bytes();
        arrays.starts.resize(self.rows + 1, arrays.columns.len() as u32);
        let Arrays { starts, columns, values } = arrays;
        let symbolic =
            SymbolicSparseRowMat::new_checked(self.rows, self.columns, starts, None, columns);
        self.matrix = Some(SparseRowMat::new(symbolic, values));
    }

    /// The columns and values of a row, and the index of its first entry.
    fn entries(&self, row: usize) -> (&[u32], &[f64], usize) {
        let Some(matrix) = &self.matrix else { return (&[], &[], 0) };
        let range = matrix.symbolic().row_range(row);
        (&matrix.symbolic().col_idx()[range.clone()], &matrix.val()[range.clone()], range.start)
    }
}

impl Arrays {
    fn of(matrix: SparseRowMat<u32, f64>) -> Self {
        let (symbolic, values) = matrix.into_parts();
        let (_, _, starts, _, columns) = symbolic.into_parts();
        Arrays { starts, columns, values }
    }

    fn capacities(&self) -> [usize; 3] {
        [self.starts.capacity(), self.columns.capacity(), self.values.capacity()]
    }

    fn bytes(&self) -> usize {
        let [starts, columns, values] = self.capacities();
        (starts + columns) * size_of::<u32>() + values * size_of::<f64>()
    }

    /// Clears the arrays and reserves exactly this number of rows and entries.
    fn clear(&mut self, rows: usize, entries: usize) {
        self.starts.clear();
        self.columns.clear();
        self.values.clear();
        self.starts.reserve_exact(rows + 1);
        self.columns.reserve_exact(entries);
        self.values.reserve_exact(entries);
        self.starts.push(0);
    }
}

impl Storage for CompressedRows {
    fn name(&self) -> &'static str {
        "compressed rows"
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn columns(&self) -> usize {
        self.columns
    }

    fn get(&self, row: usize, column: usize) -> Result<f64> {
        let (_, place) = check_place(self, row, column)?;
        let (columns, values, _) = self.entries(row);
        Ok(columns.binary_search(&place).map_or(0.0, |k| values[k]))
    }

    fn set(&mut self, row: usize, column: usize, value: f64) -> Result<()> {
        let (_, place) = check_entry(self, row, column, value)?;
        let (columns, _, start) = self.entries(row);
        match columns.binary_search(&place) {
            Ok(k) if value != 0.0 => {
                if let Some(matrix) = &mut self.matrix {
                    matrix.val_mut()[start + k] = value;
                }
            }
            Ok(k) => self.change(|arrays| {
                arrays.columns.remove(start + k);
                arrays.values.remove(start + k);
                arrays.starts[row + 1..].iter_mut().for_each(|start| *start -= 1);
            }),
            Err(k) if value != 0.0 => self.change(|arrays| {
                arrays.columns.insert(start + k, place);
                arrays.values.insert(start + k, value);
                arrays.starts[row + 1..].iter_mut().for_each(|start| *start += 1);
            }),
            Err(_) => {}
        }
        Ok(())
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()> {
        check_row(self, row)?;
        let (columns, values, _) = self.entries(row);
        columns.iter().zip(values).for_each(|(&column, &value)| visit(column as usize, value));
        Ok(())
    }

    fn reset(&mut self, rows: usize, columns: usize) -> Result<()> {
        (self.rows, self.columns) = (rows, columns);
        self.change(|arrays| arrays.clear(rows, 0));
        Ok(())
    }

    fn stored(&self) -> usize {
        self.matrix.as_ref().map_or(0, |matrix| matrix.val().len())
    }

    fn bytes(&self) -> usize {
        self.bytes
    }

    fn allocations(&self) -> usize {
        self.allocations
    }

    fn load(&mut self, entries: &[Entry]) -> Result<()> {
        check_order(entries)?;
        for &(row, column, value) in entries {
            check_entry(self, row, column, value)?;
        }
        let rows = self.rows;
        self.change(|arrays| {
            arrays.clear(rows, entries.len());
            for &(row, column, value) in entries.iter().filter(|(.., value)| *value != 0.0) {
                // This ends the rows before it.
                arrays.starts.resize(row + 1, arrays.columns.len() as u32);
                arrays.columns.push(column as u32);
                arrays.values.push(value);
            }
        });
        Ok(())
    }
}
