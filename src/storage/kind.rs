//! The list of storages.

use super::{CompressedRows, Dense, LinkedList, MapOfMaps, Storage};

/// A storage format, and how to create an empty one.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// Creates a zero matrix of this size.
    pub new: fn(usize, usize) -> Box<dyn Storage>,
}

/// Every storage format that accepts entries one by one.
pub const ALL: [Kind; 4] = [
    Kind { name: "dense", new: |rows, columns| Box::new(Dense::new(rows, columns)) },
    Kind { name: "map of maps", new: |rows, columns| Box::new(MapOfMaps::new(rows, columns)) },
    Kind { name: "linked list", new: |rows, columns| Box::new(LinkedList::new(rows, columns)) },
    Kind {
        name: "compressed rows",
        new: |rows, columns| Box::new(CompressedRows::new(rows, columns)),
    },
];
