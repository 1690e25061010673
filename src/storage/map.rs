//! A sorted map of rows, each a sorted map of columns: Code 11, corrected.
//!
//! K&M call the format compressed rows, as in MATLAB; it is a dictionary of keys, and MATLAB
//! compresses columns (E56).
//!
//! A row takes a node of 144 bytes for up to 11 entries, which is 13 bytes per entry in a full node
//! and 144 for a single one, plus a share of a node of 320 bytes for the row's map. Finding an
//! entry takes about log₂(rows) + log₂(entries of the row) comparisons.

use std::collections::BTreeMap;

use super::{Entry, Storage, nonzero};

type Row = BTreeMap<u32, f64>;

/// A map of rows, each a map of columns.
///
/// ```
/// use lcplab::storage::{MapOfMaps, Storage};
///
/// let entry = |k: usize| (k / 3, k % 3, if k / 3 == k % 3 { 1.0 } else { 0.0 });
/// let a = MapOfMaps::of(3, 3, &(0..9).map(entry).collect::<Vec<_>>());
/// assert_eq!(a.row(1), [(1, 1.0)]); // Code 11 keeps the zeros, too
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MapOfMaps {
    rows: usize,
    map: BTreeMap<u32, Row>,
}

impl MapOfMaps {
    /// The matrix with these entries, row by row, columns ascending.
    ///
    /// # Panics
    /// If an entry is outside the matrix, out of order, or not finite.
    pub fn of(rows: usize, columns: usize, entries: &[Entry]) -> Self {
        let mut map: BTreeMap<u32, Row> = BTreeMap::new();
        for (i, j, value) in nonzero(rows, columns, entries).1 {
            map.entry(i as u32).or_default().insert(j as u32, value);
        }
        MapOfMaps { rows, map }
    }
}

impl Storage for MapOfMaps {
    fn rows(&self) -> usize {
        self.rows
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) {
        let entries = self.map.get(&(row as u32)).into_iter().flatten();
        entries.for_each(|(&column, &value)| visit(column as usize, value));
    }

    fn bytes(&self) -> usize {
        let rows = self.map.values().map(|row| bytes::<u32, f64>(row.len()));
        bytes::<u32, Row>(self.map.len()) + rows.sum::<usize>()
    }
}

/// The number of pairs that fit into a node.
const ROOM: usize = 11;

/// The bytes of a sorted map of the standard library with this number of pairs of K and V, set in
/// ascending order.
///
/// A B-tree node has room for 11 pairs, and for 12 links to child nodes unless it is a leaf. Pairs
/// in ascending order fill the rightmost leaf; the 12th splits it: 6 stay, one moves up, 5 begin
/// the next leaf, which is full 6 pairs later. Therefore, level by level from the leaves,
///
/// ```text
/// nodes(k) = 1 + ⌊(k − 5) / 7⌋  for k ≥ 12 pairs,  1 below;    pairs above = nodes − 1
/// ```
fn bytes<K, V>(mut pairs: usize) -> usize {
    // The pointer to the parent node, the index in it, the number of pairs.
    let header = size_of::<usize>() + 2 * size_of::<u16>();
    let leaf = header + ROOM * (size_of::<K>() + size_of::<V>());
    let align = align_of::<usize>().max(align_of::<K>()).max(align_of::<V>());
    let leaf = leaf.next_multiple_of(align);
    let (mut bytes, mut node) = (0, leaf);
    while pairs > 0 {
        let nodes = if pairs > ROOM { 1 + (pairs - 5) / 7 } else { 1 };
        bytes += nodes * node;
        pairs = nodes - 1;
        node = leaf + (ROOM + 1) * size_of::<usize>();
    }
    bytes
}
