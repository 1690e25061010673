//! E56: the names of storage formats, section on the map of maps.

use faer::sparse::{SparseColMat, SparseRowMat, Triplet};

use super::{Finding, Measure};
use crate::chapter::code::code11_map_matrix::corrected::MapMatrix;
use crate::error::{Error, Result};

/// Bytes of a value, of a column index and of a row start.
const WORD: usize = 4;
/// Bytes of a red-black tree's node before its contents, of a key, and of a map, in a typical
/// 64-bit C++ library.
const NODE: usize = 32;
const KEY: usize = 8;
const MAP: usize = 48;

pub(super) fn example() -> Result<Finding> {
    let n = 100;
    let mut map = MapMatrix::zeros(n, n);
    for i in 0..n {
        map.set(i, (7 * i) % n, 1.0)?;
    }
    let rows = compressed_rows(n, |i| (7 * i) % n)?;
    let arrays =
        [rows.val().len(), rows.symbolic().col_idx().len(), rows.symbolic().row_ptr().len()];
    let compressed = arrays.iter().map(|length| length * WORD).sum::<usize>();
    // A 4-byte value takes 8 bytes next to its key, because of alignment.
    let (row_node, entry_node) = (NODE + KEY + MAP, NODE + KEY + 8);
    let entries = map.stored();
    let nodes = (map.nodes() - entries) * row_node + entries * entry_node;

    let bytes =
        Measure::new("bytes, 100 entries", "", compressed as f64, (nodes + MAP + 2 * KEY) as f64);
    let pieces = Measure::new("pieces of memory", "", arrays.len() as f64, map.nodes() as f64);
    let order =
        Measure::new("[1 2; 3 4] in MATLAB", "", [1.0, 2.0, 3.0, 4.0], [1.0, 3.0, 2.0, 4.0]);
    Ok(Finding::new(
        "A matrix of 100 × 100 with one entry a row, of 4 bytes. Printed: three arrays with indices of 4 bytes. \
         Corrected: the nodes of the map of maps, counted in one that was filled; 88 bytes for a row, 48 for \
         an entry (a tree node of 32, a key of 8, and a map of 48 or the value), 64 for the matrix itself. \
         The last line is the order of the entries in memory; the truth is what a library's compressed \
         columns hold.",
    )
    .measure(bytes.truth(&[(n * (88 + 48) + 64) as f64], "closed form", 0.0))
    .measure(pieces.truth(&[(n + n) as f64], "rows + entries", 0.0))
    .measure(order.truth(&columns_of_two_by_two()?, "faer's columns", 0.0)))
}

/// One entry in each of n rows, compressed.
fn compressed_rows(n: usize, column: impl Fn(usize) -> usize) -> Result<SparseRowMat<usize, f32>> {
    let triplets: Vec<_> = (0..n).map(|row| Triplet::new(row, column(row), 1.0)).collect();
    SparseRowMat::try_new_from_triplets(n, n, &triplets).map_err(|_| unstorable())
}

/// The values of [1 2; 3 4] as compressed columns hold them.
fn columns_of_two_by_two() -> Result<Vec<f64>> {
    let triplets = [(0, 0, 1.0), (0, 1, 2.0), (1, 0, 3.0), (1, 1, 4.0)];
    let triplets = triplets.map(|(row, col, value)| Triplet::new(row, col, value));
    let columns = SparseColMat::<usize, f64>::try_new_from_triplets(2, 2, &triplets);
    Ok(columns.map_err(|_| unstorable())?.val().to_vec())
}

fn unstorable() -> Error {
    Error::invalid("sparse matrix", "entries", "cannot be stored")
}
