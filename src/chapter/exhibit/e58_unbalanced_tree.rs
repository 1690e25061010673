//! E58: a tree filled in order is a list, section on the binary tree.

use oorandom::Rand64;

use super::{Finding, Measure};
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};

/// An unbalanced binary search tree: the children of each node, left and right.
struct Tree {
    keys: Vec<usize>,
    children: Vec<[Option<usize>; 2]>,
    depths: Vec<usize>,
}

impl Tree {
    fn filled(keys: impl IntoIterator<Item = usize>) -> Self {
        let mut tree = Tree { keys: Vec::new(), children: Vec::new(), depths: Vec::new() };
        keys.into_iter().for_each(|key| tree.insert(key));
        tree
    }

    /// Walks down to the free place for a new key.
    fn insert(&mut self, key: usize) {
        let (mut at, mut parent, mut depth) = ((!self.keys.is_empty()).then_some(0), None, 1);
        while let Some(node) = at {
            let side = usize::from(key > self.keys[node]);
            (parent, at, depth) = (Some((node, side)), self.children[node][side], depth + 1);
        }
        if let Some((node, side)) = parent {
            self.children[node][side] = Some(self.keys.len());
        }
        self.keys.push(key);
        self.children.push([None; 2]);
        self.depths.push(depth);
    }

    /// The number of steps to the deepest entry.
    fn depth(&self) -> usize {
        self.depths.iter().copied().max().unwrap_or(0)
    }

    /// The mean number of steps to an entry.
    fn mean_steps(&self) -> f64 {
        self.depths.iter().sum::<usize>() as f64 / self.depths.len() as f64
    }
}

/// The numbers below n in random order, determined by the seed.
fn shuffled(n: usize, seed: u128) -> Vec<usize> {
    let mut random = Rand64::new(seed);
    let mut keys: Vec<usize> = (0..n).collect();
    for last in (1..n).rev() {
        keys.swap(last, random.rand_range(0..last as u64 + 1) as usize);
    }
    keys
}

/// The numbers from `first` to before `end`, the middle one first, then both halves recursively.
fn halved(first: usize, end: usize) -> Vec<usize> {
    if first == end {
        return Vec::new();
    }
    let middle = first + (end - first) / 2;
    [vec![middle], halved(first, middle), halved(middle + 1, end)].concat()
}

/// The least possible depth of n entries: ⌈log₂(n + 1)⌉.
fn balanced(n: usize) -> f64 {
    ((n + 1) as f64).log2().ceil()
}

pub(super) fn example() -> Result<Finding> {
    let n = 3000;
    let in_order = Tree::filled(0..n);
    // 2 (1 + 1/n) H_n − 3, the mean over all orders; the mean of ten orders is within ±1 of it,
    // five deviations.
    let harmonic = (1..=n).map(|k| 1.0 / k as f64).sum::<f64>();
    let theory = 2.0 * (1.0 + 1.0 / n as f64) * harmonic - 3.0;
    let depth = Measure::new("depth, row by row", "steps", balanced(n), n as f64);
    let mean = Measure::new("mean, row by row", "steps", balanced(n) - 1.0, (n + 1) as f64 / 2.0);
    let measured =
        (1..=10).map(|seed| Tree::filled(shuffled(n, seed)).mean_steps()).sum::<f64>() / 10.0;
    let halving = Tree::filled(halved(0, n)).depth() as f64;
    let halves = Measure::new("depth, by halves", "steps", balanced(n), balanced(n));
    let random = Measure::new("mean, random order", "steps", (n + 1) as f64 / 2.0, theory);
    Ok(Finding::new(
        "3000 indices put into a search tree without balance, the middle one of each part first, row by row, and in \
         ten random orders: the steps to the deepest entry, and to an entry on average. Printed are the figures \
         of a balanced tree, and in the last line that of a list. Corrected: n and (n + 1)/2 for a list, 2 (1 + 1/n) Hₙ − 3 for random \
         order, Hₙ = 1 + 1/2 + … + 1/n. The truth is counted in trees that were built.",
    )
    .measure(halves.truth(&[halving], "counted", 0.0).agreeing())
    .measure(depth.truth(&[in_order.depth() as f64], "counted", 0.0))
    .measure(mean.truth(&[in_order.mean_steps()], "counted", 1e-9))
    .measure(random.truth(&[measured], "counted", 1.0))
    .plot(&drawing()))
}

/// Depth against the number of entries.
fn drawing() -> Lines {
    let sizes = [10, 30, 100, 300, 1000, 3000];
    let curve =
        |depth: &dyn Fn(usize) -> f64| sizes.iter().map(|&n| (n as f64, depth(n))).collect();
    Lines::new(
        "e58",
        "Depth of a plain search tree",
        "Filled row by row the tree is a list, as deep as it has entries; filled \
                 in random order it stays within a small multiple of the least depth, \
                 that of a tree filled by halves.",
        Axis::log("entries", ""),
        Axis::log("depth", "steps"),
        vec![
            Series::measured("row by row", curve(&|n| Tree::filled(0..n).depth() as f64)),
            Series::measured(
                "random order",
                curve(&|n| Tree::filled(shuffled(n, 1)).depth() as f64),
            ),
            Series::measured("by halves", curve(&|n| Tree::filled(halved(0, n)).depth() as f64)),
        ],
    )
}
