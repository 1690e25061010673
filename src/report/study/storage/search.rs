//! What a search looks at, counted: the list, and trees that were filled in three orders.

use serde::{Deserialize, Serialize};

use super::{SEED, shuffled};
use crate::error::Result;
use crate::storage::{LinkedList, Storage, Tree};

/// Searches for every entry of a matrix.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Search {
    /// Entries.
    pub entries: usize,
    /// Entries of the list that a search looks at, the mean.
    pub list: f64,
    /// A tree that was filled in the order of the indices.
    pub sorted: Shape,
    /// In a random order.
    pub shuffled: Shape,
    /// The middle first, then the middles of the halves, and so on: the best that can be.
    pub balanced: Shape,
}

/// A tree as a search meets it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Shape {
    /// Nodes on the longest way down.
    pub depth: usize,
    /// Nodes that a search looks at, the mean over all entries.
    pub visits: f64,
}

/// Searches matrices with so many entries on the diagonal.
///
/// # Errors
/// None: the places exist.
pub fn run(entries: &[usize]) -> Result<Vec<Search>> {
    entries.iter().map(|&n| search(n)).collect()
}

fn search(n: usize) -> Result<Search> {
    let mut list = LinkedList::new(n, n);
    let mut looks = 0;
    (0..n).try_for_each(|i| list.set(i, i, 1.0))?;
    for i in 0..n {
        looks += list.visits(i, i)?;
    }
    Ok(Search {
        entries: n,
        list: looks as f64 / n.max(1) as f64,
        sorted: shape(&(0..n).collect::<Vec<_>>())?,
        shuffled: shape(&shuffled(n, SEED))?,
        balanced: shape(&middle_first(n))?,
    })
}

fn shape(order: &[usize]) -> Result<Shape> {
    let n = order.len();
    let mut tree = Tree::new(n, n);
    order.iter().try_for_each(|&i| tree.set(i, i, 1.0))?;
    let mut looks = 0;
    for i in 0..n {
        looks += tree.visits(i, i)?;
    }
    Ok(Shape { depth: tree.depth(), visits: looks as f64 / n.max(1) as f64 })
}

/// The numbers 0..n, the middle of each part before the rest of it.
pub(super) fn middle_first(n: usize) -> Vec<usize> {
    let mut order = Vec::with_capacity(n);
    let mut parts = std::collections::VecDeque::from([(0, n)]);
    while let Some((from, to)) = parts.pop_front() {
        if from < to {
            let middle = usize::midpoint(from, to);
            order.push(middle);
            parts.extend([(from, middle), (middle + 1, to)]);
        }
    }
    order
}
