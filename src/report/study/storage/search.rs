//! What a search looks at, counted: the list, and trees that were filled in three orders.

use schemars::JsonSchema;
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
    /// Built from sorted entries, the middle on top: the best that can be.
    pub balanced: Shape,
}

/// A tree as a search meets it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
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
        sorted: shape(&filled(&(0..n).collect::<Vec<_>>())?)?,
        shuffled: shape(&filled(&shuffled(n, SEED))?)?,
        balanced: shape(&balanced(n)?)?,
    })
}

/// A tree with entries on the diagonal, set in this order.
fn filled(order: &[usize]) -> Result<Tree> {
    let mut tree = Tree::new(order.len(), order.len());
    order.iter().try_for_each(|&i| tree.set(i, i, 1.0))?;
    Ok(tree)
}

fn balanced(n: usize) -> Result<Tree> {
    let mut tree = Tree::new(n, n);
    tree.load(&(0..n).map(|i| (i, i, 1.0)).collect::<Vec<_>>())?;
    Ok(tree)
}

fn shape(tree: &Tree) -> Result<Shape> {
    let n = tree.rows();
    let mut looks = 0;
    for i in 0..n {
        looks += tree.visits(i, i)?;
    }
    Ok(Shape { depth: tree.depth(), visits: looks as f64 / n.max(1) as f64 })
}
