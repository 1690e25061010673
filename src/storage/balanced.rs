//! Entries in one sorted map by row and column: the remedy for a tree that degenerates (E58).
//!
//! The standard library's map is a B-tree: up to 11 entries a node, all leaves equally deep, whatever
//! the order they come in. A node of 192 bytes is 17.5 bytes an entry if full; entries that come in
//! order leave it about half full.

use std::collections::BTreeMap;

use super::{Result, Storage, check_entry, check_place, check_row, nodes};

type Place = (u32, u32);

/// A sorted map of entries.
#[derive(Debug, Clone, PartialEq)]
pub struct BalancedTree {
    rows: usize,
    columns: usize,
    entries: BTreeMap<Place, f64>,
    /// Nodes that were given back.
    gone: usize,
}

impl BalancedTree {
    /// A zero matrix.
    pub fn new(rows: usize, columns: usize) -> Self {
        BalancedTree { rows, columns, entries: BTreeMap::new(), gone: 0 }
    }

    fn nodes(&self) -> usize {
        let (leaves, inner) = nodes::nodes(self.entries.len());
        leaves + inner
    }
}

impl Storage for BalancedTree {
    fn name(&self) -> &'static str {
        "B-tree"
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn columns(&self) -> usize {
        self.columns
    }

    fn get(&self, row: usize, column: usize) -> Result<f64> {
        let place = check_place(self, row, column)?;
        Ok(self.entries.get(&place).copied().unwrap_or(0.0))
    }

    fn set(&mut self, row: usize, column: usize, value: f64) -> Result<()> {
        let place = check_entry(self, row, column, value)?;
        if value == 0.0 {
            self.entries.remove(&place);
        } else {
            self.entries.insert(place, value);
        }
        Ok(())
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()> {
        let row = check_row(self, row)?;
        let entries = self.entries.range((row, 0)..=(row, u32::MAX));
        entries.for_each(|(&(_, column), &value)| visit(column as usize, value));
        Ok(())
    }

    fn reset(&mut self, rows: usize, columns: usize) -> Result<()> {
        self.gone += self.nodes();
        self.entries.clear();
        (self.rows, self.columns) = (rows, columns);
        Ok(())
    }

    fn stored(&self) -> usize {
        self.entries.len()
    }

    /// Exact for entries that were set in ascending order; within about a quarter for other orders.
    fn bytes(&self) -> usize {
        nodes::bytes::<Place, f64>(self.entries.len())
    }

    /// Nodes; exact as [`bytes`](Storage::bytes) is.
    fn allocations(&self) -> usize {
        self.gone + self.nodes()
    }
}
