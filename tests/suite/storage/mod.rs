//! The chapter's matrices: the same behavior for every form of storage.

mod errors;
mod impulses;
mod laws;
mod memory;
mod ordering;
mod search;
mod sweeps;

use lcplab::storage::Entry;
use proptest::prelude::*;

/// Values to set, in any order, some of them zero, some places twice.
fn values(rows: usize, columns: usize) -> impl Strategy<Value = Vec<Entry>> {
    let value = prop_oneof![2 => Just(0.0), 5 => -9.0..9.0f64];
    proptest::collection::vec((0..rows, 0..columns, value), 0..80)
}

/// Entries as [`load`](lcplab::storage::Storage::load) wants them: the last value of each place.
fn in_order(values: &[Entry]) -> Vec<Entry> {
    let mut last = std::collections::BTreeMap::new();
    values.iter().for_each(|&(i, j, value)| {
        last.insert((i, j), value);
    });
    last.into_iter().filter(|(_, v)| *v != 0.0).map(|((i, j), v)| (i, j, v)).collect()
}
