//! Entries in a binary search tree by row and column, which nobody balances as they come.
//!
//! A search goes left or right at each node and ends after at most *depth* of them. That is a drastic
//! speed-up over the list only while the tree is bushy: entries set in random order give a depth of
//! about 2 to 3 log₂ k, entries set in the order of their indices, the order in which an assembly makes
//! them, give a tree without left branches, a list again with depth k (E58). The remedy is a tree that
//! keeps itself balanced, [`BalancedTree`](super::BalancedTree), or entries that come all at once, which
//! [`load`](Storage::load) builds into a balanced one.
//!
//! A node takes 24 bytes: 4 each for row, column and two branches, 8 for the value.

use std::cmp::Ordering;

use super::slots::{NONE, Slots};
use super::{Entry, Result, Storage, check_entry, check_order, check_place, check_row};

#[derive(Debug, Clone, PartialEq)]
struct Node {
    place: (u32, u32),
    value: f64,
    left: u32,
    right: u32,
}

/// A binary search tree of entries.
///
/// ```
/// use lcplab::storage::{Storage, Tree};
///
/// let (mut sorted, mut mixed) = (Tree::new(7, 7), Tree::new(7, 7));
/// for i in 0..7 {
///     sorted.set(i, i, 1.0)?;
///     let i = [3, 1, 5, 0, 2, 4, 6][i];
///     mixed.set(i, i, 1.0)?;
/// }
/// assert_eq!((sorted.depth(), mixed.depth()), (7, 3));
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Tree {
    rows: usize,
    columns: usize,
    nodes: Slots<Node>,
    root: u32,
}

impl Tree {
    /// Bytes that each entry takes.
    pub const BYTES_AN_ENTRY: usize = size_of::<Node>();

    /// A zero matrix.
    pub fn new(rows: usize, columns: usize) -> Self {
        Tree { rows, columns, nodes: Slots::default(), root: NONE }
    }

    /// The number of nodes on the longest way down; 0 for an empty tree.
    pub fn depth(&self) -> usize {
        let mut deepest = 0;
        let mut open = vec![(self.root, 1)];
        while let Some((slot, depth)) = open.pop() {
            if let Some(node) = self.nodes.at(slot) {
                deepest = deepest.max(depth);
                open.extend([(node.left, depth + 1), (node.right, depth + 1)]);
            }
        }
        deepest
    }

    /// How many nodes [`get`](Storage::get) looks at.
    ///
    /// # Errors
    /// [`Error::Outside`](super::Error::Outside).
    pub fn visits(&self, row: usize, column: usize) -> Result<usize> {
        let place = check_place(self, row, column)?;
        let (mut visits, mut slot) = (0, self.root);
        while let Some(node) = self.nodes.at(slot) {
            visits += 1;
            slot = match place.cmp(&node.place) {
                Ordering::Less => node.left,
                Ordering::Equal => break,
                Ordering::Greater => node.right,
            };
        }
        Ok(visits)
    }

    /// A balanced tree of entries that the matrix has, and its root.
    fn build(&mut self, entries: &[Entry]) -> u32 {
        let Some(&(row, column, value)) = entries.get(entries.len() / 2) else { return NONE };
        let (before, after) = entries.split_at(entries.len() / 2);
        let (left, right) = (self.build(before), self.build(&after[1..]));
        self.nodes.add(Node { place: (row as u32, column as u32), value, left, right })
    }

    /// The node at a place or [`NONE`], and the one above.
    fn find(&self, place: (u32, u32)) -> (u32, u32) {
        let (mut above, mut slot) = (NONE, self.root);
        while let Some(node) = self.nodes.at(slot) {
            let next = match place.cmp(&node.place) {
                Ordering::Less => node.left,
                Ordering::Equal => break,
                Ordering::Greater => node.right,
            };
            (above, slot) = (slot, next);
        }
        (slot, above)
    }

    /// The first node at this place or after it.
    fn first_from(&self, place: (u32, u32)) -> Option<&Node> {
        let (mut first, mut slot) = (None, self.root);
        while let Some(node) = self.nodes.at(slot) {
            match place.cmp(&node.place) {
                Ordering::Less => (first, slot) = (Some(node), node.left),
                Ordering::Equal => return Some(node),
                Ordering::Greater => slot = node.right,
            }
        }
        first
    }

    /// Hangs a new node below `above`.
    fn attach(&mut self, above: u32, slot: u32, place: (u32, u32)) {
        match self.nodes.at_mut(above) {
            None => self.root = slot,
            Some(node) if place < node.place => node.left = slot,
            Some(node) => node.right = slot,
        }
    }

    /// Takes a node out; of two branches, the next node in order takes its place.
    fn remove(&mut self, slot: u32, above: u32) {
        let (left, right) = self.branches(slot);
        let heir = match (left, right) {
            (NONE, only) | (only, NONE) => only,
            _ => self.take_least(slot, right),
        };
        if heir != NONE && left != NONE && right != NONE {
            let rest = self.branches(slot).1;
            if let Some(node) = self.nodes.at_mut(heir) {
                (node.left, node.right) = (left, rest);
            }
        }
        self.replace(above, slot, heir);
        self.nodes.remove(slot);
    }

    /// Unhooks the least node of the branch right of `above` and returns it.
    fn take_least(&mut self, above: u32, right: u32) -> u32 {
        let (mut parent, mut least) = (above, right);
        while self.branches(least).0 != NONE {
            (parent, least) = (least, self.branches(least).0);
        }
        let rest = self.branches(least).1;
        self.replace(parent, least, rest);
        least
    }

    /// Hangs `new` where `old` hung.
    fn replace(&mut self, above: u32, old: u32, new: u32) {
        match self.nodes.at_mut(above) {
            None => self.root = new,
            Some(node) if node.left == old => node.left = new,
            Some(node) => node.right = new,
        }
    }

    fn branches(&self, slot: u32) -> (u32, u32) {
        self.nodes.at(slot).map_or((NONE, NONE), |node| (node.left, node.right))
    }
}

impl Storage for Tree {
    fn name(&self) -> &'static str {
        "tree"
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn columns(&self) -> usize {
        self.columns
    }

    fn get(&self, row: usize, column: usize) -> Result<f64> {
        let place = check_place(self, row, column)?;
        Ok(self.nodes.at(self.find(place).0).map_or(0.0, |node| node.value))
    }

    fn set(&mut self, row: usize, column: usize, value: f64) -> Result<()> {
        let place = check_entry(self, row, column, value)?;
        let (slot, above) = self.find(place);
        if slot != NONE && value == 0.0 {
            self.remove(slot, above);
        } else if let Some(node) = self.nodes.at_mut(slot) {
            node.value = value;
        } else if value != 0.0 {
            let slot = self.nodes.add(Node { place, value, left: NONE, right: NONE });
            self.attach(above, slot, place);
        }
        Ok(())
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()> {
        let row = check_row(self, row)?;
        let mut next = self.first_from((row, 0));
        while let Some(node) = next.filter(|node| node.place.0 == row) {
            let column = node.place.1;
            visit(column as usize, node.value);
            next = column.checked_add(1).and_then(|column| self.first_from((row, column)));
        }
        Ok(())
    }

    fn reset(&mut self, rows: usize, columns: usize) -> Result<()> {
        self.nodes.clear();
        (self.rows, self.columns, self.root) = (rows, columns, NONE);
        Ok(())
    }

    fn stored(&self) -> usize {
        self.nodes.len()
    }

    fn bytes(&self) -> usize {
        self.nodes.bytes()
    }

    fn allocations(&self) -> usize {
        self.nodes.allocations()
    }

    /// Entries that come sorted and at once are built into a balanced tree: the middle one on top, then
    /// the middles of the halves.
    fn load(&mut self, entries: &[Entry]) -> Result<()> {
        check_order(entries)?;
        for &(row, column, value) in entries {
            check_entry(self, row, column, value)?;
        }
        self.reset(self.rows, self.columns)?;
        self.nodes.reserve(entries.len());
        if entries.iter().all(|(.., value)| *value != 0.0) {
            self.root = self.build(entries);
            return Ok(());
        }
        entries.iter().try_for_each(|&(row, column, value)| self.set(row, column, value))
    }
}
