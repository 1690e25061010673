//! Compressed sparse rows.

use std::sync::OnceLock;

use dashu_ratio::RBig;

/// Some entries of an n × n matrix, row by row, columns ascending in each row (compressed sparse
/// rows).
#[derive(Debug, Clone)]
pub struct Sparse {
    /// The index of each row's first entry, then the number of entries: n + 1 numbers.
    pub(super) starts: Vec<usize>,
    pub(super) columns: Vec<usize>,
    pub(super) values: Vec<f64>,
    /// For each row the index of a_ii; `None` if it is not stored.
    pub(super) diagonal: Vec<Option<usize>>,
    pub(super) is_symmetric: OnceLock<bool>,
}

impl Sparse {
    /// From sorted entries, no two at the same place.
    pub(super) fn new(n: usize, entries: &[(usize, usize, f64)]) -> Self {
        let mut starts = vec![0; n + 1];
        for &(row, column, _) in entries {
            assert!(row < n && column < n, "entry ({row}, {column}) is outside a {n} × {n} matrix");
            starts[row + 1] += 1;
        }
        for i in 0..n {
            starts[i + 1] += starts[i];
        }
        let mut diagonal = vec![None; n];
        for (k, &(row, column, _)) in entries.iter().enumerate() {
            if row == column {
                diagonal[row] = Some(k);
            }
        }
        let (columns, values) = entries.iter().map(|&(_, column, value)| (column, value)).unzip();
        Sparse { starts, columns, values, diagonal, is_symmetric: OnceLock::new() }
    }

    /// The indices of the entries of row i.
    pub(super) fn row(&self, i: usize) -> std::ops::Range<usize> {
        self.starts[i]..self.starts[i + 1]
    }
}

/// The entries, with those at the same place summed into one. A floating-point sum would depend on
/// their order, and proofs about A would not hold for the file that A came from.
pub(super) fn summed(entries: &[(usize, usize, f64)]) -> Vec<(usize, usize, f64)> {
    let mut entries = entries.to_vec();
    let place = |&(row, col, _): &(usize, usize, f64)| (row, col);
    if entries.is_sorted_by(|a, b| place(a) < place(b)) {
        return entries;
    }
    entries.sort_by_key(place);
    let groups = entries.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
    groups.map(|group| (group[0].0, group[0].1, exact_sum(group))).collect()
}

/// The sum of the values, rounded once; the floating-point sum if not all values are finite.
fn exact_sum(group: &[(usize, usize, f64)]) -> f64 {
    let values = || group.iter().map(|&(_, _, value)| value);
    if let [(_, _, value)] = group {
        return *value;
    }
    let exact = values().try_fold(RBig::ZERO, |sum, value| Some(sum + RBig::try_from(value).ok()?));
    exact.map_or_else(|| values().sum(), |sum| sum.to_f64().value())
}
