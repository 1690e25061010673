//! A sorted map of rows, each a sorted map of columns: Code 11, corrected.
//!
//! Corrections: `clear` instead of the printed `empty`, which clears nothing (E52); numbers are
//! read row by row as in Code 10 (E53); zeros are removed (E54). K&M call the format compressed
//! rows, as in MATLAB; it is a dictionary of keys, and MATLAB compresses columns (E56).
//!
//! A row takes a node of 144 bytes for up to 11 entries, which is 13 bytes per entry in a full node
//! and 144 for a single one, plus a share of a node of 320 bytes for the row's map. Finding an
//! entry takes about log₂(rows) + log₂(entries of the row) comparisons. Nodes cannot be kept for
//! the next step.

use std::collections::BTreeMap;

use super::{Result, Storage, check_entry, check_place, check_row, nodes};

type Row = BTreeMap<u32, f64>;

/// A map of rows, each a map of columns.
///
/// ```
/// use lcplab::storage::{MapOfMaps, Storage};
///
/// let mut a = MapOfMaps::new(3, 3);
/// for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
///     a.set(i, j, if i == j { 1.0 } else { 0.0 })?;
/// }
/// assert_eq!(a.stored(), 3); // Code 11 keeps 9
/// a.set(1, 1, 0.0)?;
/// assert_eq!((a.stored(), a.row(1)?), (2, vec![]));
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MapOfMaps {
    rows: usize,
    columns: usize,
    map: BTreeMap<u32, Row>,
    stored: usize,
    /// The number of freed nodes.
    gone: usize,
}

impl MapOfMaps {
    /// A zero matrix.
    pub fn new(rows: usize, columns: usize) -> Self {
        MapOfMaps { rows, columns, map: BTreeMap::new(), stored: 0, gone: 0 }
    }

    fn nodes(&self) -> usize {
        let count = |pairs| {
            let (leaves, inner) = nodes::nodes(pairs);
            leaves + inner
        };
        count(self.map.len()) + self.map.values().map(|row| count(row.len())).sum::<usize>()
    }
}

impl Storage for MapOfMaps {
    fn name(&self) -> &'static str {
        "map of maps"
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn columns(&self) -> usize {
        self.columns
    }

    fn get(&self, row: usize, column: usize) -> Result<f64> {
        let (row, column) = check_place(self, row, column)?;
        Ok(self.map.get(&row).and_then(|row| row.get(&column)).copied().unwrap_or(0.0))
    }

    fn set(&mut self, row: usize, column: usize, value: f64) -> Result<()> {
        let (row, column) = check_entry(self, row, column, value)?;
        if value != 0.0 {
            let before = self.map.entry(row).or_default().insert(column, value);
            self.stored += usize::from(before.is_none());
        } else if let Some(entries) = self.map.get_mut(&row) {
            self.stored -= usize::from(entries.remove(&column).is_some());
            if entries.is_empty() {
                self.map.remove(&row);
            }
        }
        Ok(())
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()> {
        let row = check_row(self, row)?;
        let entries = self.map.get(&row).into_iter().flatten();
        entries.for_each(|(&column, &value)| visit(column as usize, value));
        Ok(())
    }

    fn reset(&mut self, rows: usize, columns: usize) -> Result<()> {
        self.gone += self.nodes();
        self.map.clear();
        (self.rows, self.columns, self.stored) = (rows, columns, 0);
        Ok(())
    }

    fn stored(&self) -> usize {
        self.stored
    }

    /// Exact for entries that were set in ascending order, as assembly does; within about a quarter
    /// for other orders.
    fn bytes(&self) -> usize {
        let rows = self.map.values().map(|row| nodes::bytes::<u32, f64>(row.len()));
        nodes::bytes::<u32, Row>(self.map.len()) + rows.sum::<usize>()
    }

    /// The number of nodes; as exact as [`bytes`](Storage::bytes).
    fn allocations(&self) -> usize {
        self.gone + self.nodes()
    }
}
