//! The list of storages.

use super::{CompressedRows, Dense, LinkedList, MapOfMaps, Storage};

/// A storage format, and how to create an empty one.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// How it stores its entries.
    pub about: &'static str,
    /// The source in the chapter.
    pub source: &'static str,
    /// Creates a zero matrix of this size.
    pub new: fn(usize, usize) -> Box<dyn Storage>,
}

/// Every storage format that accepts entries one by one.
pub const ALL: [Kind; 4] = [
    Kind {
        name: "dense",
        about: "every number, row by row",
        source: "K&M Codes 8-10",
        new: |rows, columns| Box::new(Dense::new(rows, columns)),
    },
    Kind {
        name: "map of maps",
        about: "a sorted map of rows, each a sorted map of columns",
        source: "K&M Code 11",
        new: |rows, columns| Box::new(MapOfMaps::new(rows, columns)),
    },
    Kind {
        name: "linked list",
        about: "one list of entries, each with its row, column, value and links",
        source: "K&M “Linear Linked-List Sparse Matrix”",
        new: |rows, columns| Box::new(LinkedList::new(rows, columns)),
    },
    Kind {
        name: "compressed rows",
        about: "columns and values of all entries in two arrays, row by row",
        source: "faer; named by K&M for Code 11, E56",
        new: |rows, columns| Box::new(CompressedRows::new(rows, columns)),
    },
];
